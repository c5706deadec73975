// Scans: when one begins, which frames belong to it, when and why it ends, and when its last frame
// is known. A pure state machine: every time is given, nothing is sent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "services/sensor_capture/scan/standstill.hpp"

namespace arcstart::sensor_capture {

// Commands are repeated for some seconds; so many senders at a time there are not.
inline constexpr std::size_t kCommandsRemembered = 256;

// What whoever asks for a scan says of it: copied on, never looked at.
struct ScanPurpose {
  std::int64_t request = 0;
  std::string job, part;
};

// Values as in scan_t.
enum class EndCause : std::int8_t { kNone, kStop, kLongestDuration, kStandstill, kCameraLost };

struct ScanOrder {
  std::int64_t command_id = 0;
  bool start = true;  // else stop
  std::int8_t kind = 0;
  double longest_duration_s = 0;
  ScanPurpose purpose = {};
};

// A frame as far as scans are concerned. Exposure from begin to end; us, UTC.
struct ExposedFrame {
  std::int64_t seq = 0;
  std::int64_t begin_utime = 0, end_utime = 0;
  bool lit = false;  // laser on and settings in force throughout the exposure
  bool complete = true;
};

struct Membership {
  std::int64_t scan_id = 0;      // 0: belongs to no scan
  std::int32_t scan_index = -1;  // 0, 1, 2 ... in the scan
};

struct Scan {
  std::int64_t scan_id = 0;  // its begin; us, UTC
  std::int8_t kind = 0;
  std::int64_t end_utime = 0;  // 0 while it runs
  std::int64_t first_seq = -1, last_seq = -1;
  std::int32_t images = 0;  // members, incomplete ones included
  std::int32_t lost = 0;    // incomplete, or missing between members
  EndCause end_cause = EndCause::kNone;
  std::int64_t start_command_id = 0;
  ScanPurpose purpose;
};

struct ScanState {
  enum class Phase { kIdle, kScanning, kEnded };
  Phase phase = Phase::kIdle;
  std::int64_t command_id = 0;  // that changed the phase last
  Scan scan;                    // running, or the last one
  Scan previous;
  std::int64_t refused_command_id = 0;
  std::string refusal;
};

struct ScanOwnerSettings {
  double longest_scan_s = 120;  // whatever the order says
  bool end_when_still = false;
  StandstillSettings standstill;
};

class ScanOwner {
 public:
  explicit ScanOwner(const ScanOwnerSettings& settings);

  // The order counts the first time its id is seen; repeated it changes nothing.
  // camera_trouble: why there are no frames now, empty where they come: then a start is refused.
  void order(const ScanOrder& order, std::int64_t now, const std::string& camera_trouble);

  // Frames in order. Members are exposed wholly within the scan, with the laser on.
  Membership frame(const ExposedFrame& frame);

  // A valid position of the tool.
  void position(std::int64_t utime, const Eigen::Vector3d& position,
                const Eigen::Quaterniond& rotation);

  void camera_lost(std::int64_t now);
  void tick(std::int64_t now);

  // Between the begins of two exposures, us: tells when a scan's last frame must have come already.
  // 0 where it is not known.
  void set_shortest_period(std::int64_t period_us) { shortest_period_us_ = period_us; }
  // How long a frame may take from its exposure to frame(), us.
  void set_longest_delay(std::int64_t delay_us) { longest_delay_us_ = delay_us; }

  const ScanState& state() const { return state_; }
  // Rises with every change of the state but the running counts of frames.
  std::int64_t revision() const { return revision_; }
  // A scan runs, or has ended and waits for its last frame.
  bool scanning() const { return state_.phase == ScanState::Phase::kScanning; }
  // The laser is wanted: a scan runs and has not ended.
  bool laser_wanted() const { return scanning() && !ending_; }

 private:
  bool is_known(std::int64_t command_id);
  void refuse(std::int64_t command_id, std::string why);
  void begin(const ScanOrder& order, std::int64_t now);
  // before: the frame before the newest, where that has just come.
  void end(std::int64_t utime, EndCause cause, const std::optional<ExposedFrame>& before = {});
  void finish_if_complete(const std::optional<ExposedFrame>& before);
  void count_lost_at_end(const ExposedFrame& before, const ExposedFrame& after);
  void finish();

  ScanOwnerSettings settings_;
  Standstill standstill_;
  ScanState state_;
  std::int64_t revision_ = 0;
  std::deque<std::int64_t> known_commands_;

  std::int64_t deadline_ = 0;  // of the running scan
  bool ending_ = false;        // its end is known, its last frame is not
  std::int64_t end_utime_ = 0;
  EndCause end_cause_ = EndCause::kNone;
  std::int64_t stop_command_id_ = 0;  // that ended it, 0 for none
  std::int64_t last_member_end_ = 0;
  std::optional<ExposedFrame> newest_;
  std::int64_t shortest_period_us_ = 0;
  std::int64_t longest_delay_us_ = 2'000'000;
};

}  // namespace arcstart::sensor_capture
