// The plate's points in an image.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

// Distorted pixels of the plate's points, in its order and so that x, y, z of the plate are
// right-handed with z away from the camera; none where the whole pattern is not found. A pattern
// that looks the same after a turn may come turned. Circles: centre of the dark area, which is the
// centre of the ellipse, not the image of the circle's centre.
std::vector<Eigen::Vector2d> detect_target(const cv::Mat& grey, const Target& plate);

}  // namespace arcstart::calibration
