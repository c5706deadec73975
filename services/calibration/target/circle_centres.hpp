// Where a circle's dark area has its middle, to a hundredth of a pixel.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

// The centroid of each circle's darkness, from grey values, so that neither blur nor a slow change
// of the light moves it. centres: good to a few px, distorted pixels; so is the result.
std::vector<Eigen::Vector2d> refine_circle_centres(const cv::Mat& grey, const Target& plate,
                                                   const std::vector<Eigen::Vector2d>& centres);

// The grey value between the radius of an ordinary circle and that of the larger one, about the
// first point: low where that is the larger one.
double brightness_around_origin(const cv::Mat& grey, const Target& plate,
                                const std::vector<cv::Point2f>& centres);

}  // namespace arcstart::calibration
