// The reports of a controller in sequence: numbers and clock unwrapped, losses counted, duplicates
// and late reports dropped, a restarted controller recognised. Pure: it reads no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/stream/clock_rate.hpp"

namespace arcstart::robot_pose {

// What a report says of its place in the stream.
struct NumberedReport {
  std::uint32_t index, clock;  // of the controller, clock in its ticks; both wrap
  std::int64_t arrival_utime;  // us, UTC
  std::uint16_t parts = 1;     // bits: which it holds, where one report comes in several packets
};

class ReportSequence {
 public:
  // tick_us: length of a tick of the controller's clock. remedy: what to do where arrivals show
  // another. Losses, late reports and troubles go into counts and last_error, which outlive this.
  ReportSequence(double tick_us, std::string remedy, PoseSourceCounts& counts,
                 std::string& last_error);

  // False: the report is out of place and dropped.
  bool take(const NumberedReport& report);

  // The report taken last is the first of a new stream: nothing of the one before goes on.
  bool begins() const { return begins_; }

  // The position that the report taken last holds gets its number, clock, arrival and validity.
  // Positions are invalid until arrivals have shown that the tick is as said, while they show that
  // it is not, and where the clock jumps by itself; one that is invalid already stays so.
  void stamp(ReportedPosition& position);

 private:
  // Where a report stands to the one before.
  enum class Place { kNext, kSameReport, kWrongClock, kElsewhere, kNewStream };
  Place place(const NumberedReport& report);
  Place place_of_stranger(const NumberedReport& report, Place otherwise, int lasting);
  void begin(const NumberedReport& report);
  bool clock_is_plausible(std::int64_t ticks, std::int64_t arrival_utime) const;
  std::string clock_error() const;

  double tick_us_;
  std::string remedy_;
  PoseSourceCounts& counts_;
  std::string& last_error_;

  std::optional<NumberedReport> newest_;
  std::optional<NumberedReport> stranger_;  // the last that did not follow the newest
  int strangers_ = 0;                       // that followed one another
  int out_of_place_ = 0;                    // dropped since the newest
  std::int64_t clock_ = 0;                  // of the newest, unwrapped
  std::int64_t seq_ = -1;
  std::int64_t lost_since_position_ = 0;
  bool clock_begins_ = true;
  ClockRate rate_;

  // Of the report taken last.
  bool begins_ = false;
  std::int64_t device_clock_ = 0, arrival_utime_ = 0;
  std::string invalid_;
};

}  // namespace arcstart::robot_pose
