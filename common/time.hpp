// Clocks. On the wire: us, UTC, host clock. Durations: the steady clock.
#pragma once

#include <cstdint>

namespace arcstart {

std::int64_t utime_now();   // us since 1970, UTC (CLOCK_REALTIME)
std::int64_t steady_now();  // us on CLOCK_MONOTONIC, for durations

constexpr std::int64_t seconds_to_us(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e6 + (seconds < 0 ? -0.5 : 0.5));
}

}  // namespace arcstart
