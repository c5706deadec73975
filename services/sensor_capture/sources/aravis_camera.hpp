// One connection to a GigE Vision camera through Aravis, from finding it to letting it go.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "services/sensor_capture/frames/frame_source.hpp"
#include "services/sensor_capture/sensor_capture_settings.hpp"

// Aravis' own, opaque here.
typedef struct _ArvCamera ArvCamera;
typedef struct _ArvStream ArvStream;

namespace arcstart::sensor_capture {

// What the camera refuses or does not answer, one line.
class CameraError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// It cannot do what was asked; nothing was changed.
class CameraRefusal : public CameraError {
 public:
  using CameraError::CameraError;
};

class AravisCamera {
 public:
  // Finds the camera, takes control of it, turns the laser off, sets it up and starts it. Throws
  // CameraError. notify: called from other threads when a frame has come or the camera was lost; it
  // must outlive this object.
  AravisCamera(const SensorCaptureSettings& settings, std::function<void()> notify);
  // Laser off, camera stopped and released, where it still answers.
  ~AravisCamera();
  AravisCamera(const AravisCamera&) = delete;
  AravisCamera& operator=(const AravisCamera&) = delete;

  const CameraFound& found() const { return found_; }

  // Returns what the camera reads back; throws CameraRefusal, or CameraError where the camera does
  // not answer and its settings are not known any more.
  CameraSettings apply(const CameraSettings& settings);

  struct NumberedFrame {
    std::uint64_t frame_id;  // the camera's own
    Frame frame;             // seq is not set
  };
  // The next frame that has begun, nothing where none waits.
  std::optional<NumberedFrame> next();

  // Why it must be given up, empty while it answers.
  std::string trouble() const;
  // The camera does not answer: the destructor will not wait for it.
  void give_up(const std::string& why);

  std::string statistics() const;  // Aravis' own, for people

 private:
  template <class T>
  using Owned = std::unique_ptr<T, void (*)(void*)>;

  void connect();
  void set_up();
  void set_up_laser();
  void start();
  void switch_laser(bool on);
  void keep_alive();

  SensorCaptureSettings settings_;
  std::function<void()> notify_;
  CameraFound found_;
  CameraSettings in_force_;
  int sensor_width_ = 0, sensor_height_ = 0;
  bool first_frame_ = true;

  // Above what calls back into this object, so as to outlive it.
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::string trouble_;
  bool ending_ = false;

  Owned<ArvCamera> camera_;
  Owned<ArvStream> stream_;
  std::thread heartbeat_;
};

}  // namespace arcstart::sensor_capture
