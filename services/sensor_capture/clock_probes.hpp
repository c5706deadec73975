// The clock of the host that stamps positions, held against this one's: questions on CLOCK_PROBE,
// and what their answers say of the running scan.
#pragma once

#include <arcstart/clock_probe_t.hpp>
#include <arcstart/scan_t.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "services/sensor_capture/clocks/clock_comparison.hpp"

namespace arcstart::sensor_capture {

class ClockProbes {
 public:
  // robot: instance whose positions belong to the images. The bus outlives it.
  ClockProbes(Bus& bus, const std::string& robot, std::int64_t run_id);

  // Asks ten times a second.
  void tick();

  // Fills in difference and bound: of the scan all that was possible while it ran, without one what
  // is known now.
  void fill_in(scan_t& state);

  // What to do where the clocks surely differ by more than any cell bears; else empty.
  std::string trouble() const;

 private:
  void take(const clock_probe_t& message);

  Bus& bus_;
  clock_probe_t question_{};  // the newest; its answer is awaited once
  bool answered_ = true;
  std::int64_t answerer_run_id_ = 0;
  ClockComparison comparison_;
  std::int64_t next_ = 0;  // steady, us

  std::int64_t scan_id_ = 0;
  std::optional<ClockInterval> in_scan_;
};

}  // namespace arcstart::sensor_capture
