// The recordings in logs/ give what they must: the same verdict, and the same seam within 0.001 mm
// on any machine.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "common/bus/event_log.hpp"
#include "paths.hpp"
#include "services/command_line/output/seam_json.hpp"
#include "services/command_line/recordings/replay.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> recordings() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(std::string(ARCSTART_SOURCE) + "/logs"))
    if (entry.path().extension() == ".lcm") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<nlohmann::json> expected_of(const fs::path& recording) {
  std::ifstream file(fs::path(recording).replace_extension(".expected.json"));
  std::vector<nlohmann::json> seams;
  for (std::string line; std::getline(file, line);) seams.push_back(nlohmann::json::parse(line));
  return seams;
}

std::vector<std::vector<std::uint8_t>> bytes_of(const ReplayResult& result) {
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const auto& seam : result.seams) bytes.push_back(seam.bytes);
  return bytes;
}

// The recording with every channel's events moved by a constant of its own, at most 300 ms either
// way.
void write_shifted(const fs::path& recording, const std::string& path, unsigned seed) {
  const EventLog log(recording);
  std::mt19937 random(seed);
  std::map<std::string, std::int64_t> shifts;
  std::vector<std::pair<std::int64_t, const EventEntry*>> order;
  for (const EventEntry& entry : log.entries()) {
    const auto shift =
        shifts.try_emplace(entry.channel, static_cast<std::int64_t>(random() % 600'001) - 300'000);
    order.emplace_back(entry.timestamp + shift.first->second, &entry);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  EventLogWriter writer(path);
  for (const auto& [timestamp, entry] : order)
    writer.write(timestamp, entry->channel, log.read(*entry));
  writer.close();
}

}  // namespace

TEST_CASE("every recording gives its expected result") {
  REQUIRE(recordings().size() >= 12);
  std::uintmax_t size = 0;
  for (const fs::path& recording : recordings()) {
    INFO(recording.filename());
    size += fs::file_size(recording);
    const ReplayResult result = replay_recordings({recording});
    const auto expected = expected_of(recording);
    REQUIRE(result.seams.size() == expected.size());
    CHECK(result.unanswered.empty());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const nlohmann::json seam = seam_to_json(result.seams[i].seam);
      for (const char* key :
           {"scan_id", "verdict", "refusal", "reason", "usable", "joint_type", "calibration_id",
            "background_scan_id", "stripes", "stripes_empty", "stripes_overlit", "stripes_unusable",
            "stripes_without_pose", "images_lost", "profiles_lost"}) {
        INFO(key);
        CHECK(seam.at(key) == expected[i].at(key));
      }
      for (const char* key : {"start", "end", "direction"})
        for (std::size_t axis = 0; axis < 3; ++axis) {
          INFO(key << " " << axis);
          CHECK(seam.at(key)[axis].get<double>() ==
                Approx(expected[i].at(key)[axis].get<double>()).margin(0.001).epsilon(0));
        }
    }
  }
  CHECK(size < 36'000'000);
}

TEST_CASE("a recording gives the same bytes twice, and whatever the channels' delays") {
  const fs::path recording = std::string(ARCSTART_SOURCE) + "/logs/tool_50.lcm";
  const auto once = bytes_of(replay_recordings({recording}));
  CHECK(once.size() == 2);
  CHECK(bytes_of(replay_recordings({recording})) == once);
  const std::string shifted = std::string(ARCSTART_BUILD) + "/tests/shifted.lcm";
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    INFO("seed " << seed);
    fs::remove(shifted);
    write_shifted(recording, shifted, seed);
    CHECK(bytes_of(replay_recordings({shifted})) == once);
  }
  fs::remove(shifted);
}
