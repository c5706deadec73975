// The laser plane from stripes on the plate: every stripe pixel as an undistorted ray, cut with the
// plate's plane.
#pragma once

#include <optional>
#include <vector>

#include "common/sensor_model.hpp"
#include "services/calibration/target/target.hpp"
#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

// Of a stripe's centres (distorted pixels) those on its one straight line, at most `most` of them,
// evenly spread: a plane cuts a plane in a line. Empty where fewer than 20 lie on one.
std::vector<Eigen::Vector2d> straight_stripe(const SensorModel& camera,
                                             const std::vector<Eigen::Vector2d>& stripe, int most);

// In camera; mm. Those whose ray meets the plate.
std::vector<Eigen::Vector3d> stripe_on_plate(const SensorModel& camera,
                                             const RigidTransform& T_camera_plate,
                                             const std::vector<Eigen::Vector2d>& stripe);

struct LaserPlaneFit {
  Plane plane;        // its normal such that the camera lies at negative distance
  double rms_mm = 0;  // distance of the points
  double spread = 0;  // smallest extent of the points within the plane over the largest; near 0
                      // they lie on one line and say nothing of the plane
};

// Robust least squares over all points. Needs three that are not on a line.
LaserPlaneFit fit_laser_plane(const std::vector<Eigen::Vector3d>& points);

// The check by another way: where the stripe's line crosses the lines of the grid, the crossing's
// place follows from the invariance of the cross-ratio alone. Distance from where the rays put the
// stripe, each crossing between the grid's points; mm.
std::vector<double> crossing_differences(const SensorModel& camera, const Target& plate,
                                         const RigidTransform& T_camera_plate, const View& view);

}  // namespace arcstart::calibration
