// Words in a picture, alike in all of them.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace arcstart::command_line {

// `at`: the lower left corner of the first letter; px.
void write_text(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& colour);

}  // namespace arcstart::command_line
