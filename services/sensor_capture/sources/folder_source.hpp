// A folder of images, played as if a camera took them.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "services/sensor_capture/frames/event_queue.hpp"
#include "services/sensor_capture/sensor_capture_settings.hpp"

namespace arcstart::sensor_capture {

// Device time is that of an ideal camera: one second and then an even period. The images are what
// they are: exposure, gain and laser are taken note of and change nothing.
class FolderSource : public FrameSource {
 public:
  // notify: called from another thread when something has happened; it must outlive this object.
  FolderSource(const SensorCaptureSettings& settings, std::function<void()> notify);
  ~FolderSource() override;

  void start() override;
  void stop() override;
  void request(std::int64_t ticket, const CameraSettings& settings) override;
  std::optional<SourceEvent> poll() override { return events_.pop(); }
  SourceCounts counts() const override { return events_.counts(); }

 private:
  void play();
  bool wait_until(std::chrono::steady_clock::time_point time);  // false at the end

  SensorCaptureSettings settings_;
  EventQueue events_;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ending_ = false;
};

// A grey image of 8 bits, or the reason why not: unreadable, of another depth, in true colour.
Frame read_frame(const std::filesystem::path& file);

}  // namespace arcstart::sensor_capture
