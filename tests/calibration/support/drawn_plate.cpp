#include "tests/calibration/support/drawn_plate.hpp"

#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace arcstart::test {

namespace {

constexpr int kColumns = 5, kRows = 9, kShift = 6;  // fractional bits of drawn corners
constexpr double kPitch = 12, kRadius = 4;

std::vector<cv::Point2d> project(const DrawnPose& pose, const std::vector<cv::Point3d>& points) {
  const cv::Mat camera = (cv::Mat_<double>(3, 3) << 1000, 0, 399.5, 0, 1000, 299.5, 0, 0, 1);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, pose.turn, pose.place, camera, cv::noArray(), pixels);
  return pixels;
}

void fill(cv::Mat& image, const std::vector<cv::Point2d>& corners, int grey) {
  std::vector<cv::Point> scaled;
  for (const cv::Point2d& corner : corners)
    scaled.emplace_back(cvRound(corner.x * (1 << kShift)), cvRound(corner.y * (1 << kShift)));
  cv::fillConvexPoly(image, scaled, grey, cv::LINE_AA, kShift);
}

}  // namespace

const char* const kPlateYaml =
    "pattern: asymmetric_circles\ncolumns: 5\nrows: 9\npitch_mm: 12\nradius_mm: 4\n";

cv::Mat draw_grid(const DrawnPose& pose) {
  cv::Mat image(600, 800, CV_8U, cv::Scalar(40));
  const double width = kPitch * (2 * kColumns - 1), height = kPitch * (kRows - 1), edge = 20;
  fill(image,
       project(pose, {{-edge, -edge, 0},
                      {width + edge, -edge, 0},
                      {width + edge, height + edge, 0},
                      {-edge, height + edge, 0}}),
       190);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      std::vector<cv::Point3d> rim;
      for (int i = 0; i < 72; ++i) {
        const double angle = i * std::numbers::pi / 36;
        rim.emplace_back(kPitch * (2 * column + row % 2) + kRadius * std::cos(angle),
                         kPitch * row + kRadius * std::sin(angle), 0);
      }
      fill(image, project(pose, rim), 30);
    }
  cv::GaussianBlur(image, image, {}, 0.7);
  return image;
}

cv::Mat draw_laser(const DrawnPose& pose, double x_shift) {
  const double width = kPitch * (2 * kColumns - 1), middle = kPitch * (kRows - 1) / 2;
  const auto ends = project(pose, {{-15, middle, 0}, {width + 15, middle, 0}});
  cv::Mat image(600, 800, CV_8U, cv::Scalar(4));
  const auto fixed = [&](const cv::Point2d& p) {
    return cv::Point(cvRound((p.x + x_shift) * (1 << kShift)), cvRound(p.y * (1 << kShift)));
  };
  cv::line(image, fixed(ends[0]), fixed(ends[1]), 250, 4, cv::LINE_AA, kShift);
  cv::GaussianBlur(image, image, {}, 1.6);
  return image;
}

}  // namespace arcstart::test
