// The stream of HSPO packets: which holds a position, whose, and at what place in the sequence.
// Pure: bytes and arrival times in, positions out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "services/robot_pose/hspo/hspo_packet.hpp"
#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/stream/report_sequence.hpp"

namespace arcstart::robot_pose {

class HspoStream {
 public:
  // clock_tick_us: length of a tick of the controller's clock (1 us or 2 ms by controller).
  // motion_group: whose position is wanted; packets of others are counted and dropped.
  HspoStream(double clock_tick_us, int motion_group);
  HspoStream(const HspoStream&) = delete;
  HspoStream& operator=(const HspoStream&) = delete;

  // The position in a datagram, nothing where it holds none of use. Positions are invalid until
  // arrivals have shown that the tick is as set, and while they show that it is not.
  std::optional<ReportedPosition> take(std::span<const std::uint8_t> datagram,
                                       std::int64_t arrival_utime);

  const PoseSourceCounts& counts() const { return counts_; }
  const std::string& last_error() const { return last_error_; }

 private:
  std::optional<ReportedPosition> position(const ReceivedHspo& packet);

  int motion_group_;
  PoseSourceCounts counts_;
  std::string last_error_;
  ReportSequence sequence_;
  bool seen_tool_ = false;

  struct Joints {
    std::uint32_t clock;
    std::array<double, 9> values;
  };
  std::optional<Joints> joints_;  // newest, for a tool that comes in a packet of its own
};

}  // namespace arcstart::robot_pose
