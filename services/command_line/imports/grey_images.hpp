// Images of one sensor from files, as the grey values that extraction reads.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "common/sensor_model.hpp"

namespace arcstart::command_line {

class GreyImages {
 public:
  // channel: of colour images the one to be taken, r, g or b; empty: all three make the grey value.
  GreyImages(const SensorModel& sensor, const std::string& channel)
      : sensor_(sensor), channel_(channel) {}

  // 8-bit grey values. Throws ImportError where the image is not of the sensor's size, and
  // extraction::ImageFileError where it cannot be read or is not of 8 bits.
  cv::Mat read(const std::string& path);

  // That colour images were turned to grey, in one line, where any were.
  void tell(std::vector<std::string>& notes) const;

 private:
  cv::Mat one_channel(const cv::Mat& image) const;

  SensorModel sensor_;
  std::string channel_, first_coloured_;
  int coloured_ = 0;  // turned to grey
};

}  // namespace arcstart::command_line
