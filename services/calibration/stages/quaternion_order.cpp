#include "services/calibration/stages/quaternion_order.hpp"

#include <fmt/core.h>

#include <cmath>

namespace arcstart::calibration {
namespace {

constexpr double kWrong = 20;  // mm between where the views put the plate: no robot is so bad
constexpr double kBetter = 5;  // times better in the other order

// RMS distance of the plate's points, carried to base by each view, from their mean; mm.
double consistency(const std::vector<RigidTransform>& T_base_tool,
                   const std::vector<RigidTransform>& T_camera_plate,
                   const std::vector<Eigen::Vector3d>& points) {
  return best_method(closed_form_hand_eye(T_base_tool, T_camera_plate, points)).consistency_mm;
}

// What was read as w, x, y, z was x, y, z, w.
RigidTransform reordered(const RigidTransform& read) {
  const Eigen::Quaterniond q(read.linear());
  return make_transform(read.translation(), {q.z(), q.w(), q.x(), q.y()});
}

}  // namespace

std::string quaternion_slip(const std::vector<RigidTransform>& T_base_tool,
                            const std::vector<RigidTransform>& T_camera_plate,
                            const std::vector<Eigen::Vector3d>& points) {
  const double as_given = consistency(T_base_tool, T_camera_plate, points);
  if (as_given < kWrong) return "";
  std::vector<RigidTransform> other;
  for (const RigidTransform& pose : T_base_tool) other.push_back(reordered(pose));
  const double as_other = consistency(other, T_camera_plate, points);
  if (!std::isfinite(as_other) || kBetter * as_other > as_given) return "";
  return fmt::format(
      "the robot's poses put the plate {:.0f} mm apart, but within {:.1f} mm with quaternions read "
      "as x, y, z, w: poses.csv wants qw,qx,qy,qz, the scalar first",
      as_given, as_other);
}

}  // namespace arcstart::calibration
