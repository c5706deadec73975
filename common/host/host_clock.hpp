// Whether a host's clock follows a source of time, as its kernel knows it.
#pragma once

#include <cstdint>
#include <string>

struct timex;

namespace arcstart {

struct HostClock {
  bool is_synchronised = false;
  std::int64_t bound = 0;  // us: by how much it may be wrong, where it is synchronised

  std::string words() const;  // "synchronised within 1.2 ms"
};

// The kernel's own account (adjtimex(2)), which chronyd, ptp4l with phc2sys, and
// systemd-timesyncd keep; asks for no right.
HostClock read_host_clock();

// state: what adjtimex returned.
HostClock host_clock(int state, const timex& told);

}  // namespace arcstart
