#include "services/extraction/files/image_file.hpp"

#include <fmt/core.h>

#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "services/extraction/files/image_decoding.hpp"

namespace arcstart::extraction {
namespace {

constexpr std::uint64_t kMostPixels = 100'000'000, kMostBytes = 1'000'000'000;

std::vector<std::uint8_t> read_bytes(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw ImageFileError(fmt::format("{}: {}", path, error.message()));
  if (size > kMostBytes) throw ImageFileError(fmt::format("{}: too large for an image", path));
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    throw ImageFileError(fmt::format("{}: cannot be read", path));
  return bytes;
}

}  // namespace

cv::Mat read_image(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  const auto refuse_size = [&](std::uint64_t width, std::uint64_t height) {
    if (width * height > kMostPixels)
      throw ImageFileError(fmt::format("{}: {} x {} pixels are more than {} million", path, width,
                                       height, kMostPixels / 1'000'000));
  };
  if (const auto header = png_header(bytes.data(), bytes.size())) {
    refuse_size(header->width, header->height);  // before anything is allocated for it
    if (!is_whole_png(bytes.data(), bytes.size()))
      throw ImageFileError(fmt::format("{}: is cut short", path));
  }
  cv::Mat image;
  try {
    if (!bytes.empty()) image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const std::exception&) {
    image.release();
  }
  if (image.empty()) throw ImageFileError(fmt::format("{}: not an image, or damaged", path));
  refuse_size(image.cols, image.rows);
  if (image.depth() != CV_8U)
    throw ImageFileError(
        fmt::format("{}: not 8 bit a channel; convert it with its full range kept", path));
  return image;
}

bool is_image_name(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& letter : ending)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const char* known : {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"})
    if (ending == known) return true;
  return false;
}

cv::Mat read_luminance(const std::string& path) {
  const cv::Mat image = read_image(path);
  cv::Mat grey;
  if (has_colour(image))
    cv::cvtColor(image, grey, image.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  else
    cv::extractChannel(image, grey, 0);
  return grey;
}

bool has_colour(const cv::Mat& image) {
  if (image.channels() < 3) return false;
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  return cv::norm(channels[0], channels[1], cv::NORM_INF) != 0 ||
         cv::norm(channels[0], channels[2], cv::NORM_INF) != 0;
}

cv::Mat read_grey_image(const std::string& path, const std::string& channel) {
  const cv::Mat image = read_image(path);
  if (image.channels() == 1) return image;
  std::vector<cv::Mat> channels;  // blue, green, red, perhaps opacity
  cv::split(image, channels);
  if (channels.size() < 3) return channels[0];
  if (channel == "b") return channels[0];
  if (channel == "g") return channels[1];
  if (channel == "r") return channels[2];
  if (has_colour(image))
    throw ImageFileError(
        fmt::format("{}: a colour image; name the laser's channel with --channel r, g or b", path));
  return channels[0];
}

}  // namespace arcstart::extraction
