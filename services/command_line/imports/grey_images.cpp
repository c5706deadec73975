#include "services/command_line/imports/grey_images.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "services/command_line/imports/import_error.hpp"
#include "services/extraction/files/image_file.hpp"

namespace arcstart::command_line {

cv::Mat GreyImages::read(const std::string& path) {
  const cv::Mat image = extraction::read_image(path);
  if (image.cols != sensor_.width || image.rows != sensor_.height)
    throw ImportError(fmt::format(
        "{}: {} x {} pixels, the calibration is of {} x {}: give images as the camera took them",
        path, image.cols, image.rows, sensor_.width, sensor_.height));
  constexpr int kLargest = std::numeric_limits<std::int16_t>::max();  // image_t's width, height
  if (image.cols > kLargest || image.rows > kLargest)
    throw ImportError(fmt::format("{}: wider or higher than {} pixels", path, kLargest));
  if (image.channels() == 1) return image;
  if (!channel_.empty() || !extraction::has_colour(image)) return one_channel(image);
  if (coloured_++ == 0) first_coloured_ = path;
  cv::Mat grey;
  cv::cvtColor(image, grey, image.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Mat GreyImages::one_channel(const cv::Mat& image) const {
  const int wanted = channel_ == "r" ? 2 : channel_ == "g" ? 1 : 0;
  cv::Mat grey;
  cv::extractChannel(image, grey, image.channels() < 3 ? 0 : wanted);
  return grey;
}

void GreyImages::tell(std::vector<std::string>& notes) const {
  if (coloured_ == 0) return;
  const std::string which = coloured_ == 1
                                ? first_coloured_
                                : fmt::format("{} and {} more", first_coloured_, coloured_ - 1);
  notes.push_back(which +
                  ": in colour, turned to grey: the laser's own colour alone, --channel r, g or b, "
                  "shows the stripe better");
}

}  // namespace arcstart::command_line
