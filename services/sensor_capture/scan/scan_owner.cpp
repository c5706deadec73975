#include "services/sensor_capture/scan/scan_owner.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace arcstart::sensor_capture {
namespace {

std::int64_t to_us(double seconds) { return std::llround(seconds * 1e6); }

}  // namespace

ScanOwner::ScanOwner(const ScanOwnerSettings& settings)
    : settings_(settings), standstill_(settings.standstill) {}

void ScanOwner::order(const ScanOrder& order, std::int64_t now, const std::string& camera_trouble) {
  tick(now);
  if (is_known(order.command_id)) return;
  if (!order.start) {
    if (!scanning()) return refuse(order.command_id, "no scan is running");
    if (ending_) return refuse(order.command_id, "the scan has ended already");
    stop_command_id_ = order.command_id;
    return end(now, EndCause::kStop);
  }
  if (scanning())
    return refuse(
        order.command_id,
        fmt::format("a scan is running (begun by command {}): stop it first", state_.command_id));
  if (!camera_trouble.empty()) return refuse(order.command_id, camera_trouble);
  if (!(order.longest_duration_s > 0))
    return refuse(order.command_id, "the longest duration must be above 0 s");
  begin(order, now);
}

Membership ScanOwner::frame(const ExposedFrame& frame) {
  const std::optional<ExposedFrame> before = newest_;
  newest_ = frame;
  if (!scanning()) return {};
  if (!ending_ && frame.end_utime > deadline_) end(deadline_, EndCause::kLongestDuration, before);
  if (!scanning()) return {};  // it came to its end with this very frame
  Scan& scan = state_.scan;
  const bool within =
      frame.begin_utime >= scan.scan_id && (!ending_ || frame.end_utime <= end_utime_);
  Membership membership;
  if (within && frame.lit) {
    if (scan.first_seq < 0)
      scan.first_seq = frame.seq;
    else
      scan.lost += static_cast<std::int32_t>(frame.seq - before->seq - 1);
    scan.last_seq = frame.seq;
    if (!frame.complete) ++scan.lost;
    last_member_end_ = frame.end_utime;
    membership = {scan.scan_id, scan.images++};
  }
  finish_if_complete(before);
  return membership;
}

void ScanOwner::position(std::int64_t utime, const Eigen::Vector3d& position,
                         const Eigen::Quaterniond& rotation) {
  if (!settings_.end_when_still || !laser_wanted() || utime < state_.scan.scan_id) return;
  if (standstill_.take(utime, position, rotation)) end(utime, EndCause::kStandstill);
}

void ScanOwner::camera_lost(std::int64_t now) {
  if (!scanning()) return;
  if (!ending_) end(now, EndCause::kCameraLost);
  if (scanning()) finish();
}

void ScanOwner::tick(std::int64_t now) {
  if (!scanning()) return;
  if (!ending_ && now >= deadline_) end(deadline_, EndCause::kLongestDuration);
  if (ending_ && now >= end_utime_ + longest_delay_us_) finish();
}

bool ScanOwner::is_known(std::int64_t command_id) {
  if (std::find(known_commands_.begin(), known_commands_.end(), command_id) !=
      known_commands_.end())
    return true;
  known_commands_.push_back(command_id);
  if (known_commands_.size() > kCommandsRemembered) known_commands_.pop_front();
  return false;
}

void ScanOwner::refuse(std::int64_t command_id, std::string why) {
  state_.refused_command_id = command_id;
  state_.refusal = std::move(why);
  ++revision_;
}

void ScanOwner::begin(const ScanOrder& order, std::int64_t now) {
  if (state_.phase == ScanState::Phase::kEnded) state_.previous = state_.scan;
  state_.phase = ScanState::Phase::kScanning;
  state_.command_id = order.command_id;
  // Two scans never share an id, nor does one begin before the other's end.
  const std::int64_t begin = std::max(now, state_.scan.end_utime + 1);
  state_.scan = Scan{};
  state_.scan.scan_id = begin;
  state_.scan.kind = order.kind;
  state_.scan.start_command_id = order.command_id;
  state_.scan.purpose = order.purpose;
  deadline_ = begin + to_us(std::min(order.longest_duration_s, settings_.longest_scan_s));
  ending_ = false;
  stop_command_id_ = 0;
  last_member_end_ = 0;
  standstill_.restart();
  ++revision_;
}

void ScanOwner::end(std::int64_t utime, EndCause cause, const std::optional<ExposedFrame>& before) {
  ending_ = true;
  // Frames that were given to the scan lie within it.
  end_utime_ = std::max({utime, last_member_end_, state_.scan.scan_id});
  end_cause_ = cause;
  finish_if_complete(before);
}

// The last frame is known once no exposure that ends in time can still be on its way: the newest
// ended later, or the one after it must.
void ScanOwner::finish_if_complete(const std::optional<ExposedFrame>& before) {
  if (!ending_ || !newest_) return;
  const std::int64_t exposure = newest_->end_utime - newest_->begin_utime;
  const std::int64_t next_end = newest_->begin_utime + shortest_period_us_ + exposure;
  const bool over = newest_->end_utime > end_utime_;
  if (!over && (shortest_period_us_ == 0 || next_end <= end_utime_)) return;
  if (over && before) count_lost_at_end(*before, *newest_);
  finish();
}

// Frames that are missing between the last before the end and the first after it: those that were
// exposed in time belonged to the scan. The camera runs evenly.
void ScanOwner::count_lost_at_end(const ExposedFrame& before, const ExposedFrame& after) {
  if (state_.scan.first_seq < 0) return;
  const std::int64_t steps = after.seq - before.seq;
  for (std::int64_t step = 1; step < steps; ++step)
    if (before.end_utime + (after.end_utime - before.end_utime) * step / steps <= end_utime_)
      ++state_.scan.lost;
}

void ScanOwner::finish() {
  state_.phase = ScanState::Phase::kEnded;
  state_.scan.end_utime = end_utime_;
  state_.scan.end_cause = end_cause_;
  if (stop_command_id_ != 0) state_.command_id = stop_command_id_;
  ending_ = false;
  ++revision_;
}

}  // namespace arcstart::sensor_capture
