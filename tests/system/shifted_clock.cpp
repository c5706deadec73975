// Preloaded into one process: its host's clock is ahead of the others' by ARCSTART_CLOCK_AHEAD_US,
// in what it asks and in the stamps that the kernel gives its packets. The steady clock stays.
#include <dlfcn.h>
#include <sys/socket.h>
#include <time.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

void move(timespec& time) {
  static const char* const text = std::getenv("ARCSTART_CLOCK_AHEAD_US");
  static const std::int64_t ahead = text ? std::atoll(text) * 1000 : 0;  // ns
  const std::int64_t nanoseconds = time.tv_nsec + ahead % 1'000'000'000 + 1'000'000'000;
  time.tv_sec += ahead / 1'000'000'000 + nanoseconds / 1'000'000'000 - 1;
  time.tv_nsec = nanoseconds % 1'000'000'000;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static const auto original = next<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int result = original(clock, time);
  if (result == 0 && clock == CLOCK_REALTIME) move(*time);
  return result;
}

extern "C" ssize_t recvmsg(int socket, msghdr* message, int flags) {
  static const auto original = next<ssize_t (*)(int, msghdr*, int)>("recvmsg");
  const ssize_t result = original(socket, message, flags);
  if (result < 0) return result;
  for (cmsghdr* part = CMSG_FIRSTHDR(message); part; part = CMSG_NXTHDR(message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec time;
    std::memcpy(&time, CMSG_DATA(part), sizeof time);
    move(time);
    std::memcpy(CMSG_DATA(part), &time, sizeof time);
  }
  return result;
}
