// Images from files, as grey values.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "common/input_error.hpp"

namespace arcstart::extraction {

// One line: which file, what is wrong with it, what to do.
class ImageFileError : public InputError {
 public:
  using InputError::InputError;
};

// An image file as it is stored: 8 bit, one channel or blue, green, red and perhaps opacity. Throws
// ImageFileError where the file cannot be read, is damaged, is not 8 bit or is larger than 100
// million pixels.
cv::Mat read_image(const std::string& path);

// Whether a file's name ends as that of an image that can be read: .png, .jpg, .jpeg, .bmp, .tif,
// .tiff, in small or capital letters.
bool is_image_name(const std::string& path);

// Three or four channels of which the first three differ.
bool has_colour(const cv::Mat& image);

// 8-bit grey values of an image file. channel: "r", "g" or "b" of a colour image; empty for a grey
// one, which may be stored as colour with equal channels. Throws ImageFileError as read_image does,
// and where it has true colour and no channel is named.
cv::Mat read_grey_image(const std::string& path, const std::string& channel = "");

// 8-bit grey values, for what is black and white under any light: colour is turned to grey. Throws
// ImageFileError as read_image does.
cv::Mat read_luminance(const std::string& path);

}  // namespace arcstart::extraction
