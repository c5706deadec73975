// Whether the machine gave processes what they need: what is lost where it did not is not their
// fault.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <vector>

namespace arcstart {

class MachineLoad {
 public:
  // Since the call before: no socket of this network dropped a packet for want of room, and none of
  // the processes waited for a processor for long.
  bool kept_up(const std::vector<pid_t>& processes);

 private:
  std::int64_t last_ = 0;                 // us, steady
  long dropped_ = 0;                      // packets
  std::map<pid_t, std::int64_t> waited_;  // for a processor; ns
};

}  // namespace arcstart
