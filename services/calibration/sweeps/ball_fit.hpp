// A ball among scanned points.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace arcstart::calibration {

struct FittedBall {
  Eigen::Vector3d centre;               // with the radius known; mm
  double radius_mm;                     // with the radius free
  double rms_mm;                        // distance of the points from the ball of the known radius
  std::vector<Eigen::Vector3d> points;  // that lie on it
};

// The ball of about this radius with the most points within `tolerance` mm of it; by random
// sampling with a fixed seed, then least squares with a robust loss. Nothing where fewer than 60
// points lie on one.
std::optional<FittedBall> find_ball(const std::vector<Eigen::Vector3d>& points, double radius_mm,
                                    double tolerance);

}  // namespace arcstart::calibration
