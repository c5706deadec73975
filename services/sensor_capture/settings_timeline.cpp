#include "services/sensor_capture/settings_timeline.hpp"

namespace arcstart {

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
  while (!changes_.empty() && has_settled(changes_.front(), begin_utime)) {
    settings_ = changes_.front().settings;
    ticket_ = changes_.front().ticket;
    changes_.pop_front();
  }
  const auto end_utime = begin_utime + static_cast<std::int64_t>(settings_.exposure_us);
  InForce in_force{settings_, ticket_, true, settings_.laser_on};
  for (const Change& change : changes_) {
    if (change.requested >= end_utime) break;
    in_force.certain = false;
    const bool laser_settled =
        change.acknowledged > 0 && begin_utime >= change.acknowledged + margin_us_;
    in_force.lit = change.settings.laser_on && (in_force.lit || laser_settled);
  }
  return in_force;
}

const CameraSettings& SettingsTimeline::wanted() const {
  return changes_.empty() ? settings_ : changes_.back().settings;
}

bool SettingsTimeline::has_settled(Change& change, std::int64_t begin_utime) const {
  if (change.acknowledged == 0 || begin_utime < change.acknowledged + margin_us_) return false;
  const bool latched = change.settings.exposure_us != settings_.exposure_us ||
                       change.settings.gain_db != settings_.gain_db;
  return !latched || change.frames_after++ >= frames_to_settle_;
}

}  // namespace arcstart
