#include "services/calibration/target/circle_centres.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace arcstart::calibration {
namespace {

// Plate to image, near one of its points: image = at + to_image * (plate - point).
Eigen::Matrix3d homography(const Target& plate, const std::vector<cv::Point2f>& centres) {
  std::vector<cv::Point2f> model;
  for (const Eigen::Vector3d& point : plate.points())
    model.push_back({static_cast<float>(point.x()), static_cast<float>(point.y())});
  const cv::Mat found = cv::findHomography(model, centres);
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  if (found.empty()) return result;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) result(row, column) = found.at<double>(row, column);
  return result;
}

Eigen::Matrix2d derivative(const Eigen::Matrix3d& homography, const Eigen::Vector3d& point) {
  const Eigen::Vector3d image = homography * Eigen::Vector3d(point.x(), point.y(), 1);
  return (homography.topLeftCorner<2, 2>() -
          image.head<2>() / image.z() * homography.bottomLeftCorner<1, 2>()) /
         image.z();
}

// Calls visit(x, y, grey, distance) for the pixels within `radius` mm of a point of the plate,
// distance and x, y in mm on the plate, from it.
template <class Visit>
void for_pixels_about(const cv::Mat& grey, const Eigen::Vector2d& centre,
                      const Eigen::Matrix2d& to_image, double radius, const Visit& visit) {
  const Eigen::Matrix2d to_plate = to_image.inverse();
  const Eigen::Vector2d reach = radius * to_image.rowwise().norm();
  const int left = std::max(0, static_cast<int>(std::ceil(centre.x() - reach.x())));
  const int right = std::min(grey.cols - 1, static_cast<int>(std::floor(centre.x() + reach.x())));
  const int top = std::max(0, static_cast<int>(std::ceil(centre.y() - reach.y())));
  const int bottom = std::min(grey.rows - 1, static_cast<int>(std::floor(centre.y() + reach.y())));
  for (int v = top; v <= bottom; ++v)
    for (int u = left; u <= right; ++u) {
      const Eigen::Vector2d place = to_plate * (Eigen::Vector2d(u, v) - centre);
      if (const double distance = place.norm(); distance < radius)
        visit(place, grey.at<std::uint8_t>(v, u), distance);
    }
}

}  // namespace

std::vector<Eigen::Vector2d> refine_circle_centres(const cv::Mat& grey, const Target& plate,
                                                   const std::vector<Eigen::Vector2d>& centres) {
  constexpr int kSteps = 4;
  std::vector<cv::Point2f> coarse;
  for (const auto& c : centres)
    coarse.push_back({static_cast<float>(c.x()), static_cast<float>(c.y())});
  const Eigen::Matrix3d whole = homography(plate, coarse);
  const std::vector<Eigen::Vector3d> model = plate.points();
  const double nearest =
      plate.pitch_mm * (plate.pattern == TargetPattern::asymmetric_circles ? std::sqrt(2.0) : 1);
  std::vector<Eigen::Vector2d> result = centres;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Eigen::Matrix2d to_image = derivative(whole, model[i]);
    if (!(std::abs(to_image.determinant()) > 1e-6)) continue;
    // Half way from this circle's edge to its neighbours'.
    const double radius = plate.radius(static_cast<int>(i));
    const double reach = (radius + nearest - plate.radius_mm) / 2;
    for (int step = 0; step < kSteps; ++step) {
      // The white about it, as a plane over the plate.
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      for_pixels_about(grey, result[i], to_image, reach,
                       [&](const Eigen::Vector2d& place, double value, double distance) {
                         if (distance < (radius + reach) / 2) return;
                         const Eigen::Vector3d row(1, place.x(), place.y());
                         normal += row * row.transpose();
                         right += row * value;
                       });
      const Eigen::Vector3d white = normal.ldlt().solve(right);
      double area = 0;
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for_pixels_about(grey, result[i], to_image, reach,
                       [&](const Eigen::Vector2d& place, double value, double) {
                         const double level = white.dot(Eigen::Vector3d(1, place.x(), place.y()));
                         const double darkness = 1 - value / std::max(level, 1.0);
                         area += darkness;
                         sum += darkness * place;
                       });
      const Eigen::Vector2d shift = to_image * (sum / area);
      // A circle that runs out of the image or under glare has no middle: its rough one stays.
      if (!shift.allFinite() || shift.norm() > 0.5 * radius * to_image.norm()) break;
      result[i] += shift;
      if (shift.norm() < 1e-4) break;
    }
  }
  return result;
}

double brightness_around_origin(const cv::Mat& grey, const Target& plate,
                                const std::vector<cv::Point2f>& centres) {
  const Eigen::Matrix2d to_image = derivative(homography(plate, centres), Eigen::Vector3d::Zero());
  if (!(std::abs(to_image.determinant()) > 1e-6)) return 255;
  double sum = 0;
  int count = 0;
  for_pixels_about(grey, {centres[0].x, centres[0].y}, to_image, 0.9 * plate.origin_dot_radius_mm,
                   [&](const Eigen::Vector2d&, double value, double distance) {
                     if (distance < 0.7 * plate.origin_dot_radius_mm) return;
                     sum += value;
                     ++count;
                   });
  return count > 0 ? sum / count : 255;
}

}  // namespace arcstart::calibration
