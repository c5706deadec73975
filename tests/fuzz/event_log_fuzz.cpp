// The walk over a recording's headers: whatever bytes come, every event it names lies inside the
// file and behind the one before, and a log without damage is accounted for to its last byte.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "common/bus/event_log.hpp"

namespace {

constexpr std::uint64_t kHeader = 28;

void check(std::span<const std::uint8_t> log) {
  const arcstart::EventWalk walk = arcstart::walk_event_log(log);
  std::uint64_t end = 0;
  for (const auto& entry : walk.entries) {
    const std::size_t name = entry.channel.size();
    if (name < 1 || name > 63 || entry.channel.find('\0') != std::string::npos) std::abort();
    if (entry.offset != end + kHeader + name || entry.offset + entry.size > log.size())
      std::abort();
    end = entry.offset + entry.size;
  }
  if (walk.damage.empty() != (end == log.size())) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check({data, size});
  // The mark in front of every 40 bytes and small lengths, or nothing beyond them would ever be
  // tried.
  std::vector<std::uint8_t> log;
  for (std::size_t at = 0; at < size; at += 40) {
    for (const int byte : {0xED, 0xA1, 0xDA, 0x01}) log.push_back(static_cast<std::uint8_t>(byte));
    log.insert(log.end(), data + at, data + std::min(size, at + 40));
    if (log.size() < kHeader || data[at] % 8 == 0) continue;
    const std::size_t event = log.size() - (std::min(size, at + 40) - at) - 4;
    for (const std::size_t length : {event + 20, event + 24})
      for (std::size_t i = length; i < length + 3 && i < log.size(); ++i) log[i] = 0;
    // As long as it is, were its channel as long as it says.
    if (event + kHeader <= log.size() && event + kHeader + log[event + 23] <= log.size())
      log[event + 27] = static_cast<std::uint8_t>(log.size() - event - kHeader - log[event + 23]);
  }
  check(log);
  return 0;
}
