// A calibration being made in the cell, over the bus: commands in, images and positions in, camera
// commands and <SENSOR>_CALIBRATION_CAPTURE out.
#pragma once

#include <arcstart/calibration_capture_t.hpp>
#include <arcstart/calibration_command_t.hpp>
#include <arcstart/image_t.hpp>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <string>

#include "common/bus/bus.hpp"
#include "common/service.hpp"
#include "services/calibration/calibration_settings.hpp"
#include "services/calibration/capture/capture_dataset.hpp"
#include "services/calibration/capture/pose_capture.hpp"

namespace arcstart::calibration {

class CaptureSession {
 public:
  // Throws CalibrationSetError: plate or folder cannot be used. The bus outlives the desk.
  CaptureSession(Bus& bus, const CalibrationSettings& settings, const Instance& instance,
                 std::int64_t run_id);

  void tick(std::int64_t now);

 private:
  void take_command(const calibration_command_t& command);
  void take_image(const image_t& image);
  // What takes long runs beside the bus, and throws where it fails.
  struct Result {
    std::string failure, calibration_id, verdict;
  };
  using Work = std::function<Result()>;
  void begin_work(std::int8_t state, std::string activity, Work work);
  void finish_work();
  Result solve() const;
  void publish(std::int64_t now);

  Bus& bus_;
  CalibrationSettings settings_;
  Instance instance_;
  PoseCapture capture_;
  CaptureDataset set_;  // left to work_ while that runs

  std::future<Result> work_;
  std::deque<std::int64_t> known_commands_;
  calibration_capture_t state_{};  // as it is told
  std::int64_t told_ = 0;          // us, UTC
  bool changed_ = true;
};

}  // namespace arcstart::calibration
