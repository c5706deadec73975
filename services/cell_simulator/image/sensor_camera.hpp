// The true sensor, from its settings: where a point is seen, where the laser's sheet lies, where
// the robot is taught to hold it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "common/geometry.hpp"
#include "services/cell_simulator/image/sensor_settings.hpp"
#include "services/cell_simulator/scene/scene_settings.hpp"

namespace arcstart::cell_simulator {

// In camera (x right, y down, z ahead; mm) where nothing else is said. The laser plane holds the
// points p with laser_normal.dot(p) + laser_offset = 0; the normal points along the search in the
// taught poses.
struct TrueSensor {
  int width, height;                 // px
  double fx, fy, cx, cy;             // px, pixel centres at integers
  std::array<double, 5> distortion;  // k1, k2, p1, p2, k3
  Eigen::Vector3d laser_normal;
  double laser_offset;            // mm
  Eigen::Vector3d projector;      // whence the fan spreads
  Eigen::Vector3d fan_direction;  // its middle, unit
  double fan_half_angle;          // rad
  RigidTransform T_tool_camera;
};

TrueSensor make_true_sensor(const SensorSettings& settings);

// Distorted pixel of a point in camera, by Brown's forward model. Nothing behind the camera or so
// far aside (1.5 times the half field of view) that the model's polynomial means nothing.
std::optional<Eigen::Vector2d> see(const TrueSensor& sensor, const Eigen::Vector3d& point);

// T_base_tool in which the optical axis, leaning over the open side and square to the search
// direction, meets the taught work's root line `along_mm` from its middle at the stand-off
// distance. The laser plane meets it there too. A search that rises is higher or lower there, one
// that is turned looks and runs another way.
RigidTransform taught_tool_pose(const SensorSettings& sensor, const SceneSettings& scene,
                                double along_mm);

}  // namespace arcstart::cell_simulator
