#include "services/extraction/files/stripe_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace arcstart::extraction {
namespace {

// Blue, green, red. Neighbours differ, and all from the grey beneath.
const cv::Scalar kColours[] = {{60, 60, 255},  {80, 255, 80},  {255, 170, 40}, {0, 220, 255},
                               {255, 80, 220}, {255, 255, 60}, {0, 140, 255},  {190, 120, 255}};

}  // namespace

cv::Mat draw_stripe(const cv::Mat& grey, const std::vector<PictureCentre>& centres) {
  const double longer = std::max(grey.cols, grey.rows);
  const int scale = std::clamp(static_cast<int>(std::lround(2400 / longer)), 1, 8);
  cv::Mat picture;
  cv::resize(grey, picture, {}, scale, scale, cv::INTER_NEAREST);
  picture.convertTo(picture, CV_8U, 0.75, 8);
  cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);

  constexpr int kShift = 4;               // binary places of a dot's coordinates
  const auto place = [&](double pixel) {  // pixel centres at integers, before and after
    return static_cast<int>(std::lround(((pixel + 0.5) * scale - 0.5) * (1 << kShift)));
  };
  const int radius = (longer > 2400 ? 2 : std::max(1, scale * 3 / 4)) << kShift;
  for (const PictureCentre& centre : centres) {
    const cv::Point at(place(centre.u), place(centre.v));
    const cv::Scalar colour =
        centre.chosen ? kColours[centre.segment % std::size(kColours)] : cv::Scalar(255, 255, 255);
    cv::circle(picture, at, centre.chosen ? radius : radius / 2, colour, cv::FILLED, cv::LINE_AA,
               kShift);
  }
  return picture;
}

}  // namespace arcstart::extraction
