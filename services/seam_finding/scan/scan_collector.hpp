// The profiles of each scan, and when the scan is whole.
#pragma once

#include <arcstart/profile_t.hpp>
#include <arcstart/scan_t.hpp>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "common/bus/sender_watch.hpp"
#include "services/seam_finding/scan/scan_refusal.hpp"

namespace arcstart::seam_finding {

struct CollectedScan {
  scan_t state{};                   // as it ended; of a scan that never did, what is known of it
  std::vector<profile_t> profiles;  // in order of seq, each once
  int profiles_lost = 0;            // between the camera and here
  ScanRefusal refusal;              // why it must not be evaluated, empty where it may be
};

// Takes <SENSOR>_SCAN and <SENSOR>_PROFILE in whatever order the two channels come. What it gives
// depends on each channel's own order alone, but for give_up(). Where two processes send what one
// alone is to send, no scan of theirs is evaluated.
class ScanCollector {
 public:
  void take(const scan_t& state);
  void take(const profile_t& profile);

  // The next scan that is decided: it ended and a profile with its last seq, or a later one of the
  // same run, has come; or it can never end. Each scan is given once.
  std::optional<CollectedScan> next();

  bool is_open() const { return !open_.empty(); }  // a scan has begun that is not decided
  bool awaits_profiles() const;                    // one of them has ended

  // Decides the scans that are open: their chain is dead.
  void give_up(const ScanRefusal& refusal);

  // Was answered in an earlier life.
  void skip(std::int64_t scan_id);

  std::int64_t lost() const { return lost_; }  // profiles in all

 private:
  struct OpenScan {
    std::int64_t scan_id = 0, run_id = 0;
    std::optional<scan_t> state;                 // the first that says it ended, else the newest
    std::map<std::int64_t, profile_t> profiles;  // by seq
    std::size_t points = 0;
    std::int64_t newest_seq = -1;  // of any profile of its run since it is known
    ScanRefusal refusal;

    bool has_ended() const { return state && state->state == scan_t::ENDED; }
    bool is_decided() const;
  };
  OpenScan* find(std::int64_t scan_id);
  OpenScan* find_or_open(std::int64_t scan_id, std::int64_t run_id);  // nullptr: is answered
  void refuse_older_runs(std::int64_t run_id);
  void watch_senders(const scan_t& state);
  void refuse(OpenScan& scan, std::int16_t code);
  void take_end_of_previous(const scan_t& state);
  CollectedScan close(OpenScan& scan);

  std::deque<OpenScan> open_;          // in the order in which they were heard of
  std::deque<std::int64_t> answered_;  // newest last
  std::int64_t newest_run_ = 0;        // of the newest SCAN
  SenderWatch senders_{10};            // of SCAN: 2 s at 5 Hz
  std::int64_t lost_ = 0;
};

}  // namespace arcstart::seam_finding
