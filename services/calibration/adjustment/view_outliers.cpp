#include "services/calibration/adjustment/view_outliers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/order_statistics.hpp"

namespace arcstart::calibration {
namespace {

// The greatest, where it exceeds a multiple of the median and an amount.
std::optional<std::size_t> odd_one(const std::vector<double>& values, double times, double least) {
  if (values.size() < 4) return std::nullopt;
  const auto worst = std::max_element(values.begin(), values.end());
  if (*worst <= std::max(least, times * median(std::vector(values)))) return std::nullopt;
  return static_cast<std::size_t>(worst - values.begin());
}

}  // namespace

std::optional<std::size_t> odd_image(const std::vector<double>& view_rms) {
  return odd_one(view_rms, 3, 0.15);
}

std::optional<std::size_t> odd_turn(const std::vector<double>& disagreement) {
  return odd_one(disagreement, 6, 1.5 * std::numbers::pi / 180);
}

std::optional<std::size_t> odd_stripe(const std::vector<double>& laser_rms_mm) {
  return odd_one(laser_rms_mm, 5, 0.1);
}

std::optional<std::size_t> odd_pose(const Adjustment& adjustment) {
  constexpr std::size_t kFewest = 6;  // with less, who is right cannot be told
  constexpr double kOdd = 6;          // mean square of a correction over its expectation
  if (adjustment.robot.size() < kFewest) return std::nullopt;
  double translations = 0, rotations = 0, translation_free = 0, rotation_free = 0;
  for (const RobotCorrection& c : adjustment.robot) {
    translations += c.translation.squaredNorm();
    rotations += c.rotation.squaredNorm();
    translation_free += c.translation_redundancy;
    rotation_free += c.rotation_redundancy;
  }
  double worst = 0;
  std::size_t worst_view = 0;
  for (std::size_t i = 0; i < adjustment.robot.size(); ++i) {
    const RobotCorrection& c = adjustment.robot[i];
    const double others_mm = (translations - c.translation.squaredNorm()) /
                             std::max(1e-6, translation_free - c.translation_redundancy);
    const double others_rad = (rotations - c.rotation.squaredNorm()) /
                              std::max(1e-6, rotation_free - c.rotation_redundancy);
    constexpr double kLeastMm = 0.02, kLeastRad = 2e-5;  // no matter how good the others are
    const double square = c.translation.squaredNorm() / std::max(others_mm, kLeastMm * kLeastMm) +
                          c.rotation.squaredNorm() / std::max(others_rad, kLeastRad * kLeastRad);
    const double mean = square / std::max(1.0, c.translation_redundancy + c.rotation_redundancy);
    if (mean > worst) {
      worst = mean;
      worst_view = i;
    }
  }
  if (worst <= kOdd) return std::nullopt;
  return worst_view;
}

}  // namespace arcstart::calibration
