#include "services/robot_pose/rtde/rtde_session.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "services/robot_pose/stream/hand.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr const char* kNames[] = {"timestamp", "actual_TCP_pose", "actual_q", "tcp_offset"};
constexpr const char* kTypes[] = {"DOUBLE", "VECTOR6D", "VECTOR6D", "VECTOR6D"};
constexpr std::size_t kNeeded = 3;         // of these without the tool's offset
constexpr double kMicrosecond = 1;         // us: the time stamp in ticks of this length
constexpr double kSameOffset = 1e-6;       // m and rad: what a controller's arithmetic may make
constexpr double kMostPeriodsLost = 1e6;   // beyond it is a clock that jumped
constexpr double kWholeTurn = 4294967296;  // 2^32: where a u32 wraps

// x y z m, rotation vector rad.
Eigen::Isometry3d pose_from(const std::array<double, 6>& v) {
  const Eigen::Vector3d turn(v[3], v[4], v[5]);
  const double angle = turn.norm();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = 1000 * Eigen::Vector3d(v[0], v[1], v[2]);
  if (angle > 0) pose.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  return pose;
}

}  // namespace

RtdeSession::RtdeSession(double rate_hz, std::optional<Eigen::Isometry3d> T_flange_tool)
    : rate_hz_(rate_hz),
      T_flange_tool_(std::move(T_flange_tool)),
      sequence_(kMicrosecond, "the controller does not run in real time", counts_, last_error_) {}

RtdeSession::Bytes RtdeSession::begin() {
  state_ = State::kVersion;
  reader_ = {};
  with_tool_offset_ = true;
  text_.clear();
  return rtde_version_request();
}

RtdeSession::Step RtdeSession::take(std::span<const std::uint8_t> bytes,
                                    std::int64_t arrival_utime) {
  Step step;
  reader_.add(bytes);
  while (step.fault.empty()) {
    const auto frame = reader_.next();
    if (!frame) break;
    on_frame(*frame, arrival_utime, step);
  }
  if (step.fault.empty() && !reader_.error().empty())
    step.fault = reader_.error() + ": is the port RTDE's (30004)?";
  if (!step.fault.empty() && !text_.empty()) step.fault += "; the controller says: " + text_;
  return step;
}

void RtdeSession::on_frame(const RtdeFrame& frame, std::int64_t arrival_utime, Step& step) {
  const auto& payload = frame.payload;
  if (frame.type == rtde_type::kText) {
    text_ = decode_rtde_text(payload);
    return;
  }
  if (frame.type == rtde_type::kData && state_ == State::kStreaming) {
    if (auto position = on_data(frame, arrival_utime)) step.positions.push_back(*position);
    return;
  }
  const bool yes_or_no = payload.size() == 1;
  if (frame.type == rtde_type::kVersion && state_ == State::kVersion && yes_or_no)
    return on_version(payload[0] != 0, step);
  if (frame.type == rtde_type::kOutputs && state_ == State::kRecipe)
    return on_recipe(payload, step);
  if (frame.type == rtde_type::kStart && state_ == State::kStart && yes_or_no)
    return on_start(payload[0] != 0, step);
  step.fault =
      fmt::format("the controller sent a frame of type {} with {} bytes, and owed an answer to {}",
                  static_cast<char>(frame.type), payload.size() + 3, awaited());
}

void RtdeSession::on_version(bool accepted, Step& step) {
  if (!accepted) {
    step.fault = "the controller refuses RTDE protocol version 2: its software is too old";
    return;
  }
  state_ = State::kRecipe;
  step.request = outputs_request();
}

RtdeSession::Bytes RtdeSession::outputs_request() const {
  std::string names = kNames[0];
  for (std::size_t i = 1; i < kNeeded + (with_tool_offset_ ? 1 : 0); ++i)
    names += std::string(",") + kNames[i];
  return rtde_outputs_request(rate_hz_, names);
}

void RtdeSession::on_recipe(std::span<const std::uint8_t> payload, Step& step) {
  const std::size_t asked = kNeeded + (with_tool_offset_ ? 1 : 0);
  const auto recipe = decode_rtde_recipe(payload);
  if (!recipe || recipe->types.size() != asked) {
    step.fault = fmt::format("the controller answers {} output variables with {} types", asked,
                             recipe ? recipe->types.size() : 0);
    return;
  }
  for (std::size_t i = 0; i < asked; ++i) {
    const std::string& type = recipe->types[i];
    if (type == kTypes[i]) continue;
    // Without it a change of tool cannot be seen, which HSPO does not show either.
    if (i == kNeeded && type == "NOT_FOUND" && !T_flange_tool_) {
      with_tool_offset_ = false;
      step.request = outputs_request();
      return;
    }
    if (type == "NOT_FOUND")
      step.fault = fmt::format(
          "the controller does not know the output variable {}: its software is too old",
          kNames[i]);
    else if (type == "IN_USE")
      step.fault = fmt::format("the output variable {} is in use by another client", kNames[i]);
    else
      step.fault = fmt::format("the output variable {} has type {:.40} and not {}", kNames[i], type,
                               kTypes[i]);
    return;
  }
  if (recipe->id == 0) {
    step.fault = fmt::format(
        "the controller refuses the output recipe at {} Hz: set "
        "robot_pose.rate_hz (CB3: 125, e-Series: 500)",
        rate_hz_);
    return;
  }
  recipe_ = recipe->id;
  state_ = State::kStart;
  step.request = rtde_request(rtde_type::kStart);
}

void RtdeSession::on_start(bool accepted, Step& step) {
  if (accepted)
    state_ = State::kStreaming;
  else
    step.fault = "the controller refuses to start the output";
}

std::optional<ReportedPosition> RtdeSession::on_data(const RtdeFrame& frame,
                                                     std::int64_t arrival_utime) {
  ++counts_.received;
  const DecodedRtdeData decoded = decode_rtde_data(frame.payload, with_tool_offset_);
  if (!decoded.data) {
    ++counts_.malformed;
    last_error_ = decoded.error;
    return std::nullopt;
  }
  const RtdeData& data = *decoded.data;
  if (data.recipe != recipe_) {
    ++counts_.foreign;
    last_error_ =
        fmt::format("RTDE data of recipe {} come, {} was asked for", data.recipe, recipe_);
    return std::nullopt;
  }
  // RTDE numbers nothing: periods that passed on the controller's clock count the reports.
  const double periods = timestamp_ ? std::round((data.timestamp - *timestamp_) * rate_hz_) : 1;
  index_ += static_cast<std::uint32_t>(std::clamp(periods, 1.0, kMostPeriodsLost));
  timestamp_ = data.timestamp;
  const double clock_us = std::round(data.timestamp * 1e6);
  const auto clock = static_cast<std::uint32_t>(std::fmod(clock_us, kWholeTurn));
  if (!sequence_.take({index_, clock, arrival_utime})) return std::nullopt;

  ReportedPosition reported;
  reported.source = RobotProtocol::kRtde;
  reported.user_frame = 0;
  reported.joints.assign(data.joints.begin(), data.joints.end());
  if (!place_hand(data, reported))
    reported.invalid = last_error_ =
        "the tool centre point was changed at the controller and is no longer the calibration's: "
        "set it back, or set robot_pose.tool_in_flange";
  sequence_.stamp(reported);
  return reported;
}

// False: the controller's tool centre point is no longer where it was in the flange.
bool RtdeSession::place_hand(const RtdeData& data, ReportedPosition& reported) {
  const Eigen::Isometry3d T_base_tcp = pose_from(data.pose);
  if (T_flange_tool_) {
    set_hand(reported, T_base_tcp * pose_from(*data.tool_offset).inverse(), *T_flange_tool_);
    return true;
  }
  reported.position = T_base_tcp.translation();
  reported.rotation = Eigen::Quaterniond(T_base_tcp.linear()).normalized();
  if (!data.tool_offset) return true;
  if (!tool_offset_) tool_offset_ = data.tool_offset;
  for (std::size_t i = 0; i < 6; ++i)
    if (std::abs((*data.tool_offset)[i] - (*tool_offset_)[i]) > kSameOffset) return false;
  return true;
}

std::string RtdeSession::awaited() const {
  std::string what = "the request for version 2";
  if (state_ == State::kRecipe) what = "the output recipe";
  if (state_ == State::kStart) what = "the start";
  if (state_ == State::kStreaming) what = "nothing but data";
  return what;
}

}  // namespace arcstart::robot_pose
