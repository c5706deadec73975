#include "services/calibration/capture/image_quality.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "common/order_statistics.hpp"

namespace arcstart::calibration {
namespace {

constexpr double kLeastContrast = 40;    // grey values
constexpr double kMostSaturated = 0.05;  // share of the plate's pixels
constexpr double kMostBlur = 3;          // standard deviation of an edge; px
constexpr int kFewestCentres = 20;       // of the stripe, on the plate
constexpr double kMostStripeSaturated = 0.3;

std::vector<cv::Point2f> hull_of(const std::vector<Eigen::Vector2d>& points) {
  std::vector<cv::Point2f> all, hull;
  for (const Eigen::Vector2d& p : points)
    all.push_back({static_cast<float>(p.x()), static_cast<float>(p.y())});
  cv::convexHull(all, hull);
  return hull;
}

std::string plate_trouble(const cv::Mat& grid, const std::vector<cv::Point2f>& hull) {
  cv::Mat inside = cv::Mat::zeros(grid.size(), CV_8U);
  std::vector<cv::Point> corners;
  for (const cv::Point2f& corner : hull) corners.emplace_back(corner);
  cv::fillConvexPoly(inside, corners, 255);
  cv::Mat along, down;
  cv::Sobel(grid, along, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(grid, down, CV_32F, 0, 1, 3, 1.0 / 8);
  std::vector<std::uint8_t> greys;
  std::vector<float> slopes;
  const cv::Rect box = cv::boundingRect(corners) & cv::Rect(0, 0, grid.cols, grid.rows);
  for (int v = box.y; v < box.y + box.height; ++v)
    for (int u = box.x; u < box.x + box.width; ++u)
      if (inside.at<std::uint8_t>(v, u) != 0) {
        greys.push_back(grid.at<std::uint8_t>(v, u));
        slopes.push_back(std::hypot(along.at<float>(v, u), down.at<float>(v, u)));
      }
  if (greys.empty()) return "the plate's points lie on one line";
  const double white = static_cast<double>(std::count(greys.begin(), greys.end(), 255)) /
                       static_cast<double>(greys.size());
  const double contrast = quantile(greys, 0.95) - quantile(greys, 0.05);
  if (contrast < kLeastContrast)
    return fmt::format(
        "the plate's image has a contrast of {:.0f} grey values, {} are needed: "
        "expose longer or light the plate",
        contrast, kLeastContrast);
  if (white > kMostSaturated)
    return fmt::format(
        "{:.0f} % of the plate's image are saturated: expose shorter, or turn the "
        "plate out of the glare",
        100 * white);
  // An edge of a step blurred by sigma is steepest with step / (sqrt(2 pi) sigma).
  const double blur =
      contrast / (std::sqrt(2 * std::numbers::pi) * static_cast<double>(quantile(slopes, 0.995)));
  if (blur > kMostBlur)
    return fmt::format(
        "the plate's image is blurred by {:.1f} px: nearer to the stand-off, or "
        "focus the lens",
        blur);
  return "";
}

std::string stripe_trouble(const View& view, const cv::Mat& laser,
                           const std::vector<cv::Point2f>& hull) {
  int on_plate = 0, white = 0;
  for (const Eigen::Vector2d& centre : view.stripe) {
    const cv::Point2f point(static_cast<float>(centre.x()), static_cast<float>(centre.y()));
    if (cv::pointPolygonTest(hull, point, false) < 0) continue;
    ++on_plate;
    white += laser.at<std::uint8_t>(cv::Point(cvRound(point.x), cvRound(point.y))) == 255;
  }
  if (on_plate < kFewestCentres)
    return view.stripe.empty()
               ? "no stripe is to be seen: is the laser on, and its exposure long enough?"
               : "the stripe does not cross the plate's points: move the plate under it";
  if (white > kMostStripeSaturated * on_plate)
    return fmt::format("{} % of the stripe are saturated: expose shorter", 100 * white / on_plate);
  return "";
}

}  // namespace

std::string image_trouble(const View& view, const cv::Mat& grid, const cv::Mat& laser) {
  if (!view.unusable.empty()) return view.unusable;
  const std::vector<cv::Point2f> hull = hull_of(view.target);
  const std::string trouble = plate_trouble(grid, hull);
  return trouble.empty() ? stripe_trouble(view, laser, hull) : trouble;
}

}  // namespace arcstart::calibration
