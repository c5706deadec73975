#include "common/time.hpp"

#include <ctime>

namespace arcstart {
namespace {

std::int64_t microseconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1000;
}

}  // namespace

std::int64_t utime_now() { return microseconds(CLOCK_REALTIME); }
std::int64_t steady_now() { return microseconds(CLOCK_MONOTONIC); }

}  // namespace arcstart
