#include "services/extraction/image_decoding.hpp"

#include <fmt/format.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>

namespace arcstart {
namespace {

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | bytes[3];
}

// All chunks are there, up to the one that ends the file: the decoder itself is content with less.
bool is_whole(const std::uint8_t* bytes, std::size_t size) {
  for (std::size_t at = 8; size - at >= 12;) {
    const std::size_t length = big_endian(bytes + at);
    if (length > size - at - 12) return false;
    if (std::memcmp(bytes + at + 4, "IEND", 4) == 0) return true;
    at += 12 + length;
  }
  return false;
}

}  // namespace

std::string decode_grey_png(const std::uint8_t* bytes, std::size_t size, int width, int height,
                            cv::Mat& image) {
  // Signature, then the header chunk: length 13, IHDR, width, height, depth, colour type (PNG 1.2,
  // chapter 4).
  constexpr std::uint8_t kStart[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                     0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  if (size < 33 || std::memcmp(bytes, kStart, sizeof kStart) != 0) return "not a PNG";
  if (big_endian(bytes + 16) != static_cast<std::uint32_t>(width) ||
      big_endian(bytes + 20) != static_cast<std::uint32_t>(height))
    return fmt::format("PNG is {} x {}, announced were {} x {}", big_endian(bytes + 16),
                       big_endian(bytes + 20), width, height);
  if (bytes[24] != 8 || bytes[25] != 0) return "PNG is not 8-bit grey";
  if (!is_whole(bytes, size)) return "PNG is cut short";
  try {
    const cv::Mat view(1, static_cast<int>(size), CV_8U, const_cast<std::uint8_t*>(bytes));
    cv::imdecode(view, cv::IMREAD_UNCHANGED, &image);
  } catch (const cv::Exception&) {
    return "PNG is damaged";
  }
  if (image.type() != CV_8UC1 || image.cols != width || image.rows != height)
    return "PNG is damaged";
  return "";
}

}  // namespace arcstart
