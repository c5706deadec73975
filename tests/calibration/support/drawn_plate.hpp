// A calibration plate and the stripe on it, drawn by OpenCV: no part of arcstart's own geometry.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace arcstart::test {

// 5 x 9 staggered circles of 4 mm radius, rows 12 mm apart, as plate.yaml says it.
extern const char* const kPlateYaml;

struct DrawnPose {
  cv::Vec3d turn;   // Rodrigues, plate to camera
  cv::Vec3d place;  // of the plate's first point in camera; mm
};

// 800 x 600, f = 1000 px, without distortion.
cv::Mat draw_grid(const DrawnPose& pose);
// Of the stripe: a line across the middle of the plate; x_shift moves it along the image, px.
cv::Mat draw_laser(const DrawnPose& pose, double x_shift = 0);

}  // namespace arcstart::test
