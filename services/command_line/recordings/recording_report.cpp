// What a person is told of a recording: what it lacks, what is damaged, why a scan has no answer.
#include <fmt/core.h>

#include <algorithm>

#include "services/command_line/recordings/recording.hpp"

namespace arcstart::command_line {

std::string stage_name(Stage stage) {
  return stage == Stage::kImages ? "images" : stage == Stage::kStripes ? "stripes" : "profiles";
}

void Recording::require_channels() const {
  const auto require = [this](ChannelKind kind, const std::string& channel,
                              const std::string& meaning) {
    if (has(kind)) return;
    const auto damaged = undecodable_.find(channel);
    throw RecordingError(
        fmt::format("{}: lacks channel {} ({}){}", name_, channel, meaning,
                    damaged == undecodable_.end() ? "" : ": none of its messages can be decoded"));
  };
  require(ChannelKind::kScan, sensor_ + "_SCAN",
          "when scans begin and end, and how many images they have");
  if (scans_.empty())
    throw RecordingError(fmt::format(
        "{}: holds no scan: {}_SCAN never tells of one, and no image, stripe or profile "
        "belongs to one",
        name_, sensor_));
  const bool needs_poses = std::any_of(scans_.begin(), scans_.end(), [](const auto& scan) {
    return scan.second.stage() != Stage::kProfiles;
  });
  if (!needs_poses) return;
  require(ChannelKind::kPose, robot_ + "_POSE",
          "the robot's positions, without which no stripe finds its place");
  require(ChannelKind::kCalibration, sensor_ + "_CALIBRATION",
          "the calibration, without which no stripe becomes points");
}

std::string Recording::why_unanswered(const RecordedScan& scan) const {
  const auto stage = static_cast<std::size_t>(scan.stage());
  if (!scan.kind) return fmt::format("{}_SCAN never tells of it", sensor_);
  if (!scan.ended)
    return fmt::format("the recording ends within it, {} {} after its start", scan.messages[stage],
                       stage_name(scan.stage()));
  if (scan.newest[stage] < scan.last_seq)
    return fmt::format("its last {} are missing from the recording (up to seq {}, {} is there)",
                       stage_name(scan.stage()), scan.last_seq, scan.newest[stage]);
  if (scan.stage() != Stage::kProfiles && newest_pose_ <= scan.newest_utime)
    return "the recording holds no position of the robot after its last image";
  return "its last profile never came";
}

std::int64_t Recording::undecodable() const {
  std::int64_t sum = 0;
  for (const auto& [channel, noted] : undecodable_) sum += noted.count;
  return sum;
}

std::vector<std::string> Recording::warnings() const {
  std::vector<std::string> lines = warnings_;
  for (const auto& [channel, noted] : undecodable_)
    lines.push_back(
        fmt::format("{}: {}: {} messages cannot be decoded and are left out; the first is {}",
                    name_, printable(channel), noted.count, noted.why));
  for (const auto& [id, scan] : scans_) {
    const auto stage = static_cast<std::size_t>(scan.stage());
    for (std::size_t later = stage + 1; later < scan.messages.size(); ++later)
      if (scan.messages[later] > scan.messages[stage])
        lines.push_back(
            fmt::format("{}: scan {}: {} of its {} were recorded, but {} {}: the logger lost some",
                        name_, id, scan.messages[stage], stage_name(scan.stage()),
                        scan.messages[later], stage_name(static_cast<Stage>(later))));
  }
  return lines;
}

}  // namespace arcstart::command_line
