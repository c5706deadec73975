// The whole pipeline on recordings, without sockets: extraction, reconstruction and seam_finding as
// the services run them, on one bus in memory, fed with what was recorded.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "services/command_line/recordings/recording.hpp"

namespace arcstart::command_line {

struct ReplayedSeam {
  std::int8_t kind;  // of the scan: scan_t.BACKGROUND or WORKPIECE
  seam_t seam{};
  std::vector<std::uint8_t> bytes;  // as it was sent
};

// A scan of the recording to which no answer came.
struct UnansweredScan {
  std::int64_t scan_id;
  std::optional<std::int8_t> kind;
  std::string why;
};

struct ReplayOptions {
  std::string cell;        // configuration file; empty: what the recording's STATUS says
  std::string background;  // recording of the background scan; empty: those in the recordings
  std::string sensor;      // empty: the only one in the recordings
  std::string robot;       // empty: the calibration's
  std::function<void(double share)> on_progress = [](double) {};
  // Called with the pipeline's bus before anything is on it, to subscribe to what goes over it.
  std::function<void(Bus& bus, const std::string& sensor)> on_bus = [](Bus&, const std::string&) {};
};

struct ReplayResult {
  std::string sensor, robot;
  std::vector<ReplayedSeam> seams;  // in the order in which they came, each once
  std::vector<UnansweredScan> unanswered;
  std::vector<std::string> warnings;  // one line each
  std::int64_t undecodable = 0;       // recorded messages that were left out

  bool has_workpiece() const;
  // Every workpiece scan found; where there is none, every background stored.
  bool is_good() const;
};

// Sources go onto the bus one by one by event time, each followed by all that it moves. No clock is
// read and no state folder used: the same recordings give the same bytes. Throws EventLogError,
// RecordingError or ConfigurationError, each of one clear line, for what cannot be replayed at all.
ReplayResult replay_recordings(const std::vector<std::string>& paths,
                               const ReplayOptions& options = {});

// For scripts that replay with the live services.
// A regular expression of the channels replay begins with. Throws also where a file is damaged:
// liblcm may crash on it.
std::string source_channels(const std::vector<std::string>& paths, const ReplayOptions& options);
// The sections of cell.yaml that replay would use.
std::string replay_settings(const std::vector<std::string>& paths, const ReplayOptions& options);

}  // namespace arcstart::command_line
