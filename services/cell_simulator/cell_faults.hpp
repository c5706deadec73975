// Faults of the simulated devices, at a set time in a set scan, so that a test can show what the
// pipeline does then.
#pragma once

#include <atomic>
#include <cstdint>

namespace arcstart::cell_simulator {

struct CellFaultSettings {
  int scan = 0;  // the scan since start that has the faults, 1 for the first; 0: none has
  double after_scan_begin = 1;  // begin of the faults; s
  int lose_every =
      0;  // of the frames from then to the scan's end each so many-th is lost; 0: none is
  double camera_away = 0;       // the camera leaves the network for so long; s
  double robot_silent = 0;      // positions are lost for so long; s
  double robot_clock_back = 0;  // the controller's clock goes back by so much, for good; s
};

// Times in us, UTC. Told of scans by one thread, asked by several.
class CellFaults {
 public:
  explicit CellFaults(const CellFaultSettings& settings) : settings_(settings) {}

  void scan_begins(std::int64_t begin) {
    if (++scans_ != settings_.scan) return;
    until_ = kNever;
    from_ = begin + us(settings_.after_scan_begin);
  }
  void scan_ends(std::int64_t end) {
    if (scans_ == settings_.scan && until_ == kNever) until_ = end;
  }

  bool frame_lost(std::int64_t slot, std::int64_t frame_period) const {
    const std::int64_t from = from_;
    if (settings_.lose_every <= 0 || slot < from || slot > until_) return false;
    return ((slot - from) / frame_period + 1) % settings_.lose_every == 0;
  }
  bool camera_away(std::int64_t now) const { return within(now, settings_.camera_away); }
  bool robot_silent(std::int64_t instant) const { return within(instant, settings_.robot_silent); }
  std::int64_t robot_clock_back_us(std::int64_t instant) const {
    return instant >= from_ ? us(settings_.robot_clock_back) : 0;
  }

 private:
  static constexpr std::int64_t kNever = INT64_MAX;
  static std::int64_t us(double seconds) { return static_cast<std::int64_t>(seconds * 1e6); }
  bool within(std::int64_t time, double duration) const {
    const std::int64_t from = from_;
    return time >= from && time - from < us(duration);
  }

  CellFaultSettings settings_;
  int scans_ = 0;
  std::atomic<std::int64_t> from_{kNever}, until_{kNever};
};

}  // namespace arcstart::cell_simulator
