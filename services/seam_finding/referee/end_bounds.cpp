#include "services/seam_finding/referee/end_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/seam_finding/referee/constants.hpp"
#include "services/seam_finding/referee/edge_evidence.hpp"
#include "services/seam_finding/referee/edge_fit.hpp"

namespace arcstart::seam_finding {
namespace {

// The stripes by which the end is to be known, from the inside out: from the nearest run of two
// within the claim on which the plate is there, to the second in a row on which it is not.
std::vector<const StripeOnPlate*> stripes_about(const PlateView& view, const ClaimedEnd& end,
                                                double spacing) {
  std::vector<const StripeOnPlate*> inward;
  for (const StripeOnPlate& stripe : view.stripes) inward.push_back(&stripe);
  if (end.outward > 0) std::reverse(inward.begin(), inward.end());  // from the outside in
  std::size_t anchor = inward.size();
  int run = 0;
  for (std::size_t i = 0; i < inward.size(); ++i) {
    if (end.out(inward[i]->crossing) > spacing / 2) continue;
    const AtSeam seen = inward[i]->at_seam;
    if (seen == AtSeam::kOn && ++run == 2) {
      anchor = i;
      break;
    }
    if (seen == AtSeam::kOff || seen == AtSeam::kPart) run = 0;
  }
  if (anchor == inward.size()) return {};
  std::vector<const StripeOnPlate*> stripes;
  // From inside, so that an edge's slope is seen: the stripes that cross it far from the seam.
  const double slanting = kModel.steepest_edge * kReferee.reach;
  for (std::size_t i = inward.size(); i-- > 0;) {
    if (end.out(inward[i]->crossing) < end.out(inward[anchor]->crossing) - slanting) continue;
    stripes.push_back(inward[i]);
    if (i >= anchor) continue;
    const bool off = inward[i]->at_seam == AtSeam::kOff;
    if (off && i + 1 < anchor && inward[i + 1]->at_seam == AtSeam::kOff) break;
  }
  return stripes;
}

// mm; of what a stripe shows behind the plate beside the seam.
double depth_behind(const PlateView& view, const StripeOnPlate& stripe) {
  const double from = view.begin + kReferee.beside_seam;
  double depth = 0;
  for (const Place& place : stripe.places)
    if (place.away > from && place.away < from + kReferee.near_seam)
      depth = std::max(depth, -place.height);
  return depth;
}

// Dark stripes between one that shows the plate and one that shows what lies behind it are the
// shadow of the plate's own edge, where they reach no farther than that can and nothing stands
// beside the seam there; else something may hide the plate. True for those, and for the stripe on
// the plate next to them.
std::vector<bool> in_own_shadow(const PlateView& view,
                                const std::vector<const StripeOnPlate*>& stripes, double spacing) {
  std::vector<bool> own(stripes.size(), false);
  for (std::size_t i = stripes.size(); i-- > 1;) {
    if (stripes[i]->at_seam != AtSeam::kOff) continue;
    std::size_t inner = i;
    bool covered = stripes[i]->covered;
    while (inner > 0 && stripes[inner - 1]->at_seam == AtSeam::kUnknown)
      covered |= stripes[--inner]->covered;
    if (inner == 0 || covered) continue;
    const AtSeam seen = stripes[inner - 1]->at_seam;
    if (seen != AtSeam::kOn && seen != AtSeam::kPart) continue;
    const double dark =
        inner == i ? 0 : std::abs(stripes[inner]->crossing - stripes[i - 1]->crossing);
    if (dark > depth_behind(view, *stripes[i]) * stripes[i]->shadow + spacing / 2) continue;
    std::fill(own.begin() + static_cast<std::ptrdiff_t>(inner - 1),
              own.begin() + static_cast<std::ptrdiff_t>(i), true);
  }
  return own;
}

EdgeFit fit_within(const PlateView& view, const std::vector<const StripeOnPlate*>& stripes,
                   const std::vector<bool>& own_shadow, double width, const ClaimedEnd& end) {
  std::vector<EdgeEvidence> evidence;
  bool dark_beyond = false;
  for (std::size_t i = stripes.size(); i-- > 0;) {
    // The shadow goes on along a slanting edge.
    const bool slanting = dark_beyond && stripes[i]->at_seam == AtSeam::kOn;
    evidence.push_back(evidence_of(*stripes[i], view.plate.inset, view.begin, width, end,
                                   own_shadow[i] || slanting));
    dark_beyond = !evidence.back().dark.empty();
  }
  return fit_waved_edge(evidence);
}

}  // namespace

EndBounds bounds_of(const PlateView& view, SeamSide side, double along, double spacing) {
  EndBounds bounds;
  const ClaimedEnd end{along, static_cast<double>(side)};
  const auto stripes = stripes_about(view, end, spacing);
  if (stripes.empty()) return bounds;
  bounds.anchored = true;
  const double near = kReferee.beside_seam + kReferee.near_seam;
  const double width = view.width - view.begin;
  const std::vector<bool> own_shadow = in_own_shadow(view, stripes, spacing);
  const EdgeFit beside = fit_within(view, stripes, own_shadow, near, end);
  const EdgeFit whole = width > near ? fit_within(view, stripes, own_shadow, width, end) : beside;
  bounds.crossings = whole.crossings;
  bounds.straight = whole.contradicting <= kReferee.by_accident * whole.crossings;
  EdgeFoot foot = beside.foot;
  if (bounds.straight) {
    const EdgeFoot both{std::max(beside.foot.least, whole.foot.least),
                        std::min(beside.foot.most, whole.foot.most),
                        std::min(beside.foot.most_but_one, whole.foot.most_but_one)};
    if (both.least <= both.most)
      foot = both;
    else
      bounds.straight = false;
  }
  bounds.least = foot.least, bounds.most = foot.most;
  // A lone stripe before such as show nothing of the plate may have met a hole in it.
  if (foot.most_but_one > foot.most + kReferee.lone * spacing) bounds.most = foot.most_but_one;
  return bounds;
}

EndBounds first_of(const EndBounds& a, const EndBounds& b) {
  EndBounds both;
  both.anchored = a.anchored && b.anchored;
  both.least = std::min(a.least, b.least);
  both.most = std::min(a.most, b.most);
  both.straight = a.straight && b.straight;
  both.crossings = (a.most < b.most ? a : b).crossings;
  return both;
}

}  // namespace arcstart::seam_finding
