#pragma once

namespace arcstart::calibration {

// What a calibration must reach to pass, and to go on in use: keys of section `calibration` of
// cell.yaml.
struct CalibrationLimits {
  double camera_residual_px = 1;        // reprojection of the plate's points, RMS
  double laser_residual_mm = 0.15;      // the stripes' points from the laser plane, RMS
  double leave_one_out_mm = 0.5;        // laser points of poses the calibration never saw, RMS
  double predicted_deviation_mm = 0.5;  // of a laser point in base, worst over the range, all axes
  double robot_deviation_mm = 1.5;      // of the robot's positions, per axis
  double robot_deviation_deg = 0.2;     // of its orientations, per axis

  double check_mm = 0.3;  // by which scans of one thing from several sides may disagree

  template <class Visitor, class Positive>
  void visit(Visitor& visitor, const Positive& positive) {
    visitor("camera_residual_px", camera_residual_px, positive);
    visitor("laser_residual_mm", laser_residual_mm, positive);
    visitor("leave_one_out_mm", leave_one_out_mm, positive);
    visitor("predicted_deviation_mm", predicted_deviation_mm, positive);
    visitor("robot_deviation_mm", robot_deviation_mm, positive);
    visitor("robot_deviation_deg", robot_deviation_deg, positive);
    visitor("check_mm", check_mm, positive);
  }
};

}  // namespace arcstart::calibration
