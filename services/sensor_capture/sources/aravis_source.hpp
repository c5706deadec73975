// A GigE Vision camera that may come and go.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "services/sensor_capture/frames/event_queue.hpp"
#include "services/sensor_capture/frames/frame_counter.hpp"
#include "services/sensor_capture/sources/aravis_camera.hpp"

namespace arcstart::sensor_capture {

// Looks for the camera once a second while it is not there. Within the run frame numbers go on
// rising when it comes back.
class AravisSource : public FrameSource {
 public:
  // notify: called from other threads when something has happened; it must outlive this object.
  AravisSource(const SensorCaptureSettings& settings, std::function<void()> notify);
  ~AravisSource() override;

  void start() override;
  void stop() override;
  void request(std::int64_t ticket, const CameraSettings& settings) override;
  std::optional<SourceEvent> poll() override { return events_.pop(); }
  SourceCounts counts() const override { return events_.counts(); }

 private:
  struct Request {
    std::int64_t ticket;
    CameraSettings settings;
  };
  void run();
  void retire(std::unique_ptr<AravisCamera> camera);
  std::string serve(AravisCamera& camera);  // until it is lost: why; empty at the end
  void apply(AravisCamera& camera, const Request& request);
  void take_frames(AravisCamera& camera);
  void wake();

  SensorCaptureSettings settings_;
  EventQueue events_;
  FrameCounter counter_;
  std::chrono::steady_clock::time_point last_frame_;

  std::mutex mutex_;
  std::condition_variable woken_;
  std::deque<Request> requests_;
  bool something_ = false;
  bool ending_ = false;

  std::vector<std::future<void>> retired_;  // lost cameras that are being let go
  std::thread thread_;
};

}  // namespace arcstart::sensor_capture
