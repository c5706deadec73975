#include "services/command_line/clouds/viewpoints.hpp"

#include <Eigen/Geometry>
#include <numbers>

namespace arcstart::command_line {
namespace {

constexpr double kHeight = 1000;  // mm
constexpr int kAround = 8;

// On the plane, below the points' middle.
Eigen::Vector3d foot_of(const std::vector<Eigen::Vector3d>& points, const Plane& plane) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : points) middle += point / static_cast<double>(points.size());
  return middle - plane.signed_distance(middle) * plane.normal;
}

}  // namespace

Eigen::Vector3d viewpoint_above(const std::vector<Eigen::Vector3d>& points, const Plane& plane) {
  return foot_of(points, plane) + kHeight * plane.normal;
}

std::vector<Eigen::Vector3d> other_viewpoints(const std::vector<Eigen::Vector3d>& points,
                                              const Plane& plane, bool both_sides) {
  const Eigen::Vector3d foot = foot_of(points, plane), up = plane.normal;
  std::vector<Eigen::Vector3d> places;
  for (const double side : {1.0, -1.0}) {
    if (side < 0 && !both_sides) break;
    for (int i = 0; i < kAround; ++i) {
      const Eigen::AngleAxisd turn(2 * std::numbers::pi * i / kAround, up);
      places.push_back(foot + kHeight * (side * up + turn * up.unitOrthogonal()));
    }
  }
  return places;
}

}  // namespace arcstart::command_line
