#include "services/seam_finding/referee/edge_evidence.hpp"

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

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
  StripeEvidence(const StripeOnPlate& stripe, double border, double begin, double width,
                 const ClaimedEnd& end)
      : stripe_(stripe),
        border_(border),
        from_(begin + kReferee.step / 2),
        to_(begin + width),
        end_(end) {
    for (const Place& place : stripe.places) {
      if (place.away < from_) continue;
      if (place.look == Look::kBefore)
        nothing_before_ = false;  // its shadow falls anywhere
      else if (place.away <= to_ &&
               (place.look == Look::kOn || place.away > begin + kReferee.beside_seam))
        known_.push_back(&place);
    }
  }

  EdgeEvidence take(bool dark_counts) const {
    EdgeEvidence evidence;
    dark_counts = dark_counts && nothing_before_;
    if (known_.empty()) {
      if (dark_counts) add_dark(from_, to_, evidence);
      return evidence;
    }
    const Split split = best_split(known_);
    const int all = static_cast<int>(known_.size());
    if (split.wrong > kReferee.by_accident * all) return evidence;
    add(split.on_first ? 0 : split.at, split.on_first ? split.at : all, Look::kOn, evidence.on);
    add(split.on_first ? split.at : 0, split.on_first ? all : split.at, Look::kThrough,
        evidence.off);
    if (dark_counts) add_dark_beside(evidence);
    return evidence;
  }

 private:
  EdgeMark mark(double away) const {
    return {end_.out(stripe_.crossing + stripe_.lean * away), away - border_};
  }

  void add(int begin, int behind, Look look, std::vector<EdgeMark>& marks) const {
    const Place *first = nullptr, *last = nullptr;
    for (int i = begin; i < behind; ++i) {
      if (known_[i]->look != look) continue;
      if (!first) first = known_[i];
      last = known_[i];
    }
    for (const Place* place : {first, last})
      if (place) marks.push_back({end_.out(place->along), place->away - border_});
  }

  void add_dark(double from, double to, EdgeEvidence& evidence) const {
    if (to - from < kReferee.dark) return;
    evidence.dark.push_back(mark(from));
    evidence.dark.push_back(mark(to));
  }

  // Nothing was seen on the side to which the plate's places end.
  void add_dark_beside(EdgeEvidence& evidence) const {
    if (evidence.on.empty()) return;
    const double first = known_.front()->away, last = known_.back()->away;
    add_dark(last + kReferee.dark, to_, evidence);
    add_dark(from_, first - kReferee.dark, evidence);
  }

  const StripeOnPlate& stripe_;
  double border_, from_, to_;  // away from the seam; mm
  const ClaimedEnd& end_;
  Known known_;
  bool nothing_before_ = true;
};

}  // namespace

EdgeEvidence evidence_of(const StripeOnPlate& stripe, double border, double begin, double width,
                         const ClaimedEnd& end, bool dark_counts) {
  return StripeEvidence(stripe, border, begin, width, end).take(dark_counts);
}

}  // namespace arcstart::seam_finding
