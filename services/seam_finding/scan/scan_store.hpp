// What must outlive the process: background scans and answers, in the state folder.
#pragma once

#include <arcstart/seam_t.hpp>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/service.hpp"
#include "services/seam_finding/scan/scan_collector.hpp"

namespace arcstart::seam_finding {

// Disk full, folder gone: one line with what to do.
class ScanStoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct StoredSeam {
  std::int64_t scan_id;
  std::vector<std::uint8_t> bytes;  // as it was sent
};

// <state folder>/<sensor>-<robot>/background-<count>-<scan_id>.lcm, that scan's own little LCM log;
// seam-<count>-<scan_id>.lcm, one event. They are ordered by when they were written, whatever the
// clock said. A file is whole or not there: written beside and renamed. With an
// empty state folder nothing touches the disk.
class ScanStore {
 public:
  ScanStore(const Instance& instance, int backgrounds_kept, int results_kept);

  // Both throw ScanStoreError where it cannot be kept.
  void keep_background(const CollectedScan& scan);
  void keep_seam(std::int64_t scan_id, const std::vector<std::uint8_t>& bytes);

  // All that are kept and can be read, oldest first; what is damaged is told in `warnings` and left
  // out.
  std::vector<CollectedScan> backgrounds(std::vector<std::string>& warnings) const;
  std::optional<StoredSeam> newest_seam(std::vector<std::string>& warnings) const;
  std::vector<std::int64_t> answered_scans() const;  // by the names of the files, oldest first

 private:
  std::vector<std::string> files(const std::string& prefix) const;  // oldest first
  std::string next_name(const std::string& prefix, std::int64_t scan_id) const;
  struct Event {
    std::int64_t timestamp;
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };
  void write(const std::string& name, const std::vector<Event>& events) const;
  void prune(const std::string& prefix, int kept) const;

  std::string folder_, sensor_;
  int backgrounds_kept_, results_kept_;
};

}  // namespace arcstart::seam_finding
