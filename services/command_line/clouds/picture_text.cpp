#include "services/command_line/clouds/picture_text.hpp"

#include <opencv2/imgproc.hpp>

namespace arcstart::command_line {

void write_text(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& colour) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv::LINE_AA);
}

}  // namespace arcstart::command_line
