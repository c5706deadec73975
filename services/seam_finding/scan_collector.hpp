// The profiles of each scan, and when the scan is whole.
#pragma once

#include <arcstart/profile_t.hpp>
#include <arcstart/scan_t.hpp>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace arcstart {

struct CollectedScan {
  scan_t state{};                   // as it ended; of a scan that was refused what is known of it
  std::vector<profile_t> profiles;  // in order of seq, each once
  int profiles_lost = 0;            // between the camera and here
  std::string refusal;              // why it must not be evaluated, empty where it may be
};

// Takes <SENSOR>_SCAN and <SENSOR>_PROFILE in whatever order the two channels come. What it gives
// depends on each channel's own order alone, but for give_up().
class ScanCollector {
 public:
  void take(const scan_t& state);
  void take(const profile_t& profile);

  // The next scan that is decided: it ended and a profile with its last seq, or of a later scan,
  // has come; or it can never end because sensor_capture was started anew.
  std::optional<CollectedScan> next();

  // The scan that waits for its profiles though it has ended; 0 for none.
  std::int64_t waiting() const;

  // Decides the scan that waits: its chain is dead.
  void give_up(const std::string& reason);

  // Scans answered in an earlier life.
  void skip(std::int64_t scan_id) { decided_ = std::max(decided_, scan_id); }

  std::int64_t lost() const { return lost_; }  // profiles in all, as their scan_index tells

 private:
  struct OpenScan {
    std::optional<scan_t> state;                 // newest
    std::map<std::int64_t, profile_t> profiles;  // by seq
    std::string refusal;
    bool passed = false;  // a profile of a later scan has come
  };
  bool is_decided(const OpenScan& scan) const;

  std::map<std::int64_t, OpenScan> open_;  // by scan_id
  std::int64_t decided_ = 0;               // newest scan_id given out
  std::int64_t lost_ = 0;
};

}  // namespace arcstart
