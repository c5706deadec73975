#include "services/sensor_capture/sources/aravis_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "common/time.hpp"

namespace arcstart::sensor_capture {
namespace {

constexpr auto kRetry = std::chrono::seconds(1);
constexpr auto kShortestSilence = std::chrono::milliseconds(500);

}  // namespace

AravisSource::AravisSource(const SensorCaptureSettings& settings, std::function<void()> notify)
    : settings_(settings), events_(std::move(notify), kMostFramesWaiting) {}

AravisSource::~AravisSource() { stop(); }

void AravisSource::start() {
  thread_ = std::thread([this] { run(); });
}

void AravisSource::stop() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  woken_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void AravisSource::request(std::int64_t ticket, const CameraSettings& settings) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back({ticket, settings});
  }
  woken_.notify_all();
}

void AravisSource::run() {
  std::string told;
  while (true) {
    std::string trouble;
    try {
      auto camera = std::make_unique<AravisCamera>(settings_, [this] { wake(); });
      counter_.restart();
      told.clear();
      events_.push(camera->found());
      trouble = serve(*camera);
      if (!trouble.empty()) retire(std::move(camera));
    } catch (const CameraError& error) {
      trouble = error.what();
    }
    std::unique_lock lock(mutex_);
    if (ending_) return;
    requests_.clear();
    lock.unlock();
    if (trouble != told) events_.push(CameraLost{trouble});
    told = trouble;
    lock.lock();
    if (woken_.wait_for(lock, kRetry, [this] { return ending_; })) return;
  }
}

// Aravis takes some ten seconds to let go of a camera that does not answer: meanwhile it is looked
// for again.
void AravisSource::retire(std::unique_ptr<AravisCamera> camera) {
  retired_.push_back(
      std::async(std::launch::async, [lost = std::move(camera)]() mutable { lost.reset(); }));
  std::erase_if(retired_, [](const std::future<void>& done) {
    return done.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
}

std::string AravisSource::serve(AravisCamera& camera) {
  using std::chrono::steady_clock;
  const std::chrono::duration<double> periods(settings_.silent_periods / settings_.frame_rate_hz);
  const auto silence = std::max<steady_clock::duration>(
      std::chrono::duration_cast<steady_clock::duration>(periods), kShortestSilence);
  last_frame_ = steady_clock::now();
  while (true) {
    std::deque<Request> requests;
    {
      std::unique_lock lock(mutex_);
      woken_.wait_until(lock, last_frame_ + silence,
                        [this] { return ending_ || something_ || !requests_.empty(); });
      if (ending_) return "";
      something_ = false;
      requests.swap(requests_);
    }
    take_frames(camera);
    for (const Request& request : requests) apply(camera, request);
    if (steady_clock::now() > last_frame_ + silence)
      camera.give_up(
          fmt::format("no frame for {:.1f} s", std::chrono::duration<double>(silence).count()));
    if (const std::string trouble = camera.trouble(); !trouble.empty())
      return fmt::format("camera {} is lost: {} ({}): check its power and cable",
                         camera.found().description, trouble, camera.statistics());
  }
}

void AravisSource::apply(AravisCamera& camera, const Request& request) {
  SettingsApplied applied{request.ticket, request.settings, 0, {}};
  try {
    applied.settings = camera.apply(request.settings);
  } catch (const CameraRefusal& refusal) {
    applied.error = refusal.what();
  } catch (const CameraError& error) {  // lit or dark? Found again it is dark.
    return camera.give_up(error.what());
  }
  applied.acknowledged_utime = utime_now();
  events_.push(applied);
}

void AravisSource::take_frames(AravisCamera& camera) {
  while (auto next = camera.next()) {
    last_frame_ = std::chrono::steady_clock::now();
    next->frame.seq = counter_.number(next->frame_id);
    events_.push(std::move(next->frame));
  }
}

void AravisSource::wake() {
  {
    const std::lock_guard lock(mutex_);
    something_ = true;
  }
  woken_.notify_all();
}

}  // namespace arcstart::sensor_capture
