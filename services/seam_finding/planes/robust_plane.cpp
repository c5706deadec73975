#include "services/seam_finding/planes/robust_plane.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "common/order_statistics.hpp"
#include "services/seam_finding/fit/biweight_sums.hpp"
#include "services/seam_finding/planes/constants.hpp"
#include "services/seam_finding/planes/interreflection.hpp"

namespace arcstart::seam_finding {
namespace {

// Points as heights above a first plane, at places in it: there all numbers are small or need not
// be exact, so that floats do, side by side. The line lies in that plane.
class Heights {
 public:
  Heights(const std::vector<Eigen::Vector3d>& points, const Line& line, const Plane& first)
      : normal_(first.normal) {
    along_ = (line.direction - line.direction.dot(normal_) * normal_).normalized();
    across_ = normal_.cross(along_);
    origin_ = line.point - first.signed_distance(line.point) * normal_;
    const std::size_t padded = whole_registers(points.size());
    a_.assign(padded, 0), b_.assign(padded, 0), distance_.assign(padded, 0);
    h_.assign(padded, kPlanes.far_off);
    count_ = points.size();
    for (std::size_t i = 0; i < count_; ++i) {
      const Eigen::Vector3d p = points[i] - origin_;
      a_[i] = static_cast<float>(along_.dot(p));
      b_[i] = static_cast<float>(across_.dot(p));
      h_[i] = static_cast<float>(normal_.dot(p));
    }
    for (std::size_t i = 0; i < count_; ++i)
      distance_[i] = std::sqrt(b_[i] * b_[i] + h_[i] * h_[i]);
  }

  // height = offset + along * a + across * b: a plane not far from the first.
  struct Model {
    double offset = 0, along = 0, across = 0;
  };
  Plane plane(const Model& model) const {
    Plane plane;
    plane.normal = (normal_ - model.along * along_ - model.across * across_).normalized();
    plane.offset = -plane.normal.dot(origin_ + model.offset * normal_);
    return plane;
  }

  std::size_t size() const { return count_; }
  float distance(std::size_t i) const { return distance_[i]; }  // from the line
  double residual(const Model& model, std::size_t i) const {
    return h_[i] - model.offset - model.along * a_[i] - model.across * b_[i];
  }

  void lower_by(const InterreflectionShift& shift) {
    for (std::size_t i = 0; i < count_; ++i) h_[i] -= static_cast<float>(shift(distance_[i]));
  }

  Model narrowed(Model model, double noise, std::initializer_list<double> limits) const;
  // The same, but that only those of some strips count. strip_of: of each point.
  using Strips = std::bitset<kStrips>;
  Heights chosen(const std::vector<std::uint8_t>& strip_of, const Strips& strips) const;

 private:
  Eigen::Vector3d normal_, along_, across_, origin_;
  std::size_t count_ = 0;
  std::vector<float> a_, b_, h_, distance_;  // filled up to whole registers
};

// The limit narrows from pass to pass, so that what agrees within the noise prevails over what was
// drawn aside.
Heights::Model Heights::narrowed(Model model, double noise,
                                 std::initializer_list<double> limits) const {
  double settled_at = 0;
  for (const double limit : limits) {
    if (limit == settled_at) continue;
    const BiweightSums s =
        biweight_sums({a_.data(), b_.data(), h_.data(), h_.size()}, model.offset, model.along,
                      model.across, limit * kFit.tukey_limit * noise);
    if (s.w < static_cast<double>(kFit.plane_points / 2)) return model;
    // Of the smaller spread within the plane.
    const double ma = s.a / s.w, mb = s.b / s.w;
    const double vaa = s.aa / s.w - ma * ma, vab = s.ab / s.w - ma * mb, vbb = s.bb / s.w - mb * mb;
    const double least = (vaa + vbb) / 2 - std::hypot((vaa - vbb) / 2, vab);
    if (!(least > kPlanes.least_extent * noise * kPlanes.least_extent * noise)) return model;
    Eigen::Matrix3d normal_equations;
    normal_equations << s.w, s.a, s.b, s.a, s.aa, s.ab, s.b, s.ab, s.bb;
    const Eigen::Vector3d step = normal_equations.inverse() * Eigen::Vector3d(s.r, s.ra, s.rb);
    model.offset += step[0], model.along += step[1], model.across += step[2];
    const double change =
        std::abs(step[0]) + kPlanes.fit_reach * (std::abs(step[1]) + std::abs(step[2]));
    settled_at = change < kPlanes.settled ? limit : 0;
  }
  return model;
}

Heights Heights::chosen(const std::vector<std::uint8_t>& strip_of, const Strips& strips) const {
  Heights some = *this;
  for (std::size_t i = 0; i < count_; ++i)
    if (!strips[strip_of[i]]) some.h_[i] = kPlanes.far_off;
  return some;
}

// Standard deviation of the points from a plane, as their median distance tells it; mm. A plate may
// be rougher than the cloud is where it is smoothest.
double spread_about(const Heights& points, const Heights::Model& model) {
  const std::size_t every = 1 + points.size() / kPlanes.spread_sample;
  std::vector<float> distances;
  distances.reserve(points.size() / every + 1);
  for (std::size_t i = 0; i < points.size(); i += every)
    distances.push_back(static_cast<float>(std::abs(points.residual(model, i))));
  return kFit.median_to_deviation * median(distances);
}

// The strip along the line that each point lies in: strips of equal numbers, counted from the line
// outward. Points are put into bins by their distance; in order are those bins alone in which one
// strip borders on the next.
std::vector<std::uint8_t> strips_of(const Heights& points) {
  float low = points.distance(0), high = low;
  for (std::size_t i = 0; i < points.size(); ++i)
    low = std::min(low, points.distance(i)), high = std::max(high, points.distance(i));
  const float bins_each_mm = (kPlanes.bins - 1) / std::max(high - low, 1e-6f);
  std::vector<std::uint16_t> bins(points.size());
  std::array<int, kPlanes.bins + 1> begins{};  // of each bin's points in their order
  for (std::size_t i = 0; i < points.size(); ++i) {
    bins[i] = static_cast<std::uint16_t>((points.distance(i) - low) * bins_each_mm);
    ++begins[bins[i] + 1u];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::array<int, kPlanes.bins + 1> next = begins;
  std::vector<int> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[next[bins[i]]++] = static_cast<int>(i);
  std::vector<std::uint8_t> strips(points.size());
  for (std::size_t k = 0; k < kStrips; ++k) {
    const std::size_t first = order.size() * k / kStrips, last = order.size() * (k + 1) / kStrips;
    if (last < order.size()) {
      const auto bin = bins[order[last]];
      std::stable_sort(order.begin() + begins[bin], order.begin() + begins[bin + 1u],
                       [&](int a, int b) { return points.distance(a) < points.distance(b); });
    }
    for (std::size_t i = first; i < last; ++i) strips[order[i]] = static_cast<std::uint8_t>(k);
  }
  return strips;
}

// The strips' means. Nothing where one has no points within the noise.
std::optional<StripMeans> means_of(const Heights& points, const std::vector<std::uint8_t>& strip_of,
                                   const Heights::Model& model, double noise) {
  StripMeans strips{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double height = points.residual(model, i);
    if (std::abs(height) > kFit.tukey_limit * noise) continue;
    Strip& strip = strips[strip_of[i]];
    strip.distance += points.distance(i), strip.height += height, ++strip.points;
  }
  for (Strip& strip : strips) {
    if (strip.points == 0) return std::nullopt;
    strip.distance /= strip.points, strip.height /= strip.points;
  }
  return strips;
}

}  // namespace

Plane robust_plane(const std::vector<Eigen::Vector3d>& points, const Line& line, const Plane& plane,
                   double noise) {
  if (points.size() < kFit.plane_points) return plane;
  Heights heights(points, line, plane);
  double allowed = std::max(noise, spread_about(heights, {}) / kPlanes.roughness);
  Heights::Model model =
      heights.narrowed({}, allowed, {4.0, 4.0, 2.0, 2.0, 1.0, 1.0, 0.6, 0.6, 0.6, 0.6});
  allowed = std::max(noise, spread_about(heights, model) / kPlanes.roughness);
  const auto strip_of = strips_of(heights);
  const auto strips = means_of(heights, strip_of, model, allowed);
  if (!strips) return heights.plane(model);
  const ConsistentStrips agreed = consistent_strips(*strips, allowed);
  if (agreed.shift.most != 0) heights.lower_by(agreed.shift);
  model = heights.chosen(strip_of, agreed.strips).narrowed(model, allowed, {1.0, 1.0, 1.0, 1.0});
  return heights.plane(model);
}

Plane robust_plane(const ScanCloud& cloud, const std::vector<int>& chosen, const Line& line,
                   const Plane& plane, double noise) {
  if (chosen.size() < kFit.plane_points) return plane;
  std::vector<Eigen::Vector3d> points;
  const std::size_t together = 1 + chosen.size() / kCloud.sample;
  points.reserve(chosen.size() / together + cloud.stripes.size() + 1);
  for (std::size_t first = 0, last = 0; first < chosen.size(); first = last) {
    const int stripe = cloud.origins[chosen[first]].stripe;
    Eigen::Vector3d sum = cloud.points[chosen[first]];
    for (last = first + 1; stripe >= 0 && last < std::min(first + together, chosen.size()) &&
                           cloud.origins[chosen[last]].stripe == stripe;
         ++last)
      sum += cloud.points[chosen[last]];
    points.push_back(sum / static_cast<double>(last - first));
  }
  return robust_plane(points, line, plane, noise);
}

}  // namespace arcstart::seam_finding
