// Whether a calibration still holds, without a plate: the same thing scanned from two sides must
// stand in one place and have its known shape.
#pragma once

#include <string>
#include <vector>

#include "services/calibration/sweeps/sweep_profiles.hpp"

namespace arcstart::calibration {

// What one scan says of the thing.
struct ScanView {
  std::int64_t scan_id = 0;
  RigidTransform T_base_tool;  // in its middle
  std::size_t points = 0;
  Eigen::Vector3d centre;  // of the ball, in base; mm
  double radius_mm = 0;    // of the ball, as this scan has it
  double shape_mm = 0;     // RMS distance of its points from the ball of known radius, or from its
                           // own faces
};

struct DriftCheck {
  std::string refused;                // why nothing can be said, and what is missing
  std::vector<std::string> warnings;  // a line each
  double error_mm = 0;       // the largest of the three: how far the scans are from agreeing
  double place_mm = 0;       // how far a scan puts the thing from where all have it
  double radius_mm = 0;      // largest error of the ball's radius
  double shape_mm = 0;       // largest RMS distance of a scan's points from the ball
  double predicted_mm = -1;  // a point's standard deviation, as the calibration's covariance has it
  double turn_deg = 0;       // largest turn of the tool between two scans
  // By how much a sensor shifted by 1 mm would make the scans disagree, in the three directions of
  // the tool in which it shows most and least; mm.
  Eigen::Vector3d shift_shown = Eigen::Vector3d::Zero();
  int faces = 0;  // that two scans have in common
  std::vector<ScanView> views;
};

// A ball of known radius in every scan, on a table or a foot.
DriftCheck check_on_ball(const SweepData& record, const Calibration& calibration, double radius_mm);

// Flat faces that two scans see alike, where both see them.
DriftCheck check_on_faces(const SweepData& record, const Calibration& calibration);

// Why the calibration is to be made anew; empty where it still holds. It has drifted where the
// error is over the limit, or over four times what the calibration itself expects and over what a
// robot's repeatability explains.
std::string drift(const DriftCheck& agreement, double limit_mm);

}  // namespace arcstart::calibration
