#include "common/host/host_clock.hpp"

#include <fmt/core.h>
#include <sys/timex.h>

namespace arcstart {
namespace {

// us. The kernel counts the error up to this and then gives up; systemd's rule as well.
constexpr std::int64_t kUnknown = 16'000'000;

}  // namespace

std::string HostClock::words() const {
  if (!is_synchronised) return "not synchronised";
  return fmt::format("synchronised within {:.1f} ms", static_cast<double>(bound) * 1e-3);
}

HostClock host_clock(int state, const timex& told) {
  HostClock clock;
  clock.bound = told.maxerror;
  clock.is_synchronised = state >= 0 && (told.status & STA_UNSYNC) == 0 && told.maxerror < kUnknown;
  return clock;
}

HostClock read_host_clock() {
  timex told{};  // modes 0: nothing is set
  return host_clock(adjtimex(&told), told);
}

}  // namespace arcstart
