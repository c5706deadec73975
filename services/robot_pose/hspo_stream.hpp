// The sequence of HSPO packets: numbers and clock unwrapped, losses counted, duplicates and late
// packets dropped, a restarted controller recognised. Pure: bytes and arrival times in, positions
// out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "services/robot_pose/clock_rate.hpp"
#include "services/robot_pose/hspo_packet.hpp"
#include "services/robot_pose/pose_source.hpp"

namespace arcstart::robot_pose {

class HspoStream {
 public:
  // clock_tick_us: length of a tick of the controller's clock (1 us or 2 ms by controller).
  // motion_group: whose position is wanted; packets of others are counted and dropped.
  HspoStream(double clock_tick_us, int motion_group);

  // The position in a datagram, nothing where it holds none of use. Positions are invalid until
  // arrivals have shown that the tick is as set, and while they show that it is not.
  std::optional<ReportedPosition> take(std::span<const std::uint8_t> datagram,
                                       std::int64_t arrival_utime);

  const PoseSourceCounts& counts() const { return counts_; }
  const std::string& last_error() const { return last_error_; }

 private:
  // Where a packet stands to the one before.
  enum class Place { kNext, kSameReport, kWrongClock, kElsewhere, kNewStream };
  Place place(const ReceivedHspo& packet, std::int64_t arrival_utime);
  Place place_of_stranger(const ReceivedHspo& packet, Place otherwise, int lasting);
  bool clock_is_plausible(std::int64_t ticks, std::int64_t arrival_utime) const;
  std::optional<ReportedPosition> position(const ReceivedHspo& packet, std::int64_t arrival_utime);
  std::string clock_error() const;

  double clock_tick_us_;
  int motion_group_;
  PoseSourceCounts counts_;
  std::string last_error_;

  struct Newest {
    std::uint32_t index, clock;
    std::int64_t arrival_utime;
    std::uint16_t types;
  };
  std::optional<Newest> newest_;
  std::optional<Newest> stranger_;  // the last packet that did not follow the newest
  int strangers_ = 0;               // that followed one another
  int out_of_place_ = 0;            // dropped since the newest
  std::int64_t clock_ = 0;          // of the newest, unwrapped
  std::int64_t seq_ = -1;
  std::int64_t lost_since_position_ = 0;
  bool clock_begins_ = true;
  bool seen_tool_ = false;
  ClockRate rate_;

  struct Joints {
    std::uint32_t clock;
    std::array<double, 9> values;
  };
  std::optional<Joints> joints_;  // newest, for a tool that comes in a packet of its own
};

}  // namespace arcstart::robot_pose
