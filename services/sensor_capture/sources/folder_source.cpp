#include "services/sensor_capture/sources/folder_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/time.hpp"

namespace arcstart::sensor_capture {
namespace {

constexpr std::size_t kMostBytesKept = 256u << 20;        // of pixels
constexpr std::int64_t kFirstDeviceTime = 1'000'000'000;  // ns

std::vector<std::filesystem::path> images_in(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::string ending = entry.path().extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (ending == ".png" || ending == ".pgm") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Equal channels are grey.
bool make_grey(cv::Mat& image) {
  if (image.channels() == 1) return true;
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  for (int i = 1; i < std::min(3, image.channels()); ++i)
    if (cv::norm(channels[0], channels[static_cast<std::size_t>(i)], cv::NORM_INF) != 0)
      return false;
  image = channels[0];
  return true;
}

}  // namespace

Frame read_frame(const std::filesystem::path& file) {
  Frame frame;
  const auto incomplete = [&](const std::string& why) {
    frame.incomplete = file.filename().string() + ": " + why;
    return frame;
  };
  cv::Mat image;
  try {
    image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    return incomplete(error.err);
  }
  if (image.empty()) return incomplete("not an image that can be read");
  if (image.depth() != CV_8U) return incomplete("not of 8 bits a pixel");
  if (!make_grey(image)) return incomplete("in colour, a grey image is wanted");
  if (image.cols > 32767 || image.rows > 32767) return incomplete("larger than 32767 pixels");
  frame.width = frame.sensor_width = image.cols;
  frame.height = frame.sensor_height = image.rows;
  frame.pixels.reserve(image.total());
  for (int v = 0; v < image.rows; ++v)
    frame.pixels.insert(frame.pixels.end(), image.ptr(v), image.ptr(v) + image.cols);
  return frame;
}

FolderSource::FolderSource(const SensorCaptureSettings& settings, std::function<void()> notify)
    : settings_(settings), events_(std::move(notify), kMostFramesWaiting) {}

FolderSource::~FolderSource() { stop(); }

void FolderSource::start() {
  thread_ = std::thread([this] { play(); });
}

void FolderSource::stop() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ended_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FolderSource::request(std::int64_t ticket, const CameraSettings& settings) {
  events_.push(SettingsApplied{ticket, settings, utime_now(), {}});
}

void FolderSource::play() {
  const auto files = images_in(settings_.folder);
  if (files.empty()) {
    events_.push(CameraLost{
        fmt::format("no png or pgm image in '{}': set sensor_capture.folder to a folder of images",
                    settings_.folder)});
    return;
  }
  // From memory as far as it goes: decoding is too slow for a hundred images a second.
  std::vector<Frame> kept;
  for (std::size_t bytes = 0; kept.size() < files.size() && bytes < kMostBytesKept;) {
    kept.push_back(read_frame(files[kept.size()]));
    bytes += kept.back().pixels.size();
  }
  const auto period =
      std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / settings_.frame_rate_hz));
  CameraFound found;
  found.description = fmt::format("{} images of {}", files.size(), settings_.folder);
  found.settings = {settings_.exposure_us, settings_.gain_db, false};
  found.shortest_period_us = period.count() / 1000 * 95 / 100;
  events_.push(found);

  const auto exposure =
      std::chrono::nanoseconds(static_cast<std::int64_t>(settings_.exposure_us * 1000));
  const auto begin = std::chrono::steady_clock::now() + period;
  for (std::int64_t number = 0;; ++number) {
    const auto place = static_cast<std::size_t>(number) % files.size();
    if (number > 0 && place == 0 && !settings_.folder_loops) break;
    Frame frame = place < kept.size() ? kept[place] : read_frame(files[place]);
    if (!wait_until(begin + number * period + exposure)) return;
    frame.seq = number + 1;
    frame.device_time_ns = kFirstDeviceTime + number * period.count();
    // As if the first packet had come when the exposure began; the thread may have woken late.
    frame.arrival_utime = utime_now() - exposure.count() / 1000;
    events_.push(std::move(frame));
  }
  events_.push(CameraLost{fmt::format("the images of {} have all been played", settings_.folder)});
}

bool FolderSource::wait_until(std::chrono::steady_clock::time_point time) {
  std::unique_lock lock(mutex_);
  return !ended_.wait_until(lock, time, [this] { return ending_; });
}

}  // namespace arcstart::sensor_capture
