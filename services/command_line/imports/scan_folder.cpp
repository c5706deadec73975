#include "services/command_line/imports/scan_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "common/time.hpp"
#include "services/command_line/imports/import_error.hpp"
#include "services/reconstruction/reconstruction_settings.hpp"

namespace arcstart::command_line {
namespace {

void require_cover(const ScanFolder& scan, double time_offset) {
  const std::int64_t offset = seconds_to_us(time_offset);
  for (const StampedFrame& frame : scan.frames) {
    const std::int64_t wanted = frame.utime + offset;
    const std::int64_t early = scan.poses.front().utime - wanted,
                       late = wanted - scan.poses.back().utime;
    if (early <= 0 && late <= 0) continue;
    throw ImportError(
        fmt::format("{}: the image of index {} needs a pose at {} (its time and the calibration's "
                    "time offset, {:.2f} ms), {:.1f} ms {}: give poses that cover all images, of "
                    "the same clock",
                    (std::filesystem::path(scan.path) / "poses.csv").string(), frame.index, wanted,
                    1e3 * time_offset, static_cast<double>(std::max(early, late)) / 1e3,
                    early > 0 ? "before the first" : "after the last"));
  }
}

// Reconstruction gives no points there.
void note_gaps(const ScanFolder& scan, double time_offset, std::vector<std::string>& notes) {
  const double largest_ms = reconstruction::ReconstructionSettings{}.largest_gap_ms;
  const std::int64_t offset = seconds_to_us(time_offset);
  const auto in_gap = [&](const StampedFrame& frame) {
    const auto after = std::lower_bound(
        scan.poses.begin(), scan.poses.end(), frame.utime + offset,
        [](const StampedPose& pose, std::int64_t utime) { return pose.utime < utime; });
    return after != scan.poses.begin() && after != scan.poses.end() &&
           static_cast<double>(after->utime - std::prev(after)->utime) > 1e3 * largest_ms;
  };
  const auto count = std::count_if(scan.frames.begin(), scan.frames.end(), in_gap);
  if (count > 0)
    notes.push_back(fmt::format(
        "{}: {} of {} images lie between poses more than {:g} ms apart and give no points",
        (std::filesystem::path(scan.path) / "poses.csv").string(), count, scan.frames.size(),
        largest_ms));
}

}  // namespace

std::int64_t ScanFolder::first_utime() const {
  return std::min(frames.front().utime, poses.front().utime);
}

std::int64_t ScanFolder::last_utime() const {
  return std::max(frames.back().utime, poses.back().utime);
}

void ScanFolder::shift(std::int64_t by) {
  for (StampedFrame& frame : frames) frame.utime += by;
  for (StampedPose& pose : poses) pose.utime += by;
}

ScanFolder read_scan_folder(const std::string& path, const PoseConvention& convention,
                            double time_offset, std::vector<std::string>& notes) {
  if (!std::filesystem::is_directory(path))
    throw ImportError(path + ": is no folder: give one with frames/, frames.csv and poses.csv");
  ScanFolder scan;
  scan.path = path;
  scan.frames = read_frame_folder(path, notes);
  scan.poses =
      read_pose_file((std::filesystem::path(path) / "poses.csv").string(), convention, notes);
  require_cover(scan, time_offset);
  note_gaps(scan, time_offset, notes);
  return scan;
}

}  // namespace arcstart::command_line
