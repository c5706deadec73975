// A GigE Vision camera on the network: Aravis' own device side, with our frames, stamps and digital
// output.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "services/cell_simulator/base/device_clock.hpp"
#include "services/cell_simulator/camera/camera_registers.hpp"
#include "services/cell_simulator/camera/controller_watch.hpp"
#include "services/cell_simulator/camera/frame_renderer.hpp"

struct _ArvBuffer;
struct _ArvFakeCamera;
struct _ArvGvFakeCamera;

namespace arcstart::cell_simulator {

struct GigeCameraSettings {
  std::string interface_address = "127.0.0.1";
  std::string serial = "CELL01";  // the device's id is Aravis-Fake-<serial>
  int width = 1600, height = 1200;
  double frame_rate = 14;        // until the client sets another; Hz
  double image_delay = 0.02732;  // begin of the exposure to the first packet at the host; s
  double transport = 0.00008;    // of that, from the camera's sending to the arrival at the host; s
  DeviceClock clock;
};

// What to do about it stands in the text.
class GigeCameraError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Frames fall on multiples of the frame period of the host's clock, so that they can be rendered
// ahead. Line1 drives the laser: ExposureActive lights it in exposures, a latched UserOutput0 for
// good, as a real camera would. Without a client in control nothing is exposed. Its control port is
// UDP 3956 of the interface: one camera an address.
class GigeCamera {
 public:
  using Render = FrameRenderer::Render;
  using Lose = std::function<bool(const SimulatedFrame&)>;

  // render: called on the camera's threads, one at a time. lose: which frames never leave the
  // camera. Closed at first.
  GigeCamera(const GigeCameraSettings& settings, Render render, Lose lose = {});
  ~GigeCamera();

  void open();   // throws GigeCameraError
  void close();  // gone from the network, as if its plug were pulled
  bool is_open() const;

  // At least ten times a second: sees to it that no acquisition outlives its client.
  void tick(std::int64_t now);

  // The scene has changed: frames that are ready are rendered anew.
  void scene_changed() { renderer_.discard(); }

  bool laser_on() const;
  std::int64_t frame_period() const;               // us
  std::int64_t frames() const { return frames_; }  // exposed since start
  const GigeCameraSettings& settings() const { return settings_; }

 private:
  static void fill(_ArvBuffer* buffer, void* self, std::uint32_t exposure_us, std::uint32_t gain,
                   std::uint32_t pixel_format);
  void send(_ArvBuffer* buffer);
  SimulatedFrame frame_of(std::int64_t slot, const CameraRegisters& registers) const;
  std::optional<SimulatedFrame> upcoming(std::int64_t now) const;
  std::optional<CameraRegisters> registers() const;

  GigeCameraSettings settings_;
  Lose lose_;
  std::mutex control_mutex_;  // of open, close and tick; never taken by the camera's threads
  mutable std::mutex mutex_;  // of camera_ and device_ as pointers
  _ArvGvFakeCamera* camera_ = nullptr;
  _ArvFakeCamera* device_ = nullptr;  // camera_'s registers
  std::atomic<std::int64_t> frames_{0};
  std::unique_ptr<ControllerWatch> watch_;
  FrameRenderer renderer_;  // last: its thread uses the others
};

}  // namespace arcstart::cell_simulator
