#include "services/seam_finding/ends/edge_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "services/seam_finding/ends/constants.hpp"

namespace arcstart::seam_finding {

// Sums of what is told of all places before one, or beyond.
class EdgeModel::Steps {
 public:
  explicit Steps(const PlaceGrid& grid)
      : grid_(grid), change_(static_cast<std::size_t>(grid.count) + 1) {}

  // Of all places farther out. What holds of the whole grid tells one slope from another.
  void add_beyond(double from, double log) { change_[index(from)] += log; }
  // Of all places farther in.
  void add_before(double to, double log) {
    everywhere_ += log;
    change_[index(to)] -= log;
  }
  std::vector<double> values() const {
    std::vector<double> values(static_cast<std::size_t>(grid_.count));
    double sum = everywhere_;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = sum += change_[i];
    return values;
  }

 private:
  std::size_t index(double place) const {
    return static_cast<std::size_t>(
        std::clamp(std::ceil((place - grid_.first) / grid_.step), 0.0, 1.0 * grid_.count));
  }
  const PlaceGrid& grid_;
  std::vector<double> change_;
  double everywhere_ = 0;
};

namespace {

double foot(const PlacePart& part, double slope) { return part.out - slope * part.away; }
double foot(const EdgeCrossing& edge, double slope) { return edge.along - slope * edge.away; }

// Of a crossing where the edge is not, the logarithm of its density over places: the edge is
// farther out, and the stripe ends for another reason; or farther in, and this is another thing's.
double density_before(const EdgeCrossing& edge, bool covered) {
  const double share = covered      ? kEnds.ends_covered
                       : edge.falls ? kEnds.accident
                                    : kEnds.ends_early;
  return std::log(share / kEnds.way_seen);
}
double density_beyond() { return -std::log(kEnds.way_seen); }

std::optional<double> innermost_off(const StripeEvidence& stripe, double slope) {
  std::optional<double> innermost;
  for (const Stretch& off : stripe.off) {
    const double place = std::min(foot(off[0], slope), foot(off[1], slope));
    if (!innermost || place < *innermost) innermost = place;
  }
  return innermost;
}

// Of the stretches on the plate the farthest foot before `limit`.
std::optional<PlacePart> farthest_on(const StripeEvidence& stripe, double slope, double limit) {
  std::optional<PlacePart> farthest;
  for (const Stretch& on : stripe.on)
    for (const PlacePart& part : on)
      if (foot(part, slope) < limit && (!farthest || foot(part, slope) > foot(*farthest, slope)))
        farthest = part;
  return farthest;
}

}  // namespace

EdgeModel::EdgeModel(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid)
    : evidence_(evidence), grid_(grid) {
  for (const StripeEvidence& stripe : evidence)
    offs_.insert(offs_.end(), stripe.off.begin(), stripe.off.end());
}

std::vector<double> EdgeModel::steps(double slope) const {
  Steps log(grid_);
  for (const StripeEvidence& stripe : evidence_) {
    const double absent = std::log(stripe.covered ? kEnds.absent_covered : kEnds.accident);
    const double past = std::log(kEnds.seen_past);
    const auto off = innermost_off(stripe, slope);
    if (stripe.absent) log.add_beyond(foot(*stripe.absent, slope), absent);
    if (off) log.add_beyond(*off, past);
    // Both of one stripe are hardly more than one witness.
    if (stripe.absent && off)
      log.add_beyond(std::max(foot(*stripe.absent, slope), *off),
                     std::min(absent, past) + std::log(kEnds.second_witness) - absent - past);
    add_on(stripe, slope, log);
    for (const EdgeCrossing& edge : stripe.edges) {
      // The outline of something before the plate tells no edge of it.
      if (edge.occluded) continue;
      log.add_before(foot(edge, slope), density_beyond());
      log.add_beyond(foot(edge, slope), density_before(edge, stripe.covered));
    }
  }
  return log.values();
}

void EdgeModel::add_peaks(double slope, double roughness, std::vector<double>& log) const {
  for (const StripeEvidence& stripe : evidence_)
    for (const EdgeCrossing& edge : stripe.edges)
      if (!edge.occluded && leaving(edge, slope) >= kEnds.least_slant)
        add_peak(edge, stripe.covered, slope, roughness, log);
}

void EdgeModel::add_peak(const EdgeCrossing& edge, bool covered, double slope, double roughness,
                         std::vector<double>& log) const {
  const double place = foot(edge, slope);
  const double deviation = std::sqrt(variance_of(edge, slope, roughness));
  const double top = -std::log(deviation * std::sqrt(2 * std::numbers::pi));
  const double before = density_before(edge, covered), beyond = density_beyond();
  const double reach = deviation * std::sqrt(2 * std::max(0.0, top - before));
  const auto index = [this](double at) { return (at - grid_.first) / grid_.step; };
  const int from = std::max(0, static_cast<int>(std::ceil(index(place - reach))));
  const int to = std::min(grid_.count - 1, static_cast<int>(std::floor(index(place + reach))));
  for (int i = from; i <= to; ++i) {
    const double off = (grid_.at(i) - place) / deviation;
    log[i] += std::max(0.0, top - off * off / 2 - (off > 0 ? before : beyond));
  }
}

EdgeTold EdgeModel::told_at(double place, double slope, double roughness) const {
  EdgeTold told;
  for (const StripeEvidence& stripe : evidence_)
    for (const EdgeCrossing& edge : stripe.edges) {
      const double deviation = std::sqrt(variance_of(edge, slope, roughness));
      if (leaving(edge, slope) < kEnds.least_slant ||
          std::abs(foot(edge, slope) - place) > kFit.outlier * deviation)
        continue;
      ++told.crossings;
      told.occluded += edge.occluded;
      // Light ends over one edge in one way; of points that were thinned out none may lie nearer.
      told.common +=
          std::hypot(kEnds.common_deviation * edge.pixel, leaving(edge, slope) * edge.spread);
    }
  if (told.crossings > 0) told.common /= told.crossings;
  return told;
}

// The last foot before `limit` of a place that is seen past, as far from the seam as `away`.
std::optional<double> EdgeModel::seen_past_before(double limit, double away, double slope) const {
  std::optional<double> last;
  for (const Stretch& off : offs_) {
    const double from = away - off[0].away, reach = off[1].away - off[0].away;
    if (from * reach < 0 || std::abs(from) > std::abs(reach)) continue;
    const double share = reach == 0 ? 0 : from / reach;
    const double place = (1 - share) * foot(off[0], slope) + share * foot(off[1], slope);
    if (place < limit && (!last || place > *last)) last = place;
  }
  return last;
}

// A plate is there where it is seen. What lies behind a place that is seen past may be another
// thing as high.
void EdgeModel::add_on(const StripeEvidence& stripe, double slope, Steps& log) const {
  const auto farthest = farthest_on(stripe, slope, std::numeric_limits<double>::infinity());
  if (!farthest || foot(*farthest, slope) < grid_.first) return;
  const double place = foot(*farthest, slope);
  log.add_before(place, std::log(kEnds.accident));
  const auto past = seen_past_before(place, farthest->away, slope);
  if (!past) return;
  log.add_before(*past, std::log(kEnds.on_thing / kEnds.accident));
  if (const auto before = farthest_on(stripe, slope, *past))
    log.add_before(foot(*before, slope), std::log(kEnds.accident / kEnds.on_thing));
}

}  // namespace arcstart::seam_finding
