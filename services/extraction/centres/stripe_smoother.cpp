#include "services/extraction/centres/stripe_smoother.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::extraction {
namespace {

constexpr int kFewestPoints = 12;
// 1 / px: the bend that is nothing special. A pipe of 25 mm seen at 0.1 mm / px has 0.004.
constexpr double kUsualBend = 0.006;
constexpr double kFirstBend = 0.1;  // 1 / px, in the first round: no corner is smoothed away
constexpr int kRounds = 7;
// So many points count for one, times sigma. White noise has 2 sqrt(pi) in the middle of a long way
// and less at its ends and at corners.
constexpr double kPointsForOne = 2.5;

}  // namespace

std::size_t StripeSmoother::station_of(const SmoothedPoint& point) const {
  const long at = std::lround(point.along - origin_along_);
  return static_cast<std::size_t>(std::clamp(at, 0L, static_cast<long>(stations_.size()) - 1));
}

double StripeSmoother::slope_at(std::size_t at) const {
  const std::size_t before = at > 0 ? at - 1 : 0, after = std::min(at + 1, stations_.size() - 1);
  return (stations_[after].line - stations_[before].line) / static_cast<double>(after - before);
}

// The centres, moved along the line found so far to the whole px.
void StripeSmoother::observe(const std::vector<SmoothedPoint>& points) {
  for (const SmoothedPoint& point : points) {
    if (point.at_border) continue;
    const std::size_t at = station_of(point);
    const double slope = slope_at(at);
    const double ahead = origin_along_ + static_cast<double>(at) - point.along;
    Station& station = stations_[at];
    station.value = point.across - origin_across_ + slope * ahead;
    station.weight = 1 / (point.deviation * point.deviation * kPointsForOne * point.sigma);
    station.bow = point.sigma * point.sigma / 2 / (1 + slope * slope);
  }
}

// Normal equations of both sums, the right side in line.
void StripeSmoother::set_up() {
  const std::size_t last = stations_.size() - 1;
  for (Station& s : stations_) s.diagonal = s.next = s.after_next = s.line = 0;
  for (const std::size_t end : {std::size_t{0}, last}) {
    stations_[end].diagonal = stations_[end].weight;
    stations_[end].line = stations_[end].weight * stations_[end].value;
  }
  for (std::size_t k = 1; k < last; ++k) {
    Station &a = stations_[k - 1], &b = stations_[k], &c = stations_[k + 1];
    const double side = b.bow, middle = 1 - 2 * side;
    const double outer = b.weight * side * side + b.stiffness;
    const double inner = b.weight * side * middle - 2 * b.stiffness;
    a.diagonal += outer;
    b.diagonal += b.weight * middle * middle + 4 * b.stiffness;
    c.diagonal += outer;
    a.next += inner;
    b.next += inner;
    a.after_next += outer;
    const double pull = b.weight * b.value;
    a.line += side * pull;
    b.line += middle * pull;
    c.line += side * pull;
  }
}

// L D L^T, in place. False: the centres leave the line open.
bool StripeSmoother::solve() {
  const std::size_t size = stations_.size();
  for (std::size_t k = 0; k < size; ++k) {
    Station& here = stations_[k];
    if (!(here.diagonal > 0)) return false;
    const double inverse = 1 / here.diagonal, next = here.next, after_next = here.after_next;
    here.diagonal = inverse;
    here.next = next * inverse;
    here.after_next = after_next * inverse;
    if (k + 1 == size) break;
    stations_[k + 1].diagonal -= here.next * next;
    stations_[k + 1].next -= here.next * after_next;
    stations_[k + 1].line -= here.next * here.line;
    if (k + 2 == size) continue;
    stations_[k + 2].diagonal -= here.after_next * after_next;
    stations_[k + 2].line -= here.after_next * here.line;
  }
  double next = 0, after_next = 0;
  for (std::size_t k = size; k-- > 0;) {
    Station& here = stations_[k];
    here.line = here.line * here.diagonal - here.next * next - here.after_next * after_next;
    after_next = next;
    next = here.line;
  }
  return true;
}

// The weight of y''^2 that has the Cauchy density's slope at the bends found.
void StripeSmoother::stiffen(int reach) {
  const int last = static_cast<int>(stations_.size()) - 1;
  squares_.assign(stations_.size() + 1, 0);
  for (int k = 1; k <= last; ++k) {
    const double bend =
        k < last ? stations_[k - 1].line - 2 * stations_[k].line + stations_[k + 1].line : 0;
    squares_[k + 1] = squares_[k] + bend * bend;
  }
  for (int k = 1; k < last; ++k) {
    const int begin = std::max(1, k - reach), end = std::min(last, k + reach + 1);
    const double mean = (squares_[end] - squares_[begin]) / (end - begin);
    stations_[k].stiffness = 2 / (kUsualBend * kUsualBend + mean);
  }
}

// Diagonal of the inverse, from the factors backwards (Takahashi).
void StripeSmoother::find_deviations() {
  double z11 = 0, z12 = 0, z22 = 0;  // of the next two stations
  for (std::size_t k = stations_.size(); k-- > 0;) {
    Station& here = stations_[k];
    const double z01 = -here.next * z11 - here.after_next * z12,
                 z02 = -here.next * z12 - here.after_next * z22;
    const double z00 = here.diagonal - here.next * z01 - here.after_next * z02;
    here.deviation = std::sqrt(z00);
    z22 = z11;
    z12 = z01;
    z11 = z00;
  }
}

void StripeSmoother::smooth(std::vector<SmoothedPoint>& points) {
  const auto fitted = std::count_if(points.begin(), points.end(),
                                    [](const SmoothedPoint& point) { return !point.at_border; });
  const auto give_up = [&] {
    for (SmoothedPoint& point : points)
      if (point.at_border) point.deviation = 0;
  };
  if (fitted < kFewestPoints) return give_up();
  origin_along_ = std::round(points.front().along);
  origin_across_ = points[points.size() / 2].across;
  const auto length = std::lround(points.back().along - origin_along_);
  stations_.assign(static_cast<std::size_t>(std::max(length, 2L)) + 1, {});
  for (Station& station : stations_) station.stiffness = 2 / (kFirstBend * kFirstBend);
  for (int round = 0; round < kRounds; ++round) {
    observe(points);
    if (round > 0) stiffen(static_cast<int>(std::lround(points[points.size() / 2].sigma)));
    set_up();
    if (!solve()) return give_up();
  }
  find_deviations();
  for (SmoothedPoint& point : points) {
    const std::size_t at = station_of(point);
    const double ahead = point.along - origin_along_ - static_cast<double>(at);
    point.across = origin_across_ + stations_[at].line + slope_at(at) * ahead;
    point.deviation = stations_[at].deviation;
  }
}

}  // namespace arcstart::extraction
