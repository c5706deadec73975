#include "services/robot_pose/j519/j519_session.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "services/robot_pose/stream/hand.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr double kMillisecond = 1000;              // us: a tick of the time stamp
constexpr std::int64_t kFirstPause = 500'000;      // us between two questions; doubles
constexpr std::int64_t kLongestPause = 4'000'000;  // us
constexpr std::int64_t kStreamShows = 200'000;     // us: 25 reports of a stream that runs
constexpr std::int64_t kStartShows = 1'000'000;    // us from a start to its first report
constexpr std::int64_t kSilent = 500'000;          // us without a report: it has ended
constexpr int kSwitchedOff = 3;                    // questions without an answer

}  // namespace

J519Session::J519Session(std::optional<Eigen::Isometry3d> T_flange_tool)
    : T_flange_tool_(std::move(T_flange_tool)),
      why_silent_("the controller has not been asked yet"),
      sequence_(kMillisecond, "the controller does not run in real time", counts_, last_error_),
      pause_(kFirstPause) {}

std::optional<J519Session::Bytes> J519Session::step(std::int64_t now) {
  if (state_ == State::kStreaming) {
    if (now - heard_ < kSilent) return std::nullopt;
    why_silent_ = "the controller has stopped streaming";
    why_no_start_ =
        "the stream ended while the controller answers: another client of Stream Motion may have "
        "ended it; end that one, then start robot_pose again";
    ask_again(now);
  }
  if (now < next_) return std::nullopt;
  if (state_ == State::kAnswered) {
    if (may_start_) {
      may_start_ = false;
      ours_ = true;
      why_no_start_ =
          "the controller answers but streams nothing after the start: another client of Stream "
          "Motion may have it; end that one, then start robot_pose again";
      next_ = now + kStartShows;
      return j519_start(version_);
    }
    why_silent_ = why_no_start_;
    ours_ = false;
    pause_ = kLongestPause;
    ask_again(now + kLongestPause);
    return std::nullopt;
  }
  if (unanswered_ > 0)
    why_silent_ =
        "the controller does not answer: is it on, Stream Motion (J519) in it, and address and "
        "port right?";
  if (++unanswered_ > kSwitchedOff) {
    may_start_ = true;
    ours_ = false;
    capability_.reset();  // it may have been set up anew
  }
  next_ = now + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
  return j519_capability_question();
}

void J519Session::ask_again(std::int64_t at) {
  state_ = State::kAsking;
  next_ = at;
}

std::optional<ReportedPosition> J519Session::take(std::span<const std::uint8_t> datagram,
                                                  std::int64_t arrival_utime, std::int64_t now) {
  ++counts_.received;
  const DecodedJ519 decoded = decode_j519(datagram);
  if (!decoded.error.empty()) {
    ++counts_.malformed;
    last_error_ = decoded.error;
    return std::nullopt;
  }
  unanswered_ = 0;
  pause_ = kFirstPause;
  if (decoded.capability) on_capability(*decoded.capability, now);
  return decoded.status ? on_status(*decoded.status, arrival_utime, now) : std::nullopt;
}

std::string J519Session::mismatch(const J519Capability& capability) const {
  if (capability.available_version < kJ519Oldest)
    return fmt::format("the controller has J519 version {}: version 3 or 4 is needed",
                       capability.available_version);
  if (capability.tool && T_flange_tool_)
    return "the controller streams the tool centre point (rob_status_use_tcp 1), whose place in "
           "the flange it does not say: leave robot_pose.tool_in_flange away";
  if (!capability.tool && !T_flange_tool_)
    return "the controller streams the flange (rob_status_use_tcp 0): set "
           "robot_pose.tool_in_flange to the tool frame of the calibration";
  return {};
}

void J519Session::on_capability(const J519Capability& capability, std::int64_t now) {
  if (state_ != State::kAsking) return;
  if (std::string why = mismatch(capability); !why.empty()) {
    why_silent_ = std::move(why);
    capability_.reset();
    pause_ = kLongestPause;
    return ask_again(now + kLongestPause);
  }
  capability_ = capability;
  version_ = std::min(capability.available_version, kJ519Newest);
  state_ = State::kAnswered;
  next_ = now + kStreamShows;
}

std::optional<ReportedPosition> J519Session::on_status(const J519Status& status,
                                                       std::int64_t arrival_utime,
                                                       std::int64_t now) {
  // Whose position it is has to be known first.
  if (!capability_) {
    ++counts_.foreign;
    return std::nullopt;
  }
  state_ = State::kStreaming;
  ours_ = true;
  heard_ = now;
  why_silent_.clear();
  if (!sequence_.take({status.sequence, status.time_stamp, arrival_utime})) return std::nullopt;

  const auto& p = status.position;
  ReportedPosition reported;
  reported.source = RobotProtocol::kJ519;
  reported.position = {p[0], p[1], p[2]};
  reported.rotation = rotation_from_wpr(p[3], p[4], p[5]);
  if (!capability_->tool) {
    Eigen::Isometry3d T_base_flange(reported.rotation);
    T_base_flange.pretranslate(reported.position);
    set_hand(reported, T_base_flange, *T_flange_tool_);
  }
  for (const double joint : status.joints) reported.joints.push_back(joint * EIGEN_PI / 180);
  sequence_.stamp(reported);
  return reported;
}

std::optional<J519Session::Bytes> J519Session::stop() {
  if (!ours_) return std::nullopt;
  ours_ = false;
  return j519_stop(version_);
}

}  // namespace arcstart::robot_pose
