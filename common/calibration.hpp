// The calibration of a laser-stripe sensor on a robot: camera, laser plane and hand-eye, one set
// that belongs together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/sensor_model.hpp"

namespace arcstart {

struct Calibration {
  std::string id;         // names this set of numbers
  std::string sensor;     // LASER0
  std::string robot;      // ROBOT0
  std::string tool;       // the robot's tool frame that the hand-eye refers to
  std::int64_t made = 0;  // us, UTC
  SensorModel sensor_model;
  RigidTransform T_tool_camera = RigidTransform::Identity();  // hand-eye
  double time_offset = 0;            // added to an image's utime to look up the position; s
  double camera_residual = -1;       // RMS of the reprojection; px, -1 where not known
  double laser_plane_residual = -1;  // RMS distance of its points; mm, -1 where not known
  double hand_eye_residual = -1;  // RMS consistency of the target in base; mm, -1 where not known
  std::string origin;             // how it was made, for people

  // Covariance of the set, row by row: fx fy cx cy; k1 k2 p1 p2 k3; tilt of the laser plane's
  // normal about two axes in it, d; hand-eye's rotation vector in tool and position; time offset.
  // px, 1, rad, mm, s squared. Empty where not known.
  static constexpr int kParameters = 19;
  std::vector<double> covariance;
};

// Why the set cannot be used (no id, a number impossible, a sensor that cannot be); empty where it
// can.
std::string calibration_error(const Calibration& calibration);

// Why the set is not this sensor's on this robot; empty where it is.
std::string instance_error(const Calibration& calibration, const std::string& sensor,
                           const std::string& robot);

}  // namespace arcstart
