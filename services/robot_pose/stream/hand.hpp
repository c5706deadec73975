// The pose of the robot's hand (pose_source.hpp), made from what a controller says of its flange.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "common/xyzwpr.hpp"
#include "services/robot_pose/pose_source.hpp"

namespace arcstart::robot_pose {

// robot_pose.tool_in_flange as T_flange_tool, mm: six numbers or none.
inline std::optional<Eigen::Isometry3d> tool_in_flange(const std::vector<double>& xyzwpr) {
  if (xyzwpr.size() != 6) return std::nullopt;
  Eigen::Isometry3d T_flange_tool = Eigen::Isometry3d::Identity();
  T_flange_tool.translation() << xyzwpr[0], xyzwpr[1], xyzwpr[2];
  T_flange_tool.linear() = rotation_from_wpr(xyzwpr[3], xyzwpr[4], xyzwpr[5]).toRotationMatrix();
  return T_flange_tool;
}

// Of a hand fixed in the flange.
inline void set_hand(ReportedPosition& reported, const Eigen::Isometry3d& T_base_flange,
                     const Eigen::Isometry3d& T_flange_tool) {
  const Eigen::Isometry3d T_base_tool = T_base_flange * T_flange_tool;
  reported.position = T_base_tool.translation();
  reported.rotation = Eigen::Quaterniond(T_base_tool.linear()).normalized();
  reported.tool_frame = T_flange_tool.isApprox(Eigen::Isometry3d::Identity(), 1e-12) ? 0 : -1;
}

}  // namespace arcstart::robot_pose
