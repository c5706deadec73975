// Stripes and positions out of recordings, for what judges a calibration by sweeps.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/options.hpp"
#include "services/calibration/sweeps/sweep_profiles.hpp"

namespace arcstart::command_line {

struct RecordedSweeps {
  std::string name, sensor, robot;
  calibration::SweepData record;
  std::optional<Calibration> calibration;  // the last of the recording that could be used
  std::vector<std::string> warnings;       // one line each
};

// Images go through extraction with the settings that the recording's STATUS says, stripes are
// taken as they are. An empty sensor or robot is found from the channels. Throws EventLogError or
// RecordingError, each of one clear line, where stripes or positions are lacking.
RecordedSweeps read_sweeps(
    const std::vector<std::string>& paths, const std::string& sensor, const std::string& robot,
    const std::function<void(double share)>& on_progress = [](double) {});

// What both commands that judge sweeps ask for.
struct SweepOptions {
  std::vector<std::string> paths;
  std::string calibration, sensor, robot;  // a calibration file; empty: the recording's

  void add_to(Command& command);
};

// The recording and the calibration to judge it by. Throws as read_sweeps() does,
// CalibrationFileError, and RecordingError where there is no calibration or it is another sensor's.
struct JudgedSweeps {
  RecordedSweeps sweeps;
  Calibration calibration;
};
JudgedSweeps read_judged_sweeps(const SweepOptions& options, const std::string& command);

}  // namespace arcstart::command_line
