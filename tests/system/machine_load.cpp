#include "tests/system/machine_load.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "common/time.hpp"

namespace arcstart {
namespace {

// Of the time, at least, in which a service that computes for a sixth of it falls behind.
constexpr double kWaiting = 0.2;

// Packets that found no room in a socket of this network, so far.
long dropped_packets() {
  std::ifstream counters("/proc/net/snmp");
  std::string names, values;
  while (std::getline(counters, names) && std::getline(counters, values)) {
    std::istringstream name(names), value(values);
    std::string key, number;
    while (names.rfind("Udp:", 0) == 0 && name >> key && value >> number)
      if (key == "RcvbufErrors") return std::stol(number);
  }
  return 0;
}

// For how long the process's threads were ready and had no processor, so far; ns.
std::int64_t waited_for_processor(pid_t pid) {
  std::int64_t sum = 0;
  std::error_code gone;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task", gone)) {
    std::ifstream times(task.path() / "schedstat");
    std::int64_t ran = 0, waited = 0;
    if (times >> ran >> waited) sum += waited;
  }
  return sum;
}

}  // namespace

bool MachineLoad::kept_up(const std::vector<pid_t>& processes) {
  const std::int64_t now = steady_now();
  const long dropped = dropped_packets();
  bool kept_up = dropped == dropped_;
  for (const pid_t pid : processes) {
    const std::int64_t waited = waited_for_processor(pid);
    // Both are of the same stretch: ns for each us of it.
    kept_up &= static_cast<double>(waited - waited_[pid]) <
               1e3 * kWaiting * static_cast<double>(now - last_);
    waited_[pid] = waited;
  }
  last_ = now, dropped_ = dropped;
  return kept_up;
}

}  // namespace arcstart
