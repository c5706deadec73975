// A small camera for tests, whose frames carry what they were rendered from.
#pragma once

#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include "common/time.hpp"
#include "services/cell_simulator/camera/gige_camera.hpp"
#include "tests/cell_simulator/camera/camera_client.hpp"

namespace arcstart::cell_simulator {

inline GigeCameraSettings small_camera() {
  GigeCameraSettings settings;
  settings.serial = "TEST1";
  settings.width = 320;
  settings.height = 240;
  settings.frame_rate = 25;
  settings.clock = {utime_now(), 5'000'000'000'000, 40};
  return settings;
}

// Every frame carries in its first bytes what it was rendered from; the rest is its laser: 200 lit,
// 10 dark.
inline void paint(const SimulatedFrame& frame, std::uint8_t* grey) {
  std::memset(
      grey, frame.exposure.laser_on ? 200 : 10,
      static_cast<std::size_t>(frame.region.width) * static_cast<std::size_t>(frame.region.height));
  std::memcpy(grey, &frame, sizeof frame);
}
inline SimulatedFrame painted(const ReceivedFrame& received) {
  SimulatedFrame frame;
  std::memcpy(&frame, received.grey.data(), sizeof frame);
  return frame;
}

// A camera whose tick runs beside the test, as the service's main loop does.
struct RunningCamera {
  GigeCamera camera;
  std::atomic<bool> ending{false};
  std::thread ticking;
  explicit RunningCamera(const GigeCameraSettings& settings = small_camera(),
                         GigeCamera::Lose lose = {})
      : camera(settings, paint, std::move(lose)) {
    camera.open();
    ticking = std::thread([this] {
      while (!ending) {
        camera.tick(utime_now());
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
  ~RunningCamera() {
    ending = true;
    ticking.join();
  }
};

}  // namespace arcstart::cell_simulator
