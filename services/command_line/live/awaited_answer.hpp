// Which SEAM is the answer to a scan: the one that seam_finding's STATUS names. Anybody may send a
// SEAM; what a stranger sends, and two seam_findings that answer differently, is told.
#pragma once

#include <arcstart/seam_t.hpp>
#include <arcstart/service_status_t.hpp>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

namespace arcstart::command_line {

class AwaitedAnswer {
 public:
  // Every SEAM. scan_id: of the scan that is waited for; has_ended: a SEAM that comes before the
  // scan's end is no answer to it.
  void take(const seam_t& seam, std::int64_t scan_id, bool has_ended);

  // Every STATUS of seam_finding; now: us, steady.
  void take(const service_status_t& status, std::int64_t now);

  // Takes what every seam_finding that speaks names, once it is there. Two that name different ones
  // are a failure.
  void decide(std::int64_t scan_id, std::int64_t now);

  const std::optional<seam_t>& seam() const { return answer_; }
  // Two that answer differently, with host and process; empty for none.
  const std::string& failure() const { return failure_; }
  // Another SEAM of the scan that came as well; empty for none.
  std::string stranger() const;
  // What is still missing: one line.
  std::string missing() const;

 private:
  struct Finder {
    std::int64_t heard = 0;  // us, steady
    service_status_t status;
  };
  struct Given {
    std::string mark;
    seam_t seam;
  };
  // So many different ones are kept; the true one comes again every second.
  static constexpr std::size_t kKept = 16;

  std::map<std::int64_t, Finder> finders_;  // by run_id
  std::deque<Given> seams_;                 // after the scan's end, newest last
  std::optional<Given> early_;              // the newest that came before it
  std::optional<seam_t> answer_;
  std::string mark_, who_, failure_;  // of the answer: its mark, and who gave it
};

}  // namespace arcstart::command_line
