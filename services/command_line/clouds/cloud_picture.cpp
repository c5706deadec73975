#include "services/command_line/clouds/cloud_picture.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "services/command_line/clouds/picture_text.hpp"

namespace arcstart::command_line {
namespace {

constexpr int kSide = 900;        // of one view; px
constexpr int kCloudMargin = 50;  // px
constexpr int kTitle = 30;        // px

const cv::Scalar kBackground(150, 150, 150), kOthers(60, 160, 190), kSeam(60, 60, 255),
    kAlternative(220, 100, 220), kTruth(255, 255, 255), kWords(230, 230, 230);
const std::array<cv::Scalar, 2> kPlates = {cv::Scalar(255, 150, 60), cv::Scalar(90, 210, 90)};

// Parallel projection of the scene into one square of the picture.
class View {
 public:
  View(const CloudPicture& picture, double turn_rad, int left) : left_(left) {
    const Eigen::Vector3d up = picture.up.normalized();
    const Eigen::Vector3d toward =
        Eigen::AngleAxisd(turn_rad, up) * picture.toward_viewer.normalized();
    right_axis_ = up.cross(toward);
    if (right_axis_.norm() < 1e-6) right_axis_ = up.unitOrthogonal();
    right_axis_.normalize();
    toward_ = toward;
    down_axis_ = -toward_.cross(right_axis_);
    fit(picture);
  }

  cv::Point pixel(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d p = (flat(point) - middle_) * px_per_mm_;
    return {left_ + kSide / 2 + static_cast<int>(std::lround(p.x())),
            kTitle + kSide / 2 + static_cast<int>(std::lround(p.y()))};
  }
  double nearness(const Eigen::Vector3d& point) const { return toward_.dot(point); }
  double px_per_mm() const { return px_per_mm_; }
  int left() const { return left_; }

 private:
  Eigen::Vector2d flat(const Eigen::Vector3d& point) const {
    return {right_axis_.dot(point), down_axis_.dot(point)};
  }
  // Shows all but the farthest hundredth on each side, so that one stray point does not shrink the
  // rest.
  void fit(const CloudPicture& picture) {
    std::array<std::vector<double>, 2> coordinates;
    const auto take = [&](const Eigen::Vector3d& point) {
      const Eigen::Vector2d p = flat(point);
      coordinates[0].push_back(p.x());
      coordinates[1].push_back(p.y());
    };
    for (const auto* list :
         {&picture.background, &picture.others, &picture.plates[0], &picture.plates[1]})
      for (const auto& point : *list) take(point);
    for (const auto& segment : {picture.seam, picture.truth})
      if (segment) take(segment->first), take(segment->second);
    double largest = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      auto& values = coordinates[static_cast<std::size_t>(axis)];
      if (values.empty()) continue;
      std::sort(values.begin(), values.end());
      const std::size_t cut = values.size() / 100;
      const double low = values[cut], high = values[values.size() - 1 - cut];
      middle_[axis] = (low + high) / 2;
      largest = std::max(largest, high - low);
    }
    px_per_mm_ = (kSide - 2 * kCloudMargin) / largest;
  }

  int left_;
  Eigen::Vector3d right_axis_, down_axis_, toward_;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
  double px_per_mm_ = 1;
};

void draw_points(cv::Mat& image, const View& view, const CloudPicture& picture) {
  struct Dot {
    double nearness;
    cv::Point pixel;
    cv::Scalar colour;
    int radius;
  };
  std::vector<Dot> dots;
  const auto take = [&](const std::vector<Eigen::Vector3d>& points, const cv::Scalar& colour,
                        int radius) {
    for (const auto& point : points)
      dots.push_back({view.nearness(point), view.pixel(point), colour, radius});
  };
  take(picture.background, kBackground, 1);
  take(picture.others, kOthers, 1);
  take(picture.plates[0], kPlates[0], 1);
  take(picture.plates[1], kPlates[1], 1);
  std::stable_sort(dots.begin(), dots.end(),
                   [](const Dot& a, const Dot& b) { return a.nearness < b.nearness; });
  const cv::Rect square(view.left(), kTitle, kSide, kSide);
  for (const Dot& dot : dots)
    if (square.contains(dot.pixel))
      cv::circle(image, dot.pixel, dot.radius, dot.colour, cv::FILLED);
}

void draw_lines(cv::Mat& image, const View& view, const CloudPicture& picture) {
  for (const auto& line : picture.alternatives)
    cv::line(image, view.pixel(line.first), view.pixel(line.second), kAlternative, 1, cv::LINE_AA);
  if (picture.seam) {
    cv::line(image, view.pixel(picture.seam->first), view.pixel(picture.seam->second), kSeam, 2,
             cv::LINE_AA);
    cv::circle(image, view.pixel(picture.seam->first), 7, kSeam, cv::FILLED, cv::LINE_AA);
  }
  if (picture.truth) {
    cv::line(image, view.pixel(picture.truth->first), view.pixel(picture.truth->second), kTruth, 1,
             cv::LINE_AA);
    cv::circle(image, view.pixel(picture.truth->first), 4, kTruth, 1, cv::LINE_AA);
  }
}

void draw_scale(cv::Mat& image, const View& view) {
  double length = 1000;
  while (length * view.px_per_mm() > kSide / 3.0) length /= 10;
  const cv::Point from(view.left() + 20, kTitle + kSide - 20);
  const int px = std::max(1, static_cast<int>(std::lround(length * view.px_per_mm())));
  cv::line(image, from, from + cv::Point(px, 0), kWords, 2);
  write_text(image, fmt::format("{:g} mm", length), from + cv::Point(0, -8), kWords);
}

void draw_legend(cv::Mat& image, const CloudPicture& picture) {
  int y = kTitle + 20;
  const auto entry = [&](bool shown, const char* text, const cv::Scalar& colour) {
    if (!shown) return;
    cv::circle(image, {20, y - 4}, 5, colour, cv::FILLED, cv::LINE_AA);
    write_text(image, text, {32, y}, colour);
    y += 20;
  };
  entry(!picture.background.empty(), "background", kBackground);
  entry(!picture.plates[0].empty(), "first plate", kPlates[0]);
  entry(!picture.plates[1].empty(), "second plate", kPlates[1]);
  entry(!picture.others.empty(), "other", kOthers);
  entry(picture.seam.has_value(), "seam, disc at its start", kSeam);
  entry(!picture.alternatives.empty(), "alternatives", kAlternative);
  entry(picture.truth.has_value(), "truth", kTruth);
}

}  // namespace

void draw_cloud(const CloudPicture& picture, const std::string& path) {
  cv::Mat image(kSide + kTitle, 2 * kSide, CV_8UC3, cv::Scalar(35, 30, 30));
  for (int side = 0; side < 2; ++side) {
    const View view(picture, side * M_PI / 2, side * kSide);
    draw_points(image, view, picture);
    draw_lines(image, view, picture);
    draw_scale(image, view);
  }
  cv::line(image, {kSide, kTitle}, {kSide, kSide + kTitle}, kBackground, 1);
  write_text(image, picture.title, {12, 20}, kWords);
  draw_legend(image, picture);
  bool written = false;
  try {
    written = cv::imwrite(path, image);
  } catch (const cv::Exception& error) {
    throw PictureError(fmt::format("{}: cannot be written as a picture: {}", path, error.err));
  }
  if (!written) throw PictureError(path + ": cannot be written as a picture");
}

}  // namespace arcstart::command_line
