#include "services/sensor_capture/clock_probes.hpp"

#include <fmt/core.h>

#include <cmath>

#include "common/time.hpp"

namespace arcstart::sensor_capture {
namespace {

constexpr const char* kChannel = "CLOCK_PROBE";
constexpr std::int64_t kPeriod = 100'000;  // us: some of a second's exchanges meet idle processes
// us: surely apart by 0.1 mm, or perhaps by 1 mm, at 50 to 100 mm/s.
constexpr double kSurely = 1'000, kPerhaps = 20'000;

}  // namespace

ClockProbes::ClockProbes(Bus& bus, const std::string& robot, std::int64_t run_id) : bus_(bus) {
  question_.robot = robot;
  question_.asker_run_id = run_id;
  bus_.subscribe<clock_probe_t>(kChannel, Queue::measurements(),
                                [this](const clock_probe_t& message) { take(message); });
}

void ClockProbes::tick() {
  const std::int64_t now = steady_now();
  if (now < next_) return;
  next_ = now + kPeriod;
  ++question_.seq;
  answered_ = false;
  question_.asked_utime = utime_now();
  bus_.publish(kChannel, question_);
}

void ClockProbes::take(const clock_probe_t& message) {
  const std::int64_t heard = utime_now();
  if (message.answerer_run_id == 0 || answered_ || message.robot != question_.robot ||
      message.asker_run_id != question_.asker_run_id || message.seq != question_.seq ||
      message.asked_utime != question_.asked_utime)
    return;
  answered_ = true;
  if (message.answerer_run_id != answerer_run_id_) comparison_.restart();
  answerer_run_id_ = message.answerer_run_id;
  comparison_.take({message.asked_utime, heard, message.heard_utime, message.answered_utime},
                   steady_now());
}

void ClockProbes::fill_in(scan_t& state) {
  auto now = comparison_.at(steady_now());
  if (state.scan_id != scan_id_) in_scan_ = now;
  scan_id_ = state.scan_id;
  if (state.state == scan_t::SCANNING && now && in_scan_) in_scan_->widen(*now);
  if (state.state == scan_t::SCANNING && !in_scan_) in_scan_ = now;
  const auto& told = state.state == scan_t::IDLE ? now : in_scan_;
  state.clock_difference = told ? told->difference() * 1e-6 : 0;
  state.clock_bound = told ? told->bound() * 1e-6 : -1;
}

std::string ClockProbes::trouble() const {
  const auto now = comparison_.at(steady_now());
  if (!now) return "";
  const double apart = std::abs(now->difference());
  if (apart - now->bound() < kSurely && apart + now->bound() < kPerhaps) return "";
  return fmt::format(
      "the clocks of the hosts that stamp images and positions of {} differ by {:.1f} ms, give or "
      "take "
      "{:.1f} ms: let both follow one source, by chrony or PTP",
      question_.robot, now->difference() * 1e-3, now->bound() * 1e-3);
}

}  // namespace arcstart::sensor_capture
