#include "services/seam_finding/visibility/plate_bend.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "services/seam_finding/visibility/constants.hpp"

namespace arcstart::seam_finding {
namespace {

struct Height {
  double along, height;  // mm
};

// Least squares; nothing where the points do not tell it.
std::optional<PlateBend> parabola(const std::vector<Height>& heights) {
  if (heights.size() < kVisibility.bend_points) return std::nullopt;
  PlateBend bend;
  for (const Height& point : heights)
    bend.origin += point.along / static_cast<double>(heights.size());
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Height& point : heights) {
    const double x = point.along - bend.origin;
    const Eigen::Vector3d row(1, x, x * x);
    normal += row * row.transpose();
    right += point.height * row;
  }
  const Eigen::Vector3d solution = normal.ldlt().solve(right);
  bend.height = solution[0], bend.slope = solution[1], bend.curvature = solution[2];
  return bend;
}

}  // namespace

PlateBend plate_bend(const ScanCloud& cloud, const JointPlate& plate, const Line& line,
                     const Eigen::Vector3d& away, const Scales& scales) {
  std::vector<Height> near;  // the plate's plane, on its side of the seam
  const std::size_t step = 1 + cloud.points.size() / kVisibility.bend_sample;
  for (std::size_t i = 0; i < cloud.points.size(); i += step) {
    const Eigen::Vector3d& point = cloud.points[i];
    const double height = plate.plane.signed_distance(point);
    const double r = away.dot(point - line.point);
    if (std::abs(height) < kVisibility.most_bent && r > kVisibility.near_seam &&
        r < kVisibility.bend_reach)
      near.push_back({line.along(point), height});
  }
  PlateBend bend;
  double rms = 0;
  for (int pass = 0; pass < kVisibility.bend_passes; ++pass) {
    std::vector<Height> on;
    std::copy_if(near.begin(), near.end(), std::back_inserter(on), [&](const Height& point) {
      return std::abs(point.height - bend.at(point.along)) < scales.tolerance;
    });
    const auto fitted = parabola(on);
    if (!fitted) return {};
    bend = *fitted;
    rms = 0;
    for (const Height& point : on)
      rms += std::pow(point.height - bend.at(point.along), 2) / static_cast<double>(on.size());
    rms = std::sqrt(rms);
  }
  // What a step parts is two plates.
  if (rms > kVisibility.bend_noises * scales.noise) return {};
  return std::abs(bend.curvature) >= kVisibility.least_curved &&
                 std::abs(bend.curvature) <= kVisibility.most_curved
             ? bend
             : PlateBend{};
}

}  // namespace arcstart::seam_finding
