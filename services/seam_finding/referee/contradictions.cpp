#include "services/seam_finding/referee/contradictions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "services/seam_finding/referee/constants.hpp"
#include "services/seam_finding/referee/end_bounds.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

// A plate that is no plane, or lies otherwise than is claimed.
Reason of_shape(const PlateShape& shape, const PlateView& view) {
  if (!shape.known) return {Code::kPlateNotShown};
  const double sure = kReferee.deviations;
  if (std::abs(shape.tilt) > std::max(kReferee.turned, sure * shape.tilt_deviation))
    return {Code::kPlateTurned, shape.tilt};
  const bool round =
      -shape.curvature > 1 / kReferee.round && -shape.curvature > sure * shape.curvature_deviation;
  if (round && shape.width < kReferee.narrow) return {Code::kPlateRound, -1 / shape.curvature};
  const double width = view.width - view.begin;
  if (width < kReferee.narrowest) return {Code::kPlateTooNarrow, width};
  return {};
}

// Where a stripe leaves a plate toward the seam, away from it; nothing where it runs on across.
std::optional<double> edge_in(const PlateView& view, const StripeOnPlate& stripe) {
  const double from = view.begin + kReferee.beside_seam;
  std::optional<double> last;
  bool ends = false;
  for (auto place = stripe.places.rbegin(); place != stripe.places.rend(); ++place) {
    if (!last && place->away > from + kReferee.near_seam) continue;
    if (place->look != Look::kOn || (last && *last - place->away > kReferee.place_gap)) {
      if (last) return last;
      continue;
    }
    if (ends && place->ends) return last;  // from one segment to the next
    last = place->away, ends = place->ends && place->away < from;
  }
  return ends ? last : std::nullopt;
}

bool within(const StripeOnPlate& stripe, double from, double to) {
  return stripe.crossing > from && stripe.crossing < to;
}

// Plates side by side end at the seam: else there is none.
Reason at_edge(const PlateView& view, double length) {
  int stripes = 0, leaving = 0;
  for (const StripeOnPlate& stripe : view.stripes) {
    if (!within(stripe, 0, length) || at_seam(view, stripe) != AtSeam::kOn) continue;
    ++stripes;
    const auto edge = edge_in(view, stripe);
    leaving += edge && std::abs(*edge - view.plate.inset) < kReferee.edge_off;
  }
  if (stripes >= kReferee.shown_stripes && leaving < kReferee.edges_shown * stripes)
    return {Code::kNoEdgeAtSeam, static_cast<double>(leaving), static_cast<double>(stripes)};
  return {};
}

// The plates that end at the seam: of a lap the upper one.
bool ends_at_seam(const SeamResult& seam, int plate) {
  if (seam.joint_type == "butt" || seam.joint_type == "v") return true;
  return seam.joint_type == "lap" &&
         seam.faces[plate].plane.signed_distance(seam.start) < -kReferee.off;
}

// Stripes at the seam, between its claimed ends: both plates there, one of them not.
Reason along(const std::array<PlateView, 2>& views, double length, double spacing) {
  int both = 0, not_both = 0;
  for (const StripeOnPlate& first : views[0].stripes) {
    if (!within(first, spacing, length - spacing)) continue;
    const auto second =
        std::find_if(views[1].stripes.begin(), views[1].stripes.end(),
                     [&](const StripeOnPlate& stripe) { return stripe.stripe == first.stripe; });
    if (second == views[1].stripes.end()) continue;
    const AtSeam a = at_seam(views[0], first), b = at_seam(views[1], *second);
    if (a == AtSeam::kOn && b == AtSeam::kOn) ++both;
    if (a == AtSeam::kOff || b == AtSeam::kOff) ++not_both;
  }
  const int known = both + not_both;
  if (known >= kReferee.shown_stripes && both < kReferee.shown_share * known)
    return {Code::kSeamNotShown, static_cast<double>(both), static_cast<double>(known)};
  return {};
}

}  // namespace

Reason contradiction_of(const SeamResult& seam, const std::array<PlateView, 2>& views,
                        const std::array<PlateShape, 2>& shapes, double spacing) {
  const double length = (seam.end - seam.start).norm();
  if (views[0].stripes.size() < 2 || views[1].stripes.size() < 2) return {Code::kSeamNotCrossed};
  for (int j = 0; j < 2; ++j) {
    // A plate reaches away from the seam within its plane.
    const SeamPlate& plate = views[j].plate;
    if (std::abs(plate.away.dot(plate.plane.normal)) > kReferee.out_of_plane)
      return {Code::kPlateNotShown};
    if (const Reason reason = of_shape(shapes[j], views[j])) return reason;
  }
  for (int j = 0; j < 2; ++j)
    if (ends_at_seam(seam, j))
      if (const Reason reason = at_edge(views[j], length)) return reason;
  return along(views, length, spacing);
}

}  // namespace arcstart::seam_finding
