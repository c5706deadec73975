// The beat at which a controller reports: multiples of its period on its own clock.
#pragma once

#include <cstdint>

#include "services/cell_simulator/base/device_clock.hpp"

namespace arcstart::cell_simulator {

// The first beat after `now`, on the host's clock; us, UTC.
inline std::int64_t next_beat(const DeviceClock& clock, std::int64_t period_ns, std::int64_t now) {
  std::int64_t beat = (clock.nanoseconds(now) / period_ns + 1) * period_ns;
  while (clock.utime(beat) <= now) beat += period_ns;
  return clock.utime(beat);
}

}  // namespace arcstart::cell_simulator
