#include "services/calibration/calibration_app.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include "common/bus/calibration_message.hpp"
#include "services/calibration/files/calibration_file.hpp"

namespace arcstart::calibration {
namespace {

constexpr std::int64_t kPeriod = 1'000'000;  // us

// Also where the host's clock was set back.
bool due(std::int64_t now, std::int64_t last) { return now - last >= kPeriod || now < last; }

}  // namespace

CalibrationApp::CalibrationApp(Bus& bus, const CalibrationSettings& settings,
                               const Instance& instance, std::int64_t run_id)
    : bus_(bus), settings_(settings), instance_(instance) {
  if (settings.plate.empty()) return;
  try {
    desk_ = std::make_unique<CaptureSession>(bus, settings, instance, run_id);
  } catch (const CalibrationSetError& error) {
    throw ConfigurationError(error.what());
  }
}

void CalibrationApp::tick(std::int64_t now_utime) {
  if (desk_) desk_->tick(now_utime);
  if (due(now_utime, last_look_)) {
    last_look_ = now_utime;
    look_at_file();
  }
  if (!message_ || !due(now_utime, last_sent_)) return;
  last_sent_ = now_utime;
  bus_.publish(instance_.sensor_channel("CALIBRATION"), *message_);
}

// One that failed comes into force where a person answers for it alone.
void CalibrationApp::require_verdict(const Calibration& calibration) const {
  const CalibrationVerdict& verdict = calibration.verdict;
  if (verdict.passed == CalibrationVerdict::Passed::kFailed && verdict.forced_by.empty())
    throw CalibrationFileError(
        settings_.file + ": calibration " + calibration.id +
        " failed its limits and is not put in force: make it anew; arcstart calibrate --force NAME "
        "makes one that is used all the same");
}

// A bad file is read again at every look: it may have been half written, within one tick of the
// file system's clock.
void CalibrationApp::look_at_file() try {
  std::error_code missing;
  FileStamp stamp;
  stamp.changed = std::filesystem::last_write_time(settings_.file, missing);
  if (!missing) stamp.size = std::filesystem::file_size(settings_.file, missing);
  if (!missing && file_error_.empty() && taken_ == stamp) return;
  const Calibration calibration = read_calibration_file(settings_.file);
  if (const auto error = instance_error(calibration, instance_.sensor, instance_.robot);
      !error.empty())
    throw CalibrationFileError(settings_.file + ": " + error + ": give the file made for it");
  require_verdict(calibration);
  file_error_.clear();
  taken_ = stamp;
  if (message_ && message_->id == calibration.id) return;
  spdlog::info(fmt::format("{}: calibration {}, made by: {}{}", settings_.file, calibration.id,
                           calibration.origin, message_ ? "; it replaces " + message_->id : ""));
  message_ = to_message(calibration);
  distrust_ = distrust(calibration.verdict);
  if (!distrust_.empty()) {
    distrust_ = fmt::format("calibration {}: {}; no seam measured with it is usable",
                            calibration.id, distrust_);
    spdlog::warn(distrust_);
  }
  last_sent_ = 0;
} catch (const CalibrationFileError& error) {
  file_error_ = error.what();
}

Health CalibrationApp::health() const {
  Health health;
  if (file_error_.empty()) {
    if (message_ && !distrust_.empty()) health.state = service_status_t::DEGRADED;
    health.last_error = distrust_;
    return health;
  }
  health.state = message_ ? service_status_t::DEGRADED : service_status_t::FAULT;
  health.last_error =
      message_ ? file_error_ + "; calibration " + message_->id + " stays in force" : file_error_;
  if (!distrust_.empty()) health.last_error += "; " + distrust_;
  return health;
}

}  // namespace arcstart::calibration
