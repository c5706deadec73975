// What a recording would feed to the pipeline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "services/command_line/recordings/recording.hpp"

namespace arcstart::test {

using command_line::RecordedScan;
using command_line::Recording;

inline bool any(const RecordedScan&) { return true; }

// What the recording would feed, as channel and bytes.
inline std::vector<std::pair<std::string, std::vector<std::uint8_t>>> fed(
    const Recording& recording) {
  std::vector<std::pair<std::string, std::vector<std::uint8_t>>> messages;
  for (const auto& message : recording.sources(any))
    messages.emplace_back(recording.channel(message), recording.read(message));
  return messages;
}

inline std::size_t count(const Recording& recording, const std::string& channel) {
  const auto messages = fed(recording);
  return static_cast<std::size_t>(
      std::count_if(messages.begin(), messages.end(),
                    [&](const auto& message) { return message.first == channel; }));
}

}  // namespace arcstart::test
