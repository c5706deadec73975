// What the adjustment starts from, and what comes out of it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/sensor_model.hpp"

namespace arcstart::calibration {

// Standard deviations; the robot's per axis, of a pose.
struct Deviations {
  double pixel = 0.1;       // of a plate's point along u or v; px
  double laser_mm = 0.05;   // of a stripe's point from the laser plane
  double robot_mm = 0.3;    // translation, in base
  double robot_rad = 5e-4;  // rotation about the tool centre point
};

struct AdjustmentState {
  SensorModel model;
  RigidTransform T_tool_camera, T_base_plate;
  std::vector<RigidTransform> T_camera_plate;  // of each view; with the above they tell where the
                                               // robot was
};

struct AdjustmentOptions {
  bool camera_free = true;          // else camera and distortion stay as they are
  bool estimate_deviations = true;  // else they are taken as given
};

// How one pose of the robot had to be corrected.
struct RobotCorrection {
  Eigen::Vector3d translation;  // in base; mm
  Eigen::Vector3d rotation;     // vector in base, about the tool centre point; rad
  // Share of the three numbers that the data could contradict: 3 all, 0 none.
  double translation_redundancy = 0, rotation_redundancy = 0;
};

// Parameters of the covariance, in calibration_t's order without the time offset: fx fy cx cy;
// k1 k2 p1 p2 k3; tilt of the laser plane's normal about the first and second of plane_axes(), d;
// hand-eye's rotation vector (in tool: R = exp(w) R0) and position. px, 1, rad, mm.
constexpr int kSetParameters = 18;
using SetCovariance = Eigen::Matrix<double, kSetParameters, kSetParameters>;

struct Adjustment {
  AdjustmentState state;
  Deviations deviations;
  std::vector<RobotCorrection> robot;    // of each view
  std::vector<double> pixel_rms;         // of each view; px
  std::vector<double> laser_rms_mm;      // of each view; 0 where it has no stripe
  double camera_rms = 0, laser_rms = 0;  // of all; px, mm
  SetCovariance covariance;              // camera free, whether it was or not
  bool converged = false;
};

// Two axes that span the plane: the camera's x (its y where the normal lies along x) laid into it,
// and the normal cross it. A tilt a, b has the normal n + a axis1 + b axis2, normalised.
Eigen::Matrix<double, 3, 2> plane_axes(const Eigen::Vector3d& normal);

}  // namespace arcstart::calibration
