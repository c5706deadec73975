// What the tests of replay share: a recording that begins at a stage, an answer's bytes, a
// refusal's words.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "common/configuration.hpp"
#include "services/command_line/recordings/replay.hpp"
#include "tests/command_line/support/synthetic_recording.hpp"

namespace arcstart::test {

using namespace command_line;

using Bytes = std::vector<std::uint8_t>;

inline Events of_stage(Stage stage) {
  Recorded recorded;
  recorded.images = stage == Stage::kImages;
  recorded.stripes = stage == Stage::kStripes;
  recorded.profiles = stage == Stage::kProfiles;
  return record(recorded);
}

inline std::vector<Bytes> bytes_of(const ReplayResult& result) {
  std::vector<Bytes> all;
  for (const auto& seam : result.seams) all.push_back(seam.bytes);
  return all;
}

inline std::string refusal(const std::vector<std::string>& paths,
                           const ReplayOptions& options = {}) {
  std::string what;
  try {
    replay_recordings(paths, options);
  } catch (const InputError& error) {
    what = error.what();
  }
  CHECK(what.find('\n') == std::string::npos);
  return what;
}

}  // namespace arcstart::test
