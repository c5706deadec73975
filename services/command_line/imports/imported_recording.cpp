#include "services/command_line/imports/imported_recording.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <arcstart/service_status_t.hpp>
#include <cctype>
#include <filesystem>
#include <limits>

#include "common/bus/calibration_message.hpp"
#include "services/command_line/imports/grey_images.hpp"
#include "services/command_line/imports/import_error.hpp"
#include "services/command_line/imports/imported_messages.hpp"
#include "services/command_line/imports/unfinished_log.hpp"
#include "services/extraction/extraction_settings.hpp"
#include "services/reconstruction/reconstruction_settings.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::command_line {
namespace {

namespace fs = std::filesystem;

// As the running cell repeats its states.
constexpr std::int64_t kCalibrationPeriod = 1'000'000, kScanPeriod = 200'000;  // us
constexpr std::int64_t kPause = 1'000'000;  // between a background that was moved and the work; us

class RecordingWriter {
 public:
  RecordingWriter(const std::string& path, const ImportedScans& scans,
                  const std::function<void(double)>& on_progress)
      : scans_(scans),
        on_progress_(on_progress),
        images_(scans.calibration.sensor_model, scans.channel),
        log_(path) {}

  void write(std::vector<std::string>& notes) {
    const ScanFolder& first = scans_.background ? *scans_.background : scans_.work;
    const std::int64_t run_id = first.first_utime() - kPause;
    ImportedScan background,
        work{&scans_.work, scan_t::WORKPIECE, run_id, 0, scans_.job, scans_.part};
    write_status<extraction::ExtractionSettings>("extraction", run_id);
    write_status<reconstruction::ReconstructionSettings>("reconstruction", run_id);
    write_status<seam_finding::SeamFindingSettings>("seam_finding", run_id);
    if (scans_.background) {
      background = {&*scans_.background, scan_t::BACKGROUND, run_id, 0, "", ""};
      work.first_seq = static_cast<std::int64_t>(scans_.background->frames.size());
      images_in_all_ += scans_.background->frames.size();
    }
    images_in_all_ += scans_.work.frames.size();
    if (scans_.background) write_scan(background, nullptr);
    write_scan(work, scans_.background ? &background : nullptr);
    images_.tell(notes);
    log_.finish();
  }

 private:
  std::string channel(const std::string& name) const {
    return scans_.calibration.sensor + "_" + name;
  }

  // As the service of this name would state it, had it run.
  template <class Settings>
  void write_status(const std::string& service, std::int64_t utime) {
    service_status_t message{};
    message.utime = message.run_id = utime;
    message.host = "import";
    message.service = service;
    message.state = service_status_t::RUNNING;
    message.configuration = write_settings(service, scans_.settings.read<Settings>(service));
    message.configuration_hash = fingerprint(message.configuration);
    std::string name = service;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    log_.write(utime, channel(name + "_STATUS"), message);
  }

  // All that is due before this time: state first, then positions.
  void write_until(const ImportedScan& scan, const ImportedScan* previous, std::int64_t utime) {
    const auto& poses = scan.folder->poses;
    for (;;) {
      const std::int64_t next_pose = next_pose_ < poses.size()
                                         ? poses[next_pose_].utime
                                         : std::numeric_limits<std::int64_t>::max();
      const std::int64_t next = std::min({next_calibration_, next_scan_, next_pose});
      if (next > utime) return;
      if (next == next_calibration_) {
        log_.write(next, channel("CALIBRATION"), to_message(scans_.calibration));
        next_calibration_ += kCalibrationPeriod;
      } else if (next == next_pose) {
        log_.write(next, scans_.calibration.robot + "_POSE",
                   pose_message(poses[next_pose_++], scan.run_id, pose_seq_++));
      } else {
        log_.write(next, channel("SCAN"), scan_message(scan, previous, next));
        // Its end is told when it comes, whatever the period.
        const std::int64_t end = scan.end_utime();
        next_scan_ += kScanPeriod;
        if (next < end) next_scan_ = std::min(next_scan_, end);
      }
    }
  }

  void write_scan(const ImportedScan& scan, const ImportedScan* previous) {
    next_pose_ = 0;
    next_calibration_ = scan.folder->first_utime();
    next_scan_ = scan.begin_utime();
    for (std::size_t place = 0; place < scan.folder->frames.size(); ++place) {
      const StampedFrame& frame = scan.folder->frames[place];
      write_until(scan, previous, frame.utime);
      log_.write(frame.utime, channel("IMAGE"),
                 image_message(scan, place, images_.read(frame.image)));
      on_progress_(static_cast<double>(++images_written_) / static_cast<double>(images_in_all_));
    }
    write_until(scan, previous, std::max(scan.end_utime(), scan.folder->last_utime()));
  }

  const ImportedScans& scans_;
  const std::function<void(double)>& on_progress_;
  GreyImages images_;
  UnfinishedLog log_;
  std::size_t images_in_all_ = 0, images_written_ = 0;
  std::size_t next_pose_ = 0;                          // of the scan
  std::int64_t next_calibration_ = 0, next_scan_ = 0;  // us
  std::int64_t pose_seq_ = 0;
};

}  // namespace

void put_background_first(ImportedScans& scans, std::vector<std::string>& notes) {
  if (!scans.background) return;
  // A scan's end comes after its last image.
  const std::int64_t last = scans.background->last_utime() + kPause;
  const std::int64_t first = scans.work.first_utime();
  if (last <= first) return;
  scans.background->shift(first - last);
  notes.push_back(fmt::format(
      "{}: overlaps in time with {} or is later: its images and poses are taken to be "
      "{:.3f} s earlier",
      scans.background->path, scans.work.path, static_cast<double>(last - first) * 1e-6));
}

void write_recording(const std::string& path, const ImportedScans& scans,
                     const std::function<void(double share)>& on_progress,
                     std::vector<std::string>& notes) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored)))
    throw ImportError(path + ": exists already: remove it or choose another name");
  RecordingWriter(path, scans, on_progress).write(notes);
}

}  // namespace arcstart::command_line
