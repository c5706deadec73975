#include "services/seam_finding/referee/end_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kSame = 1e-6;  // sums of weights that differ less are the same
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A place that the plate must reach, or must not: outward from the claimed end and away from the
// seam; mm.
struct Mark {
  double out, away;
};

// What a stripe says of the plate's edge: a straight edge has all of `on` on its inner side and all
// of `off` on its outer one. Of each the extremes are enough. `dark`: where the plate would be lit
// and nothing was seen, though nothing stands before it; it says less than what lies behind.
struct Evidence {
  std::vector<Mark> on, off, dark;
  bool crosses() const { return !on.empty() && !(off.empty() && dark.empty()); }
};

using Known = std::vector<const Place*>;

// The places by `away` are on before the split and off behind it, or the other way round.
struct Split {
  int at = 0, wrong = 0;
  bool on_first = true;
};

Split best_split(const Known& known) {
  const int all = static_cast<int>(known.size());
  int total = 0;
  for (const Place* place : known) total += place->look == Look::kOn;
  Split best;
  best.wrong = all + 1;
  int on = 0;
  for (int i = 0; i <= all; ++i) {
    const int wrong = (i - on) + (total - on);
    if (wrong < best.wrong) best = {i, wrong, true};
    if (all - wrong < best.wrong) best = {i, all - wrong, false};
    if (i < all) on += known[i]->look == Look::kOn;
  }
  return best;
}

// What one stripe shows between two distances from the seam.
class StripeEvidence {
 public:
  // begin: of the plate, away from the seam; to: from there.
  StripeEvidence(const StripeOnPlate& stripe, double begin, double to, double end, double outward)
      : stripe_(stripe),
        begin_(begin),
        from_(begin + kReferee.first_place),
        to_(begin + to),
        end_(end),
        outward_(outward) {
    for (const Place& place : stripe.places) {
      if (place.away < from_) continue;
      if (place.look == Look::kBefore)
        nothing_before_ = false;  // its shadow falls anywhere
      else if (place.away <= to_ &&
               (place.look == Look::kOn || place.away > begin + kReferee.beside_seam))
        known_.push_back(&place);
    }
  }

  // Dark stretches count where `dark_counts`.
  Evidence take(bool dark_counts) const {
    Evidence evidence;
    dark_counts = dark_counts && nothing_before_;
    if (known_.empty()) {
      if (dark_counts) add_dark(from_, to_, evidence);
      return evidence;
    }
    const Split split = best_split(known_);
    const int all = static_cast<int>(known_.size());
    if (split.wrong > kReferee.misfit * all) return evidence;
    add(split.on_first ? 0 : split.at, split.on_first ? split.at : all, Look::kOn, evidence.on);
    add(split.on_first ? split.at : 0, split.on_first ? all : split.at, Look::kThrough,
        evidence.off);
    if (dark_counts) add_dark_beside(evidence);
    return evidence;
  }

 private:
  Mark mark(double away) const {
    return {outward_ * (stripe_.crossing + stripe_.lean * away - end_), away - begin_};
  }

  void add(int begin, int behind, Look look, std::vector<Mark>& marks) const {
    const Place *first = nullptr, *last = nullptr;
    for (int i = begin; i < behind; ++i) {
      if (known_[i]->look != look) continue;
      if (!first) first = known_[i];
      last = known_[i];
    }
    for (const Place* place : {first, last})
      if (place) marks.push_back({outward_ * (place->along - end_), place->away - begin_});
  }

  void add_dark(double from, double to, Evidence& evidence) const {
    if (to - from < kReferee.dark) return;
    evidence.dark.push_back(mark(from));
    evidence.dark.push_back(mark(to));
  }

  // Nothing was seen on the side to which the plate's places end.
  void add_dark_beside(Evidence& evidence) const {
    if (evidence.on.empty()) return;
    const double first = known_.front()->away, last = known_.back()->away;
    add_dark(last + kReferee.dark, to_, evidence);
    add_dark(from_, first - kReferee.dark, evidence);
  }

  const StripeOnPlate& stripe_;
  double begin_, from_, to_, end_, outward_;
  Known known_;
  bool nothing_before_ = true;
};

struct Interval {
  double least, most;
};

// An edge as straight as it is found to be: waves of a flame's cut are as far off it as they are.
struct EdgeFit {
  Interval foot{-kInfinite, kInfinite};  // where the edge meets the seam, outward; mm
  double contradicting = 0;              // stripes that it cannot satisfy; dark ones count less
  int crossings = 0;
};

// Where a straight edge of one slope may meet the seam so that as few stripes as possible
// contradict it.
struct Limit {
  double at;
  bool least;
  double weight;
};
double narrow(std::vector<Limit>& limits, Interval& result) {
  std::sort(limits.begin(), limits.end(), [](const Limit& a, const Limit& b) {
    return a.at != b.at ? a.at < b.at : a.least > b.least;
  });
  double wrong = 0;  // at minus infinity
  for (const Limit& limit : limits) wrong += limit.least ? limit.weight : 0;
  double best = wrong;
  result = {-kInfinite, limits.empty() ? kInfinite : limits.front().at};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    wrong += limits[i].least ? -limits[i].weight : limits[i].weight;
    const double next = i + 1 < limits.size() ? limits[i + 1].at : kInfinite;
    if (wrong < best - kSame)
      best = wrong, result = {limits[i].at, next};
    else if (wrong < best + kSame)
      result.most = std::max(result.most, next);
  }
  return best;
}

// The slopes from square to steepest, to both sides by turns: a square edge is found first, and
// then slopes that contradict stripes need not be looked at.
EdgeFit fit_edge(const std::vector<Evidence>& all, double play) {
  EdgeFit fit;
  for (const Evidence& evidence : all) fit.crossings += evidence.crosses();
  fit.contradicting = kInfinite;
  std::vector<Limit> limits;
  const int steps = static_cast<int>(std::lround(kReferee.steepest / kReferee.steepness_step));
  for (int i = 0; i <= 2 * steps; ++i) {
    const double slope = (i % 2 == 0 ? i / 2 : -(i + 1) / 2) * kReferee.steepness_step;
    limits.clear();
    Interval foot{-kInfinite, kInfinite};
    for (const Evidence& evidence : all) {
      double least = -kInfinite, most = kInfinite, dark = kInfinite;
      for (const Mark& mark : evidence.on) least = std::max(least, mark.out - slope * mark.away);
      for (const Mark& mark : evidence.off) most = std::min(most, mark.out - slope * mark.away);
      for (const Mark& mark : evidence.dark) dark = std::min(dark, mark.out - slope * mark.away);
      if (std::isfinite(least)) limits.push_back({least - play, true, 1});
      if (std::isfinite(most)) limits.push_back({most + play, false, 1});
      if (std::isfinite(dark)) limits.push_back({dark + play, false, kReferee.dark_weight});
      foot.least = std::max(foot.least, least - play);
      foot.most = std::min({foot.most, most + play, dark + play});
    }
    double contradicting = 0;
    if (foot.least > foot.most) {
      if (fit.contradicting < kSame) continue;
      contradicting = narrow(limits, foot);
    }
    if (contradicting < fit.contradicting - kSame) {
      fit.contradicting = contradicting;
      fit.foot = foot;
    } else if (contradicting < fit.contradicting + kSame) {
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
    const AtSeam seen = (*inward[i]).at_seam;
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
    const bool off = (*inward[i]).at_seam == AtSeam::kOff;
    if (off && i + 1 < anchor && (*inward[i + 1]).at_seam == AtSeam::kOff) break;
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
// shadow of the plate's own edge, where they reach no farther than that can; else something may
// hide the plate there. True for those, and for the stripe on the plate next to them.
std::vector<bool> in_own_shadow(const PlateView& view,
                                const std::vector<const StripeOnPlate*>& stripes, double spacing) {
  std::vector<bool> own(stripes.size(), false);
  for (std::size_t i = stripes.size(); i-- > 1;) {
    if ((*stripes[i]).at_seam != AtSeam::kOff) continue;
    std::size_t inner = i;
    while (inner > 0 && (*stripes[inner - 1]).at_seam == AtSeam::kUnknown) --inner;
    if (inner == 0) continue;
    const AtSeam seen = (*stripes[inner - 1]).at_seam;
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
                   const std::vector<bool>& own_shadow, double width, double end, double outward) {
  std::vector<Evidence> evidence;
  bool dark_beyond = false;
  for (std::size_t i = stripes.size(); i-- > 0;) {
    // The shadow goes on along a slanting edge.
    const bool slanting = dark_beyond && (*stripes[i]).at_seam == AtSeam::kOn;
    const StripeEvidence stripe(*stripes[i], view.begin, width, end, outward);
    evidence.push_back(stripe.take(own_shadow[i] || slanting));
    dark_beyond = !evidence.back().dark.empty();
  }
  EdgeFit fit = fit_edge(evidence, kReferee.place);
  for (double play = 2 * kReferee.place; fit.contradicting > 1 && play <= kReferee.largest_wave;
       play *= 2) {
    EdgeFit waved = fit_edge(evidence, play);
    if (waved.contradicting > fit.contradicting - kSame) continue;
    waved.foot.least -= play, waved.foot.most += play;  // it may have a wave right at the seam
    fit = waved;
  }
  return fit;
}

}  // namespace

EndBounds bounds_of(const PlateView& view, SeamSide side, double end, double spacing) {
  EndBounds bounds;
  const double outward = static_cast<double>(side);
  const auto stripes = stripes_about(view, outward, end, spacing);
  if (stripes.empty()) return bounds;
  bounds.anchored = true;
  const double near = kReferee.beside_seam + kReferee.near_seam;
  const double width = view.width - view.begin;
  const std::vector<bool> own_shadow = in_own_shadow(view, stripes, spacing);
  const EdgeFit beside = fit_within(view, stripes, own_shadow, near, end, outward);
  const EdgeFit whole =
      width > near ? fit_within(view, stripes, own_shadow, width, end, outward) : beside;
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
