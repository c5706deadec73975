#include "services/robot_pose/stream/report_sequence.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>

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

ReportSequence::ReportSequence(double tick_us, std::string remedy, PoseSourceCounts& counts,
                               std::string& last_error)
    : tick_us_(tick_us), remedy_(std::move(remedy)), counts_(counts), last_error_(last_error) {}

bool ReportSequence::take(const NumberedReport& report) {
  const Place where = place(report);
  begins_ = where == Place::kNewStream;
  arrival_utime_ = report.arrival_utime;
  switch (where) {
    case Place::kElsewhere:
      ++out_of_place_;
      return false;
    case Place::kWrongClock: {
      const std::int64_t ticks = steps(newest_->clock, report.clock);
      lost_since_position_ += steps(newest_->index, report.index) - 1;
      newest_->index = report.index;
      newest_->parts = report.parts;
      device_clock_ = clock_ + ticks;
      invalid_ = last_error_ =
          fmt::format("the controller's clock {} by {:.0f} ms from one report to the next",
                      ticks <= 0 ? "went back" : "jumped ahead",
                      std::abs(static_cast<double>(ticks)) * tick_us_ / 1000);
      return true;
    }
    case Place::kSameReport:
      newest_->index = report.index;
      newest_->parts = static_cast<std::uint16_t>(newest_->parts | report.parts);
      break;
    case Place::kNewStream:
      begin(report);
      break;
    case Place::kNext:
      if (out_of_place_ > 0)
        last_error_ = fmt::format("{} reports came twice, late or out of nowhere and were dropped",
                                  out_of_place_);
      counts_.late += std::exchange(out_of_place_, 0);
      lost_since_position_ += steps(newest_->index, report.index) - 1;
      clock_ += steps(newest_->clock, report.clock);
      newest_ = report;
      break;
  }
  rate_.take(clock_, report.arrival_utime);
  device_clock_ = clock_;
  invalid_ = clock_error();
  return true;
}

void ReportSequence::begin(const NumberedReport& report) {
  if (newest_) {
    last_error_ = fmt::format(
        "the controller's reports began anew (number {} after {}): its clock is mapped afresh",
        report.index, newest_->index);
    lost_since_position_ = 1;
  } else {
    seq_ = static_cast<std::int64_t>(report.index) - 1;
  }
  out_of_place_ = 0;  // they were the first of the new stream
  newest_ = report;
  clock_ = report.clock;
  clock_begins_ = true;
  rate_.restart();
}

void ReportSequence::stamp(ReportedPosition& position) {
  counts_.lost += lost_since_position_;
  seq_ += 1 + std::exchange(lost_since_position_, 0);
  position.seq = seq_;
  position.device_clock = device_clock_;
  position.device_tick_us = tick_us_;
  position.arrival_utime = arrival_utime_;
  if (!invalid_.empty()) {
    if (rate_.tick_us()) last_error_ = invalid_;
    position.invalid = invalid_;
  }
  // Of an invalid one nothing is mapped, so that a new clock still has to be announced.
  if (!position.invalid.empty()) return;
  position.clock_begins = std::exchange(clock_begins_, false);
}

ReportSequence::Place ReportSequence::place(const NumberedReport& report) {
  if (!newest_) return Place::kNewStream;
  const std::int32_t forward = steps(newest_->index, report.index);
  const std::int32_t ticks = steps(newest_->clock, report.clock);
  const std::int64_t elapsed = report.arrival_utime - newest_->arrival_utime;
  const std::int64_t most = elapsed / kShortestPeriod + kNear;  // that may be missing
  if (forward > 0 && forward <= most && ticks > 0 &&
      clock_is_plausible(ticks, report.arrival_utime)) {
    strangers_ = 0;
    return Place::kNext;
  }
  // Tool and joints of one report may come in a packet each, with one number or two.
  const bool other_part = (report.parts & newest_->parts) == 0;
  if (ticks == 0 && (forward == 0 || forward == 1) && other_part) return Place::kSameReport;
  if (ticks == 0 && forward == 0) return Place::kElsewhere;  // a duplicate
  if (forward > 0 && forward <= kNear)
    return place_of_stranger(report, Place::kWrongClock, kLastingJump);
  const bool late = forward <= 0 && forward > -kNear && ticks <= 0 && elapsed < kLongestHold;
  return place_of_stranger(report, Place::kElsewhere, late ? kLastingLateness : kLastingJump);
}

ReportSequence::Place ReportSequence::place_of_stranger(const NumberedReport& report,
                                                        Place otherwise, int lasting) {
  const bool follows = strangers_ > 0 && steps(stranger_->index, report.index) > 0 &&
                       steps(stranger_->index, report.index) <= kNear &&
                       steps(stranger_->clock, report.clock) > 0;
  strangers_ = follows ? strangers_ + 1 : 1;
  stranger_ = report;
  if (strangers_ < lasting) return otherwise;
  strangers_ = 0;
  return Place::kNewStream;
}

// A report may be held up on its way, but cannot come before it was made. By the tick that arrivals
// have shown, not by the one set: else a wrong setting would look like a restart at every packet.
bool ReportSequence::clock_is_plausible(std::int64_t ticks, std::int64_t arrival_utime) const {
  if (!rate_.tick_us()) return true;
  const double device_us = static_cast<double>(ticks) * *rate_.tick_us();
  const auto arrival_us = static_cast<double>(arrival_utime - newest_->arrival_utime);
  return device_us - arrival_us < kClockSlack + 0.1 * std::abs(arrival_us);
}

std::string ReportSequence::clock_error() const {
  const auto measured = rate_.tick_us();
  if (!measured) return "the controller's clock has not been compared with the host's yet";
  const double ratio = *measured / tick_us_;
  if (ratio < kTickTolerance && ratio > 1 / kTickTolerance) return "";
  return fmt::format("a tick of the controller's clock lasts {:.3g} us and not {} us: {}",
                     *measured, tick_us_, remedy_);
}

}  // namespace arcstart::robot_pose
