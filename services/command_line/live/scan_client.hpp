// The operator's side of a scan: asks for it, follows it, waits for its answer. Sends no packet but
// LASER0_SCAN_COMMAND.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/service.hpp"
#include "services/command_line/live/awaited_answer.hpp"

namespace arcstart::command_line {

// The services that every scan needs.
const std::vector<ServiceDescription>& chain_services();

struct ScanRequest {
  std::int8_t kind = scan_t::WORKPIECE;  // or BACKGROUND
  double longest_duration_s = 30;
  // Longest wait for an answer: to the start, and for the seam after the scan's end.
  double timeout_s = 10;

  // Come back in the answer.
  std::int64_t number = 0;    // 0 for none
  std::string job{}, part{};  // empty for none
};

class ScanClient {
 public:
  // The bus must outlive the client.
  ScanClient(Bus& bus, const Instance& instance, const ScanRequest& request);

  // Sends what is due and gives up what has waited too long; at least 10 times a second. steady: us
  // on the steady clock; utime: us, UTC.
  void tick(std::int64_t steady, std::int64_t utime);

  // Ends the scan early, as Ctrl-C does: its answer is waited for all the same.
  void stop();

  bool is_done() const { return phase_ == Phase::kDone; }
  const std::optional<seam_t>& seam() const { return answer_.seam(); }  // nothing where none came
  // Another answer than that, which came as well: one line, empty for none.
  std::string stranger() const { return answer_.stranger(); }
  const std::string& failure() const { return failure_; }  // why none came: one line
  std::string progress() const;                            // what goes on now: one line
  std::int64_t command_id() const { return start_id_; }

 private:
  enum class Phase { kStarting, kScanning, kWaiting, kDone };
  struct Heard {
    std::int64_t steady = 0;
    service_status_t status;
  };

  void take_scan(const scan_t& state);
  void take_seam(const seam_t& seam);
  void send(std::int8_t action, std::int64_t command_id, std::int64_t utime);
  void enter(Phase phase);
  void fail(const std::string& why);
  bool has_ended() const;
  void answer_if_named();
  std::string missing_services() const;

  Bus& bus_;
  Instance instance_;
  ScanRequest request_;
  std::int64_t start_id_, stop_id_;
  Phase phase_ = Phase::kStarting;
  bool stopping_ = false;
  std::int64_t now_ = 0, phase_began_ = 0, next_send_ = 0, scan_heard_ = 0;  // us, steady
  std::int64_t scan_id_ = 0, run_id_ = 0;                                    // of our scan
  std::optional<scan_t> state_;
  AwaitedAnswer answer_;
  std::map<std::string, Heard> services_;  // by service
  std::string failure_;
};

}  // namespace arcstart::command_line
