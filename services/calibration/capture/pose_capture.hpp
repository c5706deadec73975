// One pose of a calibration, captured: the robot at rest, the plate without the laser and the
// stripe on it, each image surely under its own settings.
#pragma once

#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "common/geometry.hpp"

namespace arcstart::calibration {

struct PoseCaptureSettings {
  double grid_exposure_us = 20000, laser_exposure_us = 2000;
  double still_duration_s = 0.5;  // that the robot must have rested before the first image
  double still_distance_mm = 0.2, still_angle_deg = 0.02;  // that counts as movement
};

// What the camera is asked for: one image.
struct WantedImage {
  std::int64_t command_id;
  double exposure_us;
  bool laser_on;
};

struct CapturedPose {
  RigidTransform T_base_tool;  // mean of the positions at rest
  cv::Mat grid, laser;         // grey, 8 bit, whole sensor
};

// Times in us, UTC, host clock; never read here. Position and image stamps may differ by the cell's
// time offset, 0.1 s at most: the robot must rest so much longer on both sides.
class PoseCapture {
 public:
  explicit PoseCapture(const PoseCaptureSettings& settings) : settings_(settings) {}

  void begin(std::int64_t now);
  bool is_running() const { return step_ != Step::kIdle; }
  const char* activity() const;  // for people, empty when idle

  void take_position(std::int64_t utime, const RigidTransform& T_base_tool);
  // An image that a camera command asked for; `reason` says why it has no pixels.
  void take_image(std::int64_t command_id, std::int64_t utime, bool laser_on, const cv::Mat& grey,
                  const std::string& reason);

  // To be asked of the camera at `now`, repeated until the image has come.
  std::optional<WantedImage> wanted(std::int64_t now);

  // Once, when the capture ends: the pose, or nothing and failure() says why.
  struct Outcome {
    std::optional<CapturedPose> pose;
    std::string failure;
  };
  std::optional<Outcome> tick(std::int64_t now);

 private:
  enum class Step { kIdle, kWaitsForRest, kGrid, kLaser, kRestsOn };
  struct Position {
    std::int64_t utime;
    RigidTransform T_base_tool;
  };
  bool apart(const RigidTransform& a, const RigidTransform& b) const;
  void go_on(Step step, std::int64_t now);
  void fail(const std::string& why);

  PoseCaptureSettings settings_;
  Step step_ = Step::kIdle;
  std::int64_t step_began_ = 0, asked_ = 0, command_id_ = 0;
  std::deque<Position> rest_;  // positions since the robot stands where it stands
  std::int64_t last_image_ = 0;
  std::string failure_;
  CapturedPose pose_;
};

}  // namespace arcstart::calibration
