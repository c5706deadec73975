// Recordings that are cut off, or whose bytes are spoilt.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "tests/command_line/recordings/replay_checks.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;

TEST_CASE("a recording cut off anywhere is replayed as far as it goes") {
  const Folder folder;
  const auto path = folder.save("a.lcm", of_stage(Stage::kProfiles));
  const auto expected = bytes_of(replay_recordings({path}));
  const auto size = std::filesystem::file_size(path);
  const auto cut_to = [&](std::uintmax_t left) {
    std::filesystem::copy_file(path, folder / "cut.lcm",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder / "cut.lcm", left);
  };

  cut_to(size - 1);  // behind the last scan
  const ReplayResult whole = replay_recordings({folder / "cut.lcm"});
  CHECK((bytes_of(whole) == expected));
  CHECK(whole.is_good());
  REQUIRE(whole.warnings.size() == 1);
  CHECK_THAT(whole.warnings[0], Contains("cut.lcm: damaged") && Contains("cut off"));

  // In the second scan.
  const EventLog log(path);
  const auto& entries = log.entries();
  const auto in_scan = std::find_if(entries.begin(), entries.end(), [](const auto& entry) {
    return entry.timestamp > kWorkpieceScan + 1'500'000;
  });
  cut_to(in_scan->offset + 3);
  const ReplayResult half = replay_recordings({folder / "cut.lcm"});
  REQUIRE(half.seams.size() == 1);
  CHECK(half.seams[0].bytes == expected[0]);
  REQUIRE(half.unanswered.size() == 1);
  CHECK(half.unanswered[0].scan_id == kWorkpieceScan);
  CHECK_THAT(half.unanswered[0].why, Contains("the recording ends within it"));
  CHECK_FALSE(half.is_good());

  // In the first.
  const auto in_first = std::find_if(entries.begin(), entries.end(), [](const auto& entry) {
    return entry.timestamp > kBackgroundScan + 1'500'000;
  });
  cut_to(in_first->offset + 3);
  CHECK_THAT(refusal({folder / "cut.lcm"}),
             Contains("cut off") && Contains("no scan before it is whole"));

  for (std::uintmax_t left = 1; left < size; left += size / 37) {
    cut_to(left);
    try {
      const ReplayResult result = replay_recordings({folder / "cut.lcm"});
      const auto bytes = bytes_of(result);
      REQUIRE(bytes.size() <= expected.size());
      CHECK(std::equal(bytes.begin(), bytes.end(), expected.begin()));
    } catch (const InputError&) {
    }
  }
}

TEST_CASE("messages damaged behind their first bytes are counted once and left out") {
  const Folder folder;
  Events events = of_stage(Stage::kProfiles);
  int cut = 0;
  for (auto& event : events)
    if (event.channel == "LASER0_PROFILE" && event.timestamp > kWorkpieceScan + 1'000'000 &&
        cut < 2) {
      event.bytes.resize(event.bytes.size() - 1);
      ++cut;
    }
  const ReplayResult result = replay_recordings({folder.save("a.lcm", events)});
  CHECK(result.undecodable == 2);
  REQUIRE(result.seams.size() == 2);
  CHECK(result.seams[1].seam.profiles_lost == 2);
}

TEST_CASE("bytes flipped anywhere in a recording crash nothing") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = recorded.stripes = true;
  const auto path = folder.save("a.lcm", record(recorded));
  std::ifstream in(path, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(in), {});
  std::mt19937 random(17);
  int replayed = 0;
  for (int round = 0; round < 25; ++round) {
    std::string spoilt = whole;
    for (int i = 0; i < 40; ++i) spoilt[random() % spoilt.size()] = static_cast<char>(random());
    std::ofstream(folder / "b.lcm", std::ios::binary) << spoilt;
    try {
      replay_recordings({folder / "b.lcm"});
      ++replayed;
    } catch (const InputError&) {
    }
  }
  CHECK(replayed > 0);
}
