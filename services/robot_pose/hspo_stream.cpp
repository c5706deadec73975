#include "services/robot_pose/hspo_stream.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "services/robot_pose/wpr.hpp"

namespace arcstart::robot_pose {
namespace {

// A packet out of its place is dropped; so many that follow one another are a restarted controller.
// Late packets come in bursts when a network reorders, so of those more are asked.
constexpr int kLastingJump = 3;
constexpr int kLastingLateness = 10;
constexpr std::int32_t kNear = 100;               // packets that a network may hold back
constexpr std::int64_t kLongestHold = 1'000'000;  // us, likewise
constexpr double kClockSlack = 1e6;               // us between elapsed device and arrival time
constexpr double kTickTolerance = 1.6;            // a wrong tick setting is wrong by 2 at least
constexpr std::int64_t kShortestPeriod = 1000;    // us between two reports

std::int32_t steps(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::int32_t>(to - from);
}

}  // namespace

HspoStream::HspoStream(double clock_tick_us, int motion_group)
    : clock_tick_us_(clock_tick_us), motion_group_(motion_group) {}

std::optional<ReportedPosition> HspoStream::take(std::span<const std::uint8_t> datagram,
                                                 std::int64_t arrival_utime) {
  ++counts_.received;
  const DecodedHspo decoded = decode_hspo(datagram);
  if (!decoded.packet) {
    ++counts_.malformed;
    last_error_ = decoded.error;
    return std::nullopt;
  }
  const ReceivedHspo& packet = *decoded.packet;
  if (packet.motion_group && *packet.motion_group != motion_group_) {
    ++counts_.foreign;
    last_error_ = fmt::format("positions of motion group {} come, group {} is wanted",
                              *packet.motion_group, motion_group_);
    return std::nullopt;
  }

  switch (place(packet, arrival_utime)) {
    case Place::kElsewhere:
      ++out_of_place_;
      return std::nullopt;
    case Place::kSameReport:
      newest_->index = packet.index;
      newest_->types = static_cast<std::uint16_t>(newest_->types | packet.types);
      break;
    case Place::kWrongClock: {
      const std::int64_t ticks = steps(newest_->clock, packet.clock);
      lost_since_position_ += steps(newest_->index, packet.index) - 1;
      newest_->index = packet.index;
      newest_->types = packet.types;
      auto reported = position(packet, arrival_utime);
      if (!reported) return reported;
      reported->device_clock += ticks;
      reported->invalid =
          fmt::format("the controller's clock {} by {:.0f} ms from one report to the next",
                      ticks <= 0 ? "went back" : "jumped ahead",
                      std::abs(static_cast<double>(ticks)) * clock_tick_us_ / 1000);
      last_error_ = reported->invalid;
      return reported;
    }
    case Place::kNewStream:
      if (newest_) {
        last_error_ = fmt::format(
            "the controller's reports began anew (number {} after {}): its clock is mapped afresh",
            packet.index, newest_->index);
        lost_since_position_ = 1;
      } else {
        seq_ = static_cast<std::int64_t>(packet.index) - 1;
      }
      out_of_place_ = 0;  // they were the first of the new stream
      newest_ = {packet.index, packet.clock, arrival_utime, packet.types};
      clock_ = packet.clock;
      clock_begins_ = true;
      joints_.reset();
      rate_.restart();
      break;
    case Place::kNext:
      if (out_of_place_ > 0)
        last_error_ = fmt::format("{} reports came twice, late or out of nowhere and were dropped",
                                  out_of_place_);
      counts_.late += std::exchange(out_of_place_, 0);
      lost_since_position_ += steps(newest_->index, packet.index) - 1;
      clock_ += steps(newest_->clock, packet.clock);
      newest_ = {packet.index, packet.clock, arrival_utime, packet.types};
      break;
  }
  rate_.take(clock_, arrival_utime);
  if (packet.joints) joints_ = {packet.clock, *packet.joints};
  auto reported = position(packet, arrival_utime);
  if (!reported) return reported;
  reported->invalid = clock_error();
  if (!reported->invalid.empty()) {
    if (rate_.tick_us()) last_error_ = reported->invalid;
    return reported;  // nothing is mapped yet, so that a new clock still has to be announced
  }
  reported->clock_begins = clock_begins_;
  clock_begins_ = false;
  return reported;
}

HspoStream::Place HspoStream::place(const ReceivedHspo& packet, std::int64_t arrival_utime) {
  if (!newest_) return Place::kNewStream;
  const std::int32_t forward = steps(newest_->index, packet.index);
  const std::int32_t ticks = steps(newest_->clock, packet.clock);
  const std::int64_t most =
      (arrival_utime - newest_->arrival_utime) / kShortestPeriod + kNear;  // that may be missing
  if (forward > 0 && forward <= most && ticks > 0 && clock_is_plausible(ticks, arrival_utime)) {
    strangers_ = 0;
    return Place::kNext;
  }
  // Tool and joints of one report may come in a packet each, with one number or two.
  const bool other_part = (packet.types & newest_->types) == 0;
  if (ticks == 0 && (forward == 0 || forward == 1) && other_part) return Place::kSameReport;
  if (ticks == 0 && forward == 0) return Place::kElsewhere;  // a duplicate
  if (forward > 0 && forward <= kNear)
    return place_of_stranger(packet, Place::kWrongClock, kLastingJump);
  const bool late = forward <= 0 && forward > -kNear && ticks <= 0 &&
                    arrival_utime - newest_->arrival_utime < kLongestHold;
  return place_of_stranger(packet, Place::kElsewhere, late ? kLastingLateness : kLastingJump);
}

HspoStream::Place HspoStream::place_of_stranger(const ReceivedHspo& packet, Place otherwise,
                                                int lasting) {
  const bool follows = strangers_ > 0 && steps(stranger_->index, packet.index) > 0 &&
                       steps(stranger_->index, packet.index) <= kNear &&
                       steps(stranger_->clock, packet.clock) > 0;
  strangers_ = follows ? strangers_ + 1 : 1;
  stranger_ = Newest{packet.index, packet.clock, 0, packet.types};
  if (strangers_ < lasting) return otherwise;
  strangers_ = 0;
  return Place::kNewStream;
}

// A report may be held up on its way, but cannot come before it was made. By the tick that arrivals
// have shown, not by the one set: else a wrong setting would look like a restart at every packet.
bool HspoStream::clock_is_plausible(std::int64_t ticks, std::int64_t arrival_utime) const {
  if (!rate_.tick_us()) return true;
  const double device_us = static_cast<double>(ticks) * *rate_.tick_us();
  const auto arrival_us = static_cast<double>(arrival_utime - newest_->arrival_utime);
  return device_us - arrival_us < kClockSlack + 0.1 * std::abs(arrival_us);
}

std::optional<ReportedPosition> HspoStream::position(const ReceivedHspo& packet,
                                                     std::int64_t arrival_utime) {
  if (!packet.tool) {
    if (seen_tool_) return std::nullopt;  // joints in a packet of their own
    ++counts_.foreign;
    last_error_ = fmt::format(
        "packets of type {} come and none with the actual tool centre point: set type 1 in the "
        "controller",
        packet.types);
    return std::nullopt;
  }
  seen_tool_ = true;
  counts_.lost += lost_since_position_;
  seq_ += 1 + lost_since_position_;
  lost_since_position_ = 0;

  ReportedPosition reported;
  reported.source = RobotProtocol::kHspo;
  reported.seq = seq_;
  const auto& tool = *packet.tool;
  reported.position = {tool[0], tool[1], tool[2]};
  reported.rotation = rotation_from_wpr(tool[3], tool[4], tool[5]);
  if (packet.joints) {
    reported.joints.assign(packet.joints->begin(), packet.joints->end());
  } else if (joints_ && joints_->clock == packet.clock) {
    reported.joints.assign(joints_->values.begin(), joints_->values.end());
  }
  reported.device_clock = clock_;
  reported.device_tick_us = clock_tick_us_;
  reported.arrival_utime = arrival_utime;
  return reported;
}

std::string HspoStream::clock_error() const {
  const auto measured = rate_.tick_us();
  if (!measured) return "the controller's clock has not been compared with the host's yet";
  const double ratio = *measured / clock_tick_us_;
  if (ratio < kTickTolerance && ratio > 1 / kTickTolerance) return "";
  return fmt::format(
      "a tick of the controller's clock lasts {:.3g} us and not {} us: set "
      "robot_pose.clock_tick_us",
      *measured, clock_tick_us_);
}

}  // namespace arcstart::robot_pose
