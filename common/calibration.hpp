// The calibration of a laser-stripe sensor on a robot: camera, laser plane and hand-eye, one set
// that belongs together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/sensor_model.hpp"

namespace arcstart {

// How a set was judged when it was made, and against which limits; -1 for none.
struct CalibrationVerdict {
  enum class Passed { kNotJudged, kPassed, kFailed };
  Passed passed = Passed::kNotJudged;   // not judged: made before calibrations kept a verdict
  double camera_limit = -1;             // px
  double laser_plane_limit = -1;        // mm
  double leave_one_out_limit = -1;      // mm
  double predicted_limit = -1;          // mm
  double robot_position_limit = -1;     // mm
  double robot_orientation_limit = -1;  // rad
  int poses = -1;                       // that were used
  std::string forced_by;                // who put a failed one into use; empty: nobody
};

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
  CalibrationVerdict verdict;

  // Covariance of the set, row by row: fx fy cx cy; k1 k2 p1 p2 k3; tilt of the laser plane's
  // normal about two axes in it, d; hand-eye's rotation vector in tool and position; time offset.
  // px, 1, rad, mm, s squared. Empty where not known.
  static constexpr int kParameters = 19;
  std::vector<double> covariance;
};

// Why the set cannot be used (no id, a number impossible, a sensor that cannot be); empty where it
// can.
std::string calibration_error(const Calibration& calibration);

// Why what is measured with the set is not to be acted on: it failed, or was never judged. Empty
// where it passed.
std::string distrust(const CalibrationVerdict& verdict);

// Why the set is not this sensor's on this robot; empty where it is.
std::string instance_error(const Calibration& calibration, const std::string& sensor,
                           const std::string& robot);

}  // namespace arcstart
