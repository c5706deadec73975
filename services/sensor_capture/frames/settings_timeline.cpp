#include "services/sensor_capture/frames/settings_timeline.hpp"

namespace arcstart::sensor_capture {

void SettingsTimeline::begin(const CameraSettings& settings) {
  settings_ = settings;
  ticket_ = 0;
  changes_.clear();
}

void SettingsTimeline::requested(std::int64_t ticket, const CameraSettings& settings,
                                 std::int64_t utime) {
  changes_.push_back({ticket, settings, utime});
}

void SettingsTimeline::applied(std::int64_t ticket, const CameraSettings& settings,
                               std::int64_t utime) {
  for (Change& change : changes_) {
    if (change.ticket != ticket) continue;
    change.settings = settings;
    change.acknowledged = utime;
  }
}

void SettingsTimeline::refused(std::int64_t ticket) {
  std::erase_if(changes_, [&](const Change& change) { return change.ticket == ticket; });
}

SettingsTimeline::InForce SettingsTimeline::take_frame(std::int64_t begin_utime) {
  for (Change& change : changes_)
    if (was_acknowledged(change, begin_utime)) ++change.frames_after;
  while (!changes_.empty() && has_settled(changes_.front())) {
    settings_ = changes_.front().settings;
    ticket_ = changes_.front().ticket;
    changes_.pop_front();
  }
  const auto end_utime = begin_utime + static_cast<std::int64_t>(settings_.exposure_us);
  InForce in_force{settings_, ticket_, true, settings_.laser_on};
  for (const Change& change : changes_) {
    if (change.requested >= end_utime) break;
    in_force.certain = false;
    in_force.lit = change.settings.laser_on && (in_force.lit || change.frames_after > 0);
  }
  return in_force;
}

const CameraSettings& SettingsTimeline::wanted() const {
  return changes_.empty() ? settings_ : changes_.back().settings;
}

bool SettingsTimeline::was_acknowledged(const Change& change, std::int64_t begin_utime) const {
  return change.acknowledged > 0 && begin_utime >= change.acknowledged + margin_us_;
}

bool SettingsTimeline::has_settled(const Change& change) const {
  const bool latched = change.settings.exposure_us != settings_.exposure_us ||
                       change.settings.gain_db != settings_.gain_db;
  return change.frames_after > (latched ? frames_to_settle_ : 0);
}

}  // namespace arcstart::sensor_capture
