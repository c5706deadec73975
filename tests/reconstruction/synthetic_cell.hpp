// A cell with a table at z = 0 and a sensor that moves and turns over it, in OpenCV's algebra and
// own quaternions: the truth by which reconstruction is judged shares no code with it.
#pragma once

#include <arcstart/robot_pose_t.hpp>
#include <arcstart/stripe_t.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "common/calibration.hpp"

namespace arcstart::test {

constexpr std::int64_t kBegin = 1'700'000'000'000'000;  // us
constexpr std::int64_t kImageDelay = 27'320;            // us: images are stamped so much too late

// The calibration that is true in this cell.
Calibration true_calibration();

// T_base_tool, s after kBegin: constant velocity, constant rate about an axis of the tool.
cv::Matx44d tool_at(double seconds);

// The controller's position at this time after kBegin, us.
robot_pose_t pose_at(std::int64_t time);

struct TrueStripe {
  stripe_t message{};
  std::vector<cv::Vec3d> points;  // on the table in base, one for each centre; mm
};
// Exposed at this time after kBegin, us; stamped kImageDelay later.
TrueStripe stripe_at(std::int64_t time, int number, std::int64_t scan_id);

// A stripe without a centre.
stripe_t empty_stripe_at(std::int64_t time, int number, std::int64_t scan_id);

}  // namespace arcstart::test
