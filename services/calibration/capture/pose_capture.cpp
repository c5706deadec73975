#include "services/calibration/capture/pose_capture.hpp"

#include <numbers>

namespace arcstart::calibration {
namespace {

constexpr std::int64_t kLongestOffset = 100'000;  // us, between image and position stamps
constexpr std::int64_t kLongestGap = 500'000;     // us without positions, which proves nothing
constexpr std::int64_t kRestPatience = 10'000'000, kImagePatience = 5'000'000;  // us
constexpr std::int64_t kRepeat = 200'000;                                       // us
constexpr std::size_t kMostPositions = 5000;

// Mean position and mean orientation (of nearly equal quaternions), which have less noise than one.
template <class Positions>
RigidTransform mean(const Positions& positions) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  const Eigen::Quaterniond first(positions.front().T_base_tool.linear());
  for (const auto& position : positions) {
    place += position.T_base_tool.translation();
    const Eigen::Quaterniond rotation(position.T_base_tool.linear());
    turn += rotation.dot(first) < 0 ? Eigen::Vector4d(-rotation.coeffs()) : rotation.coeffs();
  }
  return make_transform(place / static_cast<double>(positions.size()), Eigen::Quaterniond(turn));
}

}  // namespace

const char* PoseCapture::activity() const {
  switch (step_) {
    case Step::kWaitsForRest:
      return "waits for the robot to stand still";
    case Step::kGrid:
      return "takes the image of the plate";
    case Step::kLaser:
      return "takes the image of the stripe";
    case Step::kRestsOn:
      return "makes sure that the robot stood still";
    case Step::kIdle:
      break;
  }
  return "";
}

void PoseCapture::begin(std::int64_t now) {
  failure_.clear();
  pose_ = {};
  go_on(Step::kWaitsForRest, now);
}

bool PoseCapture::apart(const RigidTransform& a, const RigidTransform& b) const {
  const double angle =
      Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
  return (a.translation() - b.translation()).norm() > settings_.still_distance_mm ||
         angle > settings_.still_angle_deg * std::numbers::pi / 180;
}

void PoseCapture::take_position(std::int64_t utime, const RigidTransform& T_base_tool) {
  if (!rest_.empty() && utime <= rest_.back().utime) return;
  const bool gap = !rest_.empty() && utime - rest_.back().utime > kLongestGap;
  const bool moved = !rest_.empty() && apart(rest_.front().T_base_tool, T_base_tool);
  if (moved && step_ > Step::kWaitsForRest)
    fail("the robot moved while its images were taken: let it stand still and capture again");
  if (gap && step_ > Step::kWaitsForRest)
    fail("positions were missing while the images were taken: capture again");
  if (gap || moved) rest_.clear();
  rest_.push_back({utime, T_base_tool});
  // The first stays: a slow drift is a movement as well.
  if (rest_.size() > kMostPositions) rest_.erase(rest_.begin() + 1);
}

void PoseCapture::take_image(std::int64_t command_id, std::int64_t utime, bool laser_on,
                             const cv::Mat& grey, const std::string& reason) {
  if ((step_ != Step::kGrid && step_ != Step::kLaser) || command_id != command_id_) return;
  if (!reason.empty()) {
    asked_ = 0;  // under another id, for the camera takes each once
    command_id_ = 0;
    return;
  }
  if (laser_on != (step_ == Step::kLaser))
    return fail(laser_on ? "the laser cannot be switched off: the plate's image would show it"
                         : "the laser stayed dark: is it connected to the camera's output?");
  (step_ == Step::kGrid ? pose_.grid : pose_.laser) = grey.clone();
  last_image_ = utime;
  go_on(step_ == Step::kGrid ? Step::kLaser : Step::kRestsOn, utime);
}

std::optional<WantedImage> PoseCapture::wanted(std::int64_t now) {
  if (step_ != Step::kGrid && step_ != Step::kLaser) return {};
  if (now - asked_ < kRepeat && now >= asked_) return {};
  asked_ = now;
  if (command_id_ == 0) command_id_ = now;
  const bool laser = step_ == Step::kLaser;
  return WantedImage{command_id_, laser ? settings_.laser_exposure_us : settings_.grid_exposure_us,
                     laser};
}

std::optional<PoseCapture::Outcome> PoseCapture::tick(std::int64_t now) {
  if (step_ == Step::kIdle) return {};
  const std::int64_t waited = now - step_began_;
  if (failure_.empty() && step_ == Step::kWaitsForRest) {
    const bool fresh = !rest_.empty() && now - rest_.back().utime < kLongestGap;
    const auto rested = rest_.empty() ? 0 : rest_.back().utime - rest_.front().utime;
    if (fresh && static_cast<double>(rested) >= settings_.still_duration_s * 1e6 + kLongestOffset)
      go_on(Step::kGrid, now);
    else if (waited > kRestPatience)
      fail(fresh ? "the robot does not stand still"
                 : "no positions come: is robot_pose running, and the robot on?");
  } else if (failure_.empty() && waited > kImagePatience) {
    fail(step_ == Step::kRestsOn
             ? "no positions come after the images: is robot_pose running?"
             : "no image came: is sensor_capture running with its camera, and no scan under way?");
  } else if (failure_.empty() && step_ == Step::kRestsOn &&
             rest_.back().utime > last_image_ + kLongestOffset) {
    pose_.T_base_tool = mean(rest_);
    step_ = Step::kIdle;
    return Outcome{std::move(pose_), ""};
  }
  if (failure_.empty()) return {};
  step_ = Step::kIdle;
  return Outcome{{}, failure_};
}

void PoseCapture::go_on(Step step, std::int64_t now) {
  step_ = step;
  step_began_ = now;
  asked_ = command_id_ = 0;
}

void PoseCapture::fail(const std::string& why) {
  if (failure_.empty()) failure_ = why;
}

}  // namespace arcstart::calibration
