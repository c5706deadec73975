// What lcm-logger files hold of one sensor's chain: its scans, and the messages from which they can
// be computed anew.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/event_log.hpp"
#include "common/input_error.hpp"
#include "services/command_line/recordings/event_order.hpp"
#include "services/command_line/recordings/message_facts.hpp"
#include "services/seam_finding/jobs/job_book.hpp"

namespace arcstart::command_line {

// One clear line: which recording, what is wrong with it, what it means.
class RecordingError : public InputError {
 public:
  using InputError::InputError;
};

// Where the replay of a scan begins: with its images where the recording holds them, else with what
// was made of them.
enum class Stage { kImages, kStripes, kProfiles };
std::string stage_name(Stage stage);  // "images"

struct RecordedScan {
  std::int64_t scan_id = 0;
  std::optional<std::int8_t>
      kind;            // scan_t.BACKGROUND or WORKPIECE; nothing where LASER0_SCAN never tells
  bool begun = false;  // LASER0_SCAN was heard while it ran
  bool ended = false;  // LASER0_SCAN says so
  std::int64_t last_seq = -1;                      // of its images, known once ended
  std::array<int, 3> messages{};                   // in the recording, by Stage
  std::array<std::int64_t, 3> newest{-1, -1, -1};  // greatest seq of those
  std::int64_t newest_utime = 0;                   // of those; us

  Stage stage() const;
  bool is_workpiece() const { return kind == scan_t::WORKPIECE; }
};

class Recording {
 public:
  // Reads all headers and all state, of measurements the first bytes. An empty sensor or robot is
  // found from the channels. Throws EventLogError or RecordingError.
  Recording(const std::vector<std::string>& paths, const std::string& sensor,
            const std::string& robot);

  const std::string& name() const { return name_; }  // "scan.lcm", "a.lcm and 2 more"
  const std::string& sensor() const { return sensor_; }
  const std::string& robot() const { return robot_; }
  const std::map<std::int64_t, RecordedScan>& scans() const { return scans_; }
  bool is_damaged() const { return damaged_; }

  // Throws RecordingError where a channel is lacking without which these scans cannot be computed.
  void require_channels() const;

  // The messages from which the wanted scans are computed, in the order of replay. Nothing derived
  // is among them.
  std::vector<RecordedMessage> sources(
      const std::function<bool(const RecordedScan&)>& is_wanted) const;

  const std::string& channel(const RecordedMessage& message) const;
  std::vector<std::uint8_t> read(const RecordedMessage& message) const;

  // The configuration a service stated last, "extraction"; nothing where its STATUS was not
  // recorded.
  std::optional<std::string> configuration(const std::string& service) const;
  // What seam_finding stated of its scans' jobs, of each scan the last.
  seam_finding::JobsOfScans jobs_of_scans() const;

  // Why no answer came for a scan of this recording.
  std::string why_unanswered(const RecordedScan& scan) const;

  void note_undecodable(const std::string& channel, const std::string& why);
  std::int64_t undecodable() const;
  std::vector<std::string> warnings()
      const;  // damage, undecodable messages, losses of the logger: one line each

 private:
  void refuse_former_version() const;
  void choose_instances(const std::string& sensor, const std::string& robot);
  void take_in(std::size_t log, std::size_t entry);
  void take_measurement(ChannelKind kind, RecordedMessage message);
  void take_scan(RecordedMessage message);
  void take_calibration(RecordedMessage message);
  void take_status(const RecordedMessage& message);
  void take_jobs(service_status_t& status);
  void add(ChannelKind kind, const RecordedMessage& message);
  bool has(ChannelKind kind) const { return streams_.contains(kind); }

  struct Undecodable {
    std::int64_t count = 0;
    std::string why;  // of the first
  };

  std::string name_, sensor_, robot_;
  bool damaged_ = false;
  std::vector<EventLog> logs_;
  std::map<ChannelKind, std::map<std::size_t, RecordedStream>> streams_;  // one a file
  std::map<ChannelKind, std::map<std::pair<std::int64_t, std::int64_t>, std::size_t>>
      seen_;  // (run_id, seq): file
  std::map<std::int64_t, RecordedScan> scans_;
  std::map<std::string, std::string> configurations_;                // by service
  std::map<std::string, std::array<std::string, 3>> jobs_of_scans_;  // by scan: name, text, refusal
  std::int64_t newest_pose_ = 0;                                     // us
  std::map<std::string, Undecodable> undecodable_;                   // by channel
  std::vector<std::string> warnings_;
};

}  // namespace arcstart::command_line
