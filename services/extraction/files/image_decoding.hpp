// PNG bytes to grey values, nothing being allocated before the header is found to say what it
// should.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace arcstart::extraction {

struct PngHeader {
  std::uint32_t width, height;  // px
  int depth, colour_type;       // bits a channel; 0 grey, 2 colour, 3 palette, 4 and 6 with opacity
};
std::optional<PngHeader> png_header(const std::uint8_t* bytes,
                                    std::size_t size);  // nothing: not a PNG

// All its chunks are there, up to the one that ends it: the decoder itself is content with less.
bool is_whole_png(const std::uint8_t* bytes, std::size_t size);

// Decodes one 8-bit grey PNG of exactly width x height into image. Returns why it cannot be
// decoded, empty where it was.
std::string decode_grey_png(const std::uint8_t* bytes, std::size_t size, int width, int height,
                            cv::Mat& image);

}  // namespace arcstart::extraction
