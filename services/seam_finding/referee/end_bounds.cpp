#include "services/seam_finding/referee/end_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A place that the plate must reach, or must not: outward from the claimed end and away from the
// seam; mm.
struct Mark {
  double out, away;
};

// What a stripe says of the plate's edge: a straight edge has all of `on` on its inner side and all
// of `off` on its outer one. Of each the extremes are enough.
struct Evidence {
  std::vector<Mark> on, off;
  bool crosses() const { return !on.empty() && !off.empty(); }
};

struct Count {
  int on = 0, off = 0;
};

Count count_beside(const PlateView& view, const StripeOnPlate& stripe, int& before) {
  const double from = view.plate.inset + kReferee.beside_seam;
  Count count;
  for (const Place& place : stripe.places) {
    if (place.away < from || place.away > from + kReferee.near_seam) continue;
    if (place.look == Look::kOn) ++count.on;
    if (place.look == Look::kThrough) ++count.off;
    if (place.look == Look::kBefore) ++before;
  }
  return count;
}

// The split of the places by `away` into on and off that fits best: off on one side, on on the
// other, or one alone. Nothing where none fits.
Evidence evidence_of(const StripeOnPlate& stripe, double from, double to, double end,
                     double outward) {
  std::vector<const Place*> known;
  for (const Place& place : stripe.places)
    if (place.away >= from && place.away <= to && place.look != Look::kBefore)
      known.push_back(&place);
  Evidence evidence;
  const int all = static_cast<int>(known.size());
  if (all == 0) return evidence;
  // With the first i on and the others off, and the other way round.
  int total_on = 0;
  for (const Place* place : known) total_on += place->look == Look::kOn;
  int best = all + 1, split = 0;
  bool on_first = true;
  int on = 0;
  for (int i = 0; i <= all; ++i) {
    const int wrong = (i - on) + (total_on - on);  // off before i, on behind
    if (wrong < best) best = wrong, split = i, on_first = true;
    if (all - wrong < best) best = all - wrong, split = i, on_first = false;
    if (i < all) on += known[i]->look == Look::kOn;
  }
  if (best > kReferee.misfit * all) return evidence;
  const auto add = [&](std::vector<Mark>& marks, int begin, int behind, Look look) {
    const Place *first = nullptr, *last = nullptr;
    for (int i = begin; i < behind; ++i) {
      if (known[i]->look != look) continue;
      if (!first) first = known[i];
      last = known[i];
    }
    for (const Place* place : {first, last})
      if (place) marks.push_back({outward * (place->along - end), place->away});
  };
  add(evidence.on, on_first ? 0 : split, on_first ? split : all, Look::kOn);
  add(evidence.off, on_first ? split : 0, on_first ? all : split, Look::kThrough);
  return evidence;
}

struct Interval {
  double least, most;
};

struct EdgeFit {
  Interval foot{-kInfinite, kInfinite};  // where the edge meets the seam, outward; mm
  int contradicting = 0;                 // stripes that no edge can satisfy
  int crossings = 0;
};

// Where a straight edge of one slope may meet the seam so that as few stripes as possible
// contradict it.
struct Limit {
  double at;
  bool least;
};
int narrow(std::vector<Limit>& limits, Interval& result) {
  std::sort(limits.begin(), limits.end(), [](const Limit& a, const Limit& b) {
    return a.at != b.at ? a.at < b.at : a.least > b.least;
  });
  int wrong = 0;
  for (const Limit& limit : limits) wrong += limit.least;  // at minus infinity
  int best = wrong;
  result = {-kInfinite, limits.empty() ? kInfinite : limits.front().at};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    wrong += limits[i].least ? -1 : 1;
    const double next = i + 1 < limits.size() ? limits[i + 1].at : kInfinite;
    if (wrong < best)
      best = wrong, result = {limits[i].at, next};
    else if (wrong == best)
      result.most = std::max(result.most, next);
  }
  return best;
}

EdgeFit fit_edge(const std::vector<Evidence>& all) {
  EdgeFit fit;
  for (const Evidence& evidence : all) fit.crossings += evidence.crosses();
  fit.contradicting = static_cast<int>(all.size()) + 1;
  std::vector<Limit> limits;
  const int steps = static_cast<int>(std::lround(kReferee.steepest / kReferee.steepness_step));
  for (int step = -steps; step <= steps; ++step) {
    const double slope = step * kReferee.steepness_step;
    limits.clear();
    for (const Evidence& evidence : all) {
      double least = -kInfinite, most = kInfinite;
      for (const Mark& mark : evidence.on) least = std::max(least, mark.out - slope * mark.away);
      for (const Mark& mark : evidence.off) most = std::min(most, mark.out - slope * mark.away);
      if (std::isfinite(least)) limits.push_back({least - kReferee.place, true});
      if (std::isfinite(most)) limits.push_back({most + kReferee.place, false});
    }
    Interval foot{};
    const int contradicting = narrow(limits, foot);
    if (contradicting < fit.contradicting) {
      fit.contradicting = contradicting;
      fit.foot = foot;
    } else if (contradicting == fit.contradicting) {
      fit.foot.least = std::min(fit.foot.least, foot.least);
      fit.foot.most = std::max(fit.foot.most, foot.most);
    }
  }
  return fit;
}

// The stripes by which the end is to be known, from the inside out: from the nearest run of two
// within the claim on which the plate is there, to the second in a row on which it is not.
std::vector<const StripeOnPlate*> stripes_about(const PlateView& view, double outward, double end,
                                                double spacing) {
  std::vector<const StripeOnPlate*> inward;
  for (const StripeOnPlate& stripe : view.stripes) inward.push_back(&stripe);
  if (outward > 0) std::reverse(inward.begin(), inward.end());  // from the outside in
  const auto out = [&](const StripeOnPlate& stripe) { return outward * (stripe.crossing - end); };
  std::size_t anchor = inward.size();
  int run = 0;
  for (std::size_t i = 0; i < inward.size(); ++i) {
    if (out(*inward[i]) > spacing / 2) continue;
    const AtSeam seen = at_seam(view, *inward[i]);
    if (seen == AtSeam::kOn && ++run == 2) {
      anchor = i;
      break;
    }
    if (seen == AtSeam::kOff || seen == AtSeam::kPart) run = 0;
  }
  if (anchor == inward.size()) return {};
  std::vector<const StripeOnPlate*> stripes;
  // From inside, so that an edge's slope is seen: the stripes that cross it far from the seam.
  const std::size_t deepest = std::min(inward.size(), anchor + 12);
  for (std::size_t i = deepest; i-- > 0;) {
    stripes.push_back(inward[i]);
    if (i >= anchor) continue;
    const bool off = at_seam(view, *inward[i]) == AtSeam::kOff;
    if (off && i + 1 < anchor && at_seam(view, *inward[i + 1]) == AtSeam::kOff) break;
  }
  return stripes;
}

EdgeFit fit_within(const PlateView& view, const std::vector<const StripeOnPlate*>& stripes,
                   double width, double end, double outward) {
  const double from = view.plate.inset + kReferee.beside_seam;
  std::vector<Evidence> evidence;
  for (const StripeOnPlate* stripe : stripes)
    evidence.push_back(evidence_of(*stripe, from, width, end, outward));
  return fit_edge(evidence);
}

}  // namespace

AtSeam at_seam(const PlateView& view, const StripeOnPlate& stripe) {
  int before = 0;
  const Count count = count_beside(view, stripe, before);
  const int known = count.on + count.off;
  if (known == 0) return before > 0 ? AtSeam::kHidden : AtSeam::kUnknown;
  if (count.on >= kReferee.clear * known) return AtSeam::kOn;
  if (count.off >= kReferee.clear * known) return AtSeam::kOff;
  return AtSeam::kPart;
}

EndBounds bounds_of(const PlateView& view, SeamSide side, double end, double spacing) {
  EndBounds bounds;
  const double outward = static_cast<double>(side);
  const auto stripes = stripes_about(view, outward, end, spacing);
  if (stripes.empty()) return bounds;
  bounds.anchored = true;
  const double near = view.plate.inset + kReferee.beside_seam + kReferee.near_seam;
  const EdgeFit beside = fit_within(view, stripes, near, end, outward);
  const EdgeFit whole =
      view.width > near ? fit_within(view, stripes, view.width, end, outward) : beside;
  bounds.crossings = whole.crossings;
  bounds.straight = whole.contradicting <= kReferee.contradicting * whole.crossings;
  Interval foot = beside.foot;
  if (bounds.straight) {
    const Interval both{std::max(beside.foot.least, whole.foot.least),
                        std::min(beside.foot.most, whole.foot.most)};
    if (both.least <= both.most)
      foot = both;
    else
      bounds.straight = false;
  }
  bounds.least = foot.least, bounds.most = foot.most;
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
