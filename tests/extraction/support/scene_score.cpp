#include "tests/extraction/support/scene_score.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::extraction {
namespace {

constexpr double kNear = 3;  // px: a centre as far from the stripe is still one of its

double distance_to_piece(const Centre& centre, const TruthPoint& a, const TruthPoint& b) {
  const double du = b.u - a.u, dv = b.v - a.v, cu = centre.u - a.u, cv = centre.v - a.v;
  const double t = std::clamp((cu * du + cv * dv) / (du * du + dv * dv), 0.0, 1.0);
  return std::hypot(cu - t * du, cv - t * dv);
}

}  // namespace

double StripeSceneScore::rms() const {
  double sum = 0;
  for (const double error : errors) sum += error * error;
  return errors.empty() ? 0 : std::sqrt(sum / static_cast<double>(errors.size()));
}

double StripeSceneScore::p95() const {
  if (errors.empty()) return 0;
  std::vector<double> sorted = errors;
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(sorted.size())));
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

void StripeSceneScore::add(const StripeSceneScore& other) {
  errors.insert(errors.end(), other.errors.begin(), other.errors.end());
  visible += other.visible;
  recalled += other.recalled;
  centres += other.centres;
  wrong += other.wrong;
}

StripeSceneScore score(const StripeScene& scene, const std::vector<Centre>& centres,
                       double from_corners) {
  const auto& truth = scene.truth;
  const int count = static_cast<int>(truth.size());
  const double step = truth[1].u - truth[0].u;
  const int reach = static_cast<int>(8 / step);
  StripeSceneScore result;
  result.centres = centres.size();
  std::vector<char> recalled(truth.size(), 0);
  for (const Centre& centre : centres) {
    const int middle = std::clamp(static_cast<int>(centre.u / step), 0, count - 1);
    const int first = std::max(0, middle - reach), last = std::min(count - 1, middle + reach);
    double to_visible = 1e9, nearest = 1e9, corner = 0;
    for (int i = first; i <= last; ++i) {
      const double distance = std::hypot(centre.u - truth[i].u, centre.v - truth[i].v);
      if (distance <= kNear) recalled[i] = 1;
      if (truth[i].visible) to_visible = std::min(to_visible, distance);
    }
    if (to_visible > kNear) {
      ++result.wrong;
      continue;
    }
    for (int i = first; i < last; ++i) {
      const double distance = distance_to_piece(centre, truth[i], truth[i + 1]);
      if (distance >= nearest) continue;
      nearest = distance;
      corner = truth[i].corner;
    }
    if (corner >= from_corners) result.errors.push_back(nearest);
  }
  for (int i = 0; i + 1 < count; ++i) {
    if (!truth[i].visible || truth[i].v < 0 || truth[i].v >= scene.grey.rows) continue;
    const double length = std::hypot(step, truth[i + 1].v - truth[i].v);
    result.visible += length;
    result.recalled += recalled[i] * length;
  }
  return result;
}

}  // namespace arcstart::extraction
