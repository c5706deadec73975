#include "services/calibration/target/target_detection.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "services/calibration/target/circle_centres.hpp"

namespace arcstart::calibration {
namespace {

constexpr int kSearchWidth = 800;  // px; blobs are sought in a smaller image, measured in the full

using Points = std::vector<cv::Point2f>;

// The mean grey value within half a pitch's square between four neighbours of the grid.
double square_brightness(const cv::Mat& grey, const Target& plate, const Points& corners,
                         int column, int row) {
  cv::Point2f middle(0, 0);
  for (const int i : {0, 1, plate.columns, plate.columns + 1})
    middle += corners[row * plate.columns + column + i] * 0.25f;
  const cv::Point2f side =
      corners[row * plate.columns + column + 1] - corners[row * plate.columns + column];
  const int half = std::max(1, static_cast<int>(std::hypot(side.x, side.y) / 6));
  const cv::Rect window =
      cv::Rect(cvRound(middle.x) - half, cvRound(middle.y) - half, 2 * half + 1, 2 * half + 1) &
      cv::Rect(0, 0, grey.cols, grey.rows);
  return window.empty() ? 0 : cv::mean(grey(window))[0];
}

// Whether the first inner square of a chessboard is darker than its neighbours.
bool begins_dark(const cv::Mat& grey, const Target& plate, const Points& corners) {
  double dark_first = 0;
  for (int row = 0; row + 1 < plate.rows; ++row)
    for (int column = 0; column + 1 < plate.columns; ++column)
      dark_first +=
          ((row + column) % 2 == 0 ? -1 : 1) * square_brightness(grey, plate, corners, column, row);
  return dark_first > 0;
}

Points find_chessboard(const cv::Mat& grey, const Target& plate) {
  const cv::Size size(plate.columns, plate.rows);
  Points corners;
  if (!cv::findChessboardCorners(grey, size, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return {};
  double shortest = 1e9;
  for (int i = 0; i + 1 < plate.columns; ++i)
    shortest = std::min(shortest, cv::norm(corners[i + 1] - corners[i]));
  for (int i = 0; i + 1 < plate.rows; ++i)
    shortest =
        std::min(shortest, cv::norm(corners[(i + 1) * plate.columns] - corners[i * plate.columns]));
  const int half = std::clamp(static_cast<int>(shortest / 8), 2, 7);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1},
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-4));
  return corners;
}

Points find_circles(const cv::Mat& grey, const Target& plate) {
  const double scale = std::min(1.0, double{kSearchWidth} / grey.cols);
  cv::Mat small;
  cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
  cv::SimpleBlobDetector::Params blobs;
  blobs.minArea = 12;
  blobs.maxArea = static_cast<float>(small.total()) / static_cast<float>(plate.size());
  blobs.minDistBetweenBlobs = 4;
  blobs.minThreshold = 20;
  blobs.maxThreshold = 230;
  blobs.thresholdStep = 15;
  const cv::Size size(plate.columns, plate.rows);
  const int pattern = plate.pattern == TargetPattern::circles ? cv::CALIB_CB_SYMMETRIC_GRID
                                                              : cv::CALIB_CB_ASYMMETRIC_GRID;
  Points centres;
  const auto detector = cv::SimpleBlobDetector::create(blobs);
  if (!cv::findCirclesGrid(small, size, centres, pattern, detector) &&
      !cv::findCirclesGrid(small, size, centres, pattern | cv::CALIB_CB_CLUSTERING, detector))
    return {};
  // The image's edge, at -0.5, is what scaling keeps.
  for (cv::Point2f& centre : centres)
    centre = (centre + cv::Point2f(0.5f, 0.5f)) / scale - cv::Point2f(0.5f, 0.5f);
  return centres;
}

bool mirrored(const Target& plate, const Points& points) {
  const cv::Point2f along = points[plate.columns - 1] - points[0];
  const cv::Point2f down = points[(plate.rows - 1) * plate.columns] - points[0];
  return along.cross(down) < 0;
}

Points relabelled(const Points& points, const std::vector<int>& labels) {
  Points result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result[labels[i]] = points[i];
  return result;
}

Target with_symmetry(const Target& plate) {
  Target plain = plate;
  plain.pattern = TargetPattern::circles;
  plain.origin_dot_radius_mm = 0;
  return plain;
}

// The turn after which `badness` is least, of those that leave a plain grid as it is.
template <class Badness>
Points best_turn(const Target& plate, const Points& points, const Badness& badness) {
  const Target plain = with_symmetry(plate);
  Points best = points;
  for (int turns = 1; turns < plain.symmetry(); ++turns)
    if (Points other = relabelled(points, turned_points(plain, turns));
        badness(other) < badness(best))
      best = std::move(other);
  return best;
}

}  // namespace

std::vector<Eigen::Vector2d> detect_target(const cv::Mat& grey, const Target& plate) {
  Points points = plate.has_circles() ? find_circles(grey, plate) : find_chessboard(grey, plate);
  if (points.empty()) return {};
  if (plate.pattern != TargetPattern::asymmetric_circles && mirrored(plate, points))
    for (int row = 0; row < plate.rows; ++row)
      std::reverse(points.begin() + row * plate.columns,
                   points.begin() + (row + 1) * plate.columns);
  if (plate.pattern == TargetPattern::chessboard)
    points = best_turn(plate, points, [&](const Points& turned) {
      return begins_dark(grey, plate, turned) ? 0 : 1;
    });
  else if (plate.pattern == TargetPattern::circles && plate.origin_dot_radius_mm > 0)
    points = best_turn(plate, points, [&](const Points& turned) {
      return brightness_around_origin(grey, plate, turned);
    });

  std::vector<Eigen::Vector2d> result;
  for (const cv::Point2f& point : points) result.push_back({point.x, point.y});
  return plate.has_circles() ? refine_circle_centres(grey, plate, result) : result;
}

}  // namespace arcstart::calibration
