// A device's own clock.
#pragma once

#include <cmath>
#include <cstdint>

namespace arcstart::cell_simulator {

// Runs beside the host's clock with an epoch and a rate of its own.
struct DeviceClock {
  std::int64_t start_utime = 0;  // host time at which it shows start_ns; us, UTC
  std::int64_t start_ns = 0;
  double drift_ppm = 0;  // above 0: it runs fast

  std::int64_t nanoseconds(std::int64_t utime) const {
    const std::int64_t elapsed_us = utime - start_utime;
    return start_ns + elapsed_us * 1000 +
           std::llround(static_cast<double>(elapsed_us) * drift_ppm * 1e-3);
  }

  // Host time at which it shows so much; us, UTC.
  std::int64_t utime(std::int64_t shown_ns) const {
    const double elapsed_ns = static_cast<double>(shown_ns - start_ns) / (1 + drift_ppm * 1e-6);
    return start_utime + std::llround(elapsed_ns * 1e-3);
  }
};

}  // namespace arcstart::cell_simulator
