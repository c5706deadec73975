#include "services/command_line/live/scan_client.hpp"

#include <fmt/format.h>

#include <random>
#include <vector>

#include "common/time.hpp"
#include "services/command_line/recordings/message_facts.hpp"

namespace arcstart::command_line {
namespace {

constexpr std::int64_t kSendEvery = 200'000;  // us: 5 Hz
constexpr std::int64_t kSilence = 3'000'000;  // us: STATUS comes at 1 Hz
constexpr std::int64_t kLateStart =
    1'000'000;  // us: LASER0_SCAN comes at 5 Hz and at once on a change

// Never 0, and no two alike, whichever host and process they come from.
std::int64_t unique_command_id() {
  std::random_device device;
  const auto bits = static_cast<std::uint64_t>(device()) << 32 | device();
  return static_cast<std::int64_t>(bits >> 2 | 1);
}

}  // namespace

const std::vector<ServiceDescription>& chain_services() {
  static const std::vector<ServiceDescription> services = {
      ServiceDescription{"sensor_capture", "", false},
      ServiceDescription{"robot_pose", "", true},
      ServiceDescription{"calibration", "", false},
      ServiceDescription{"extraction", "", false},
      ServiceDescription{"reconstruction", "", false},
      ServiceDescription{"seam_finding", "", false}};
  return services;
}

ScanClient::ScanClient(Bus& bus, const Instance& instance, const ScanRequest& request)
    : bus_(bus),
      instance_(instance),
      request_(request),
      start_id_(unique_command_id()),
      stop_id_(unique_command_id()) {
  bus.subscribe<scan_t>(instance.sensor_channel("SCAN"), Queue::measurements(),
                        [this](const scan_t& state) { take_scan(state); });
  bus.subscribe<seam_t>(instance.sensor_channel("SEAM"), Queue::measurements(),
                        [this](const seam_t& seam) { take_seam(seam); });
  for (const auto& service : chain_services())
    bus.subscribe<service_status_t>(status_channel(instance, service), Queue::measurements(),
                                    [this, name = service.name](const service_status_t& status) {
                                      services_[name] = {now_, status};
                                      if (name == "seam_finding") answer_.take(status, now_);
                                    });
}

void ScanClient::tick(std::int64_t steady, std::int64_t utime) {
  if (now_ == 0) phase_began_ = scan_heard_ = steady;
  now_ = steady;
  answer_if_named();
  const auto waited = [this](std::int64_t since) {
    return now_ - since > seconds_to_us(request_.timeout_s);
  };
  switch (phase_) {
    case Phase::kStarting:
      // No stop is sent here: it would end somebody else's scan where ours never began.
      if (stopping_ && now_ - phase_began_ > kLateStart)
        return fail("stopped before the scan began");
      if (!stopping_ && now_ >= next_send_) send(scan_command_t::START, start_id_, utime);
      if (waited(phase_began_))
        fail(fmt::format("nobody begins the scan: {} {}; {}", instance_.sensor_channel("SCAN"),
                         state_ ? "does not show the command" : "is not heard",
                         missing_services()));
      return;
    case Phase::kScanning:
      if (stopping_ && now_ >= next_send_) send(scan_command_t::STOP, stop_id_, utime);
      if (waited(scan_heard_))
        return fail(fmt::format("{} fell silent in the scan; {}", instance_.sensor_channel("SCAN"),
                                missing_services()));
      if (waited(phase_began_ + (stopping_ ? 0 : seconds_to_us(request_.longest_duration_s))))
        fail(fmt::format("the scan does not end; {}", missing_services()));
      return;
    case Phase::kWaiting:
      if (waited(phase_began_))
        fail(fmt::format("no {} came for the scan within {} s; {}",
                         instance_.sensor_channel("SEAM"), request_.timeout_s,
                         answer_.missing().empty() ? missing_services() : answer_.missing()));
      return;
    case Phase::kDone:
      return;
  }
}

void ScanClient::stop() {
  if (stopping_ || phase_ == Phase::kDone) return;
  stopping_ = true;
  next_send_ = 0;
  if (phase_ != Phase::kWaiting) phase_began_ = now_;
}

void ScanClient::take_scan(const scan_t& state) {
  state_ = state;
  scan_heard_ = now_;
  if (phase_ == Phase::kStarting) {
    if (state.refused_command_id == start_id_) return fail("refused: " + printable(state.refusal));
    if (state.command_id != start_id_ || state.state == scan_t::IDLE) return;
    scan_id_ = state.scan_id;
    run_id_ = state.run_id;
    enter(Phase::kScanning);
  }
  if (phase_ == Phase::kScanning) {
    // A restarted sensor_capture never resumes a scan; seam_finding says so in its answer.
    const bool ended =
        state.run_id != run_id_ || state.scan_id != scan_id_ || state.state != scan_t::SCANNING;
    if (ended) enter(Phase::kWaiting);
  }
}

void ScanClient::take_seam(const seam_t& seam) { answer_.take(seam, scan_id_, has_ended()); }

// A scan of which nothing is heard any more is answered, too.
bool ScanClient::has_ended() const {
  return phase_ == Phase::kWaiting || (phase_ == Phase::kScanning && now_ - scan_heard_ > kSilence);
}

void ScanClient::answer_if_named() {
  if (!has_ended()) return;
  answer_.decide(scan_id_, now_);
  if (!answer_.failure().empty()) return fail(answer_.failure());
  if (answer_.seam()) enter(Phase::kDone);
}

void ScanClient::send(std::int8_t action, std::int64_t command_id, std::int64_t utime) {
  scan_command_t command{};
  command.utime = utime;
  command.command_id = command_id;
  command.action = action;
  command.kind = request_.kind;
  command.longest_duration = request_.longest_duration_s;
  command.request = request_.number;
  command.job = request_.job;
  command.part = request_.part;
  bus_.publish(instance_.sensor_channel("SCAN_COMMAND"), command);
  next_send_ = now_ + kSendEvery;
}

void ScanClient::enter(Phase phase) {
  phase_ = phase;
  phase_began_ = now_;
  next_send_ = 0;
}

void ScanClient::fail(const std::string& why) {
  failure_ = why;
  enter(Phase::kDone);
}

std::string ScanClient::progress() const {
  if (phase_ == Phase::kStarting)
    return stopping_ ? "stopping" : "waiting for sensor_capture to begin the scan";
  if (phase_ == Phase::kWaiting) return "scan ended, waiting for the seam";
  if (phase_ == Phase::kDone || !state_) return "";
  return fmt::format("{}: {} images, {} lost, {:.1f} s", stopping_ ? "stopping" : "scanning",
                     state_->images, state_->lost,
                     static_cast<double>(state_->utime - state_->begin_utime) * 1e-6);
}

std::string ScanClient::missing_services() const {
  std::vector<std::string> missing, faults;
  for (const auto& service : chain_services()) {
    const auto heard = services_.find(service.name);
    if (heard == services_.end() || now_ - heard->second.steady > kSilence) {
      missing.push_back(service.name);
      continue;
    }
    const service_status_t& status = heard->second.status;
    const bool is_ill =
        status.state == service_status_t::FAULT || status.state == service_status_t::STOPPING;
    if (is_ill || (status.state == service_status_t::DEGRADED && !status.last_error.empty()))
      faults.push_back(service.name + " says: " + printable(status.last_error));
  }
  if (missing.size() == chain_services().size())
    return "no service of the chain is heard: are they running, for this sensor and robot, on this "
           "group and port?";
  std::string line = missing.empty()
                         ? "all services are heard"
                         : fmt::format("not heard (not running?): {}", fmt::join(missing, ", "));
  for (const auto& fault : faults) line += "; " + fault;
  return line;
}

}  // namespace arcstart::command_line
