#pragma once

#include <arcstart/calibration_t.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/calibration.hpp"
#include "common/service.hpp"
#include "services/calibration/calibration_settings.hpp"
#include "services/calibration/capture/capture_session.hpp"

namespace arcstart::calibration {

// Gives <SENSOR>_CALIBRATION once a second, byte for byte the same, and at once when its file has
// changed. Without a usable file it waits for one. Where a plate is configured, a calibration can
// be made here, too (capture/capture_session.hpp).
class CalibrationApp : public App {
 public:
  // The bus outlives the app. Throws ConfigurationError where plate or folder cannot be used.
  CalibrationApp(Bus& bus, const CalibrationSettings& settings, const Instance& instance,
                 std::int64_t run_id);

  void tick(std::int64_t now_utime) override;
  Health health() const override;

 private:
  // What tells that a file is another, without reading it.
  struct FileStamp {
    std::filesystem::file_time_type changed{};
    std::uintmax_t size = 0;
    bool operator==(const FileStamp&) const = default;
  };

  void look_at_file();
  void require_verdict(const Calibration& calibration) const;

  Bus& bus_;
  CalibrationSettings settings_;
  Instance instance_;
  std::int64_t last_look_ = 0, last_sent_ = 0;  // us, UTC
  std::optional<FileStamp> taken_;              // of the file that was read last and was good
  std::optional<calibration_t> message_;        // the calibration in force
  std::string distrust_;                        // why seams are not usable with it
  std::string file_error_;                      // why the file cannot be used now
  std::unique_ptr<CaptureSession> desk_;        // none where no plate is configured
};

// The whole main of arcstart-calibration.
int run(int argc, char** argv);

}  // namespace arcstart::calibration
