// PNG bytes to grey values, nothing being allocated before the header is found to say what it
// should.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace arcstart {

// Decodes one 8-bit grey PNG of exactly width x height into image. Returns why it cannot be
// decoded, empty where it was.
std::string decode_grey_png(const std::uint8_t* bytes, std::size_t size, int width, int height,
                            cv::Mat& image);

}  // namespace arcstart
