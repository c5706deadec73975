#include "services/extraction/files/image_decoding.hpp"

#include <fmt/core.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>

namespace arcstart::extraction {
namespace {

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | bytes[3];
}

}  // namespace

// Signature, then the header chunk: length 13, IHDR, width, height, depth, colour type (PNG 1.2,
// chapter 4).
std::optional<PngHeader> png_header(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::uint8_t kStart[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                     0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  if (size < 33 || std::memcmp(bytes, kStart, sizeof kStart) != 0) return std::nullopt;
  return PngHeader{big_endian(bytes + 16), big_endian(bytes + 20), bytes[24], bytes[25]};
}

bool is_whole_png(const std::uint8_t* bytes, std::size_t size) {
  if (size < 8) return false;
  for (std::size_t at = 8; size - at >= 12;) {
    const std::size_t length = big_endian(bytes + at);
    if (length > size - at - 12) return false;
    if (std::memcmp(bytes + at + 4, "IEND", 4) == 0) return true;
    at += 12 + length;
  }
  return false;
}

std::string decode_grey_png(const std::uint8_t* bytes, std::size_t size, int width, int height,
                            cv::Mat& image) {
  const auto header = png_header(bytes, size);
  if (!header) return "not a PNG";
  if (header->width != static_cast<std::uint32_t>(width) ||
      header->height != static_cast<std::uint32_t>(height))
    return fmt::format("PNG is {} x {}, announced were {} x {}", header->width, header->height,
                       width, height);
  if (header->depth != 8 || header->colour_type != 0) return "PNG is not 8-bit grey";
  if (!is_whole_png(bytes, size)) return "PNG is cut short";
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

}  // namespace arcstart::extraction
