// What the pipeline is told of sensor and positions, which need not be true; and the points that
// follow from it.
#pragma once

#include <optional>

#include "services/cell_simulator/image/sensor_camera.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::seam_finding::synthetic {

// The true sensor with the error of calibration that the scene has: the same for every scan of it.
cell_simulator::TrueSensor told_sensor(const cell_simulator::WildScene& wild,
                                       const cell_simulator::TrueSensor& sensor);

// What the robot says where it is truly in this pose: wrong by a smooth wave along its way.
RigidTransform told_pose(const cell_simulator::WildScene& wild, const RigidTransform& T_base_tool);

// The point of the sensor's laser plane that a pixel shows, in camera; nothing where its ray does
// not meet the plane ahead.
std::optional<Eigen::Vector3d> on_sheet(const cell_simulator::TrueSensor& sensor,
                                        const Eigen::Vector2d& pixel);

}  // namespace arcstart::seam_finding::synthetic
