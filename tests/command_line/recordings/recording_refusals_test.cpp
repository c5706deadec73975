#include <fmt/core.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "services/command_line/recordings/recording.hpp"
#include "tests/command_line/recordings/fed_messages.hpp"
#include "tests/command_line/support/synthetic_recording.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

std::string refusal(const std::vector<std::string>& paths, const std::string& sensor = "") {
  try {
    Recording(paths, sensor, "").require_channels();
  } catch (const RecordingError& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error.what();
  }
  return "";
}

Events without(Events events, const std::string& channel) {
  std::erase_if(events, [&](const auto& event) { return event.channel == channel; });
  return events;
}

}  // namespace

TEST_CASE("what cannot be replayed is refused in one line that says what is lacking") {
  const Folder folder;
  Recorded recorded;
  recorded.stripes = true;
  const Events events = record(recorded);
  const auto lacking = [&](const std::string& channel) {
    return refusal({folder.save("a.lcm", without(events, channel))});
  };
  CHECK_THAT(lacking("ROBOT0_POSE"),
             Contains("a.lcm: lacks channel ROBOT0_POSE (the robot's positions"));
  CHECK_THAT(lacking("LASER0_CALIBRATION"),
             Contains("lacks channel LASER0_CALIBRATION (the calibration"));
  CHECK_THAT(lacking("LASER0_SCAN"), Contains("lacks channel LASER0_SCAN (when scans begin"));
  CHECK_THAT(
      refusal({folder.save("b.lcm", without(without(events, "LASER0_STRIPE"), "LASER0_SCAN"))}),
      Contains("holds no scan"));
  CHECK(lacking("LASER0_EXTRACTION_STATUS").empty());

  Recorded idle;
  idle.background = idle.workpiece = false;
  idle.profiles = true;
  CHECK_THAT(refusal({folder.save("idle.lcm", record(idle))}),
             Contains("holds no scan: LASER0_SCAN never tells"));

  Events undecodable = events;
  for (auto& event : undecodable)
    if (event.channel == "LASER0_CALIBRATION") event.bytes.pop_back();
  CHECK_THAT(refusal({folder.save("c.lcm", undecodable)}),
             Contains("LASER0_CALIBRATION") && Contains("none of its messages can be decoded"));

  // Profiles need neither positions nor a calibration.
  Recorded late;
  late.profiles = true;
  CHECK(refusal({folder.save("d.lcm",
                             without(without(record(late), "ROBOT0_POSE"), "LASER0_CALIBRATION"))})
            .empty());
}

TEST_CASE("of several sensors one must be chosen") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  const auto first = folder.save("a.lcm", record(recorded));
  recorded.sensor = "LASER1";
  const auto second = folder.save("b.lcm", record(recorded));
  CHECK_THAT(refusal({first, second}),
             Contains("holds several sensors, LASER0, LASER1: choose one with --sensor"));
  CHECK(refusal({first, second}, "LASER1").empty());
  CHECK_THAT(refusal({first, second}, "LASER2"),
             Contains("holds nothing of sensor LASER2, but of LASER0, LASER1"));
  const Recording recording({first, second}, "LASER1", "");
  CHECK(count(recording, "LASER0_PROFILE") == 0);
  CHECK(count(recording, "LASER1_PROFILE") == 92);
}

TEST_CASE("messages of another type or version are counted and left out") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  Events events = record(recorded);
  int spoilt = 0;
  for (auto& event : events) {
    if (event.channel == "LASER0_PROFILE" && spoilt < 3) event.bytes[spoilt++] ^= 1;
    if (event.channel == "ROBOT0_POSE" && spoilt == 3) event.bytes.resize(20), ++spoilt;
  }
  const Recording recording({folder.save("a.lcm", events)}, "", "");
  CHECK(recording.undecodable() == 4);
  CHECK(count(recording, "LASER0_PROFILE") == 89);
  REQUIRE(recording.warnings().size() == 2);
  CHECK_THAT(recording.warnings()[0], Contains("LASER0_PROFILE: 3 messages cannot be decoded"));
}

TEST_CASE("a recording of the version before is refused in one line that says so") {
  const Folder folder;
  Recorded recorded;
  recorded.images = recorded.stripes = recorded.profiles = true;
  const Events events = record(recorded);
  const std::pair<const char*, std::uint64_t> former[] = {
      {"LASER0_CALIBRATION calibration_t", 0xcc0bc3c8dfcfe2cb},
      {"LASER0_IMAGE image_t", 0x3c000d0d77f4ada4},
      {"LASER0_PROFILE profile_t", 0x3878b0cb49009ba6},
      {"ROBOT0_POSE robot_pose_t", 0x1b180dbd77ef4b7b},
      {"LASER0_SCAN scan_t", 0x40b1b1f24f20b6dc},
      {"LASER0_STRIPE stripe_t", 0x54c036e723b96b52},
  };
  for (const auto& [names, hash] : former) {
    const std::string both = names, channel = both.substr(0, both.find(' ')),
                      type = both.substr(both.find(' ') + 1);
    INFO(both);
    Events old = events;
    for (auto& event : old)
      if (event.channel == channel)
        for (std::size_t i = 0; i < 8; ++i)
          event.bytes[i] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
    const std::string line = refusal({folder.save("old.lcm", old)});
    CHECK_THAT(line, Contains("old.lcm: is of the version before") && Contains(channel) &&
                         Contains("the former " + type) && Contains("record it again"));
  }
}

TEST_CASE("why a scan is not answered is told from what was recorded") {
  const Folder folder;
  Recorded recorded;
  recorded.stripes = true;
  recorded.background = false;
  Events events = record(recorded);
  const auto why = [&](const Events& some) {
    const Recording recording({folder.save("a.lcm", some)}, "", "");
    return recording.why_unanswered(recording.scans().at(kWorkpieceScan));
  };
  Events cut = events;
  std::erase_if(cut,
                [](const auto& event) { return event.timestamp > kWorkpieceScan + 2'000'000; });
  CHECK_THAT(why(cut), Contains("the recording ends within it, 27 stripes after its start"));
  CHECK(Recording({folder / "a.lcm"}, "", "").scans().at(kWorkpieceScan).ended == false);

  Events no_last = events;
  std::erase_if(no_last, [](const auto& event) {
    return event.channel == "LASER0_STRIPE" && event.timestamp > kWorkpieceScan + 3'000'000;
  });
  CHECK_THAT(why(no_last), Contains("its last stripes are missing"));

  Events no_poses = events;
  std::erase_if(no_poses, [](const auto& event) {
    return event.channel == "ROBOT0_POSE" && event.timestamp > kWorkpieceScan + 3'000'000;
  });
  CHECK_THAT(why(no_poses), Contains("no position of the robot after its last image"));
}

TEST_CASE("a scan that ended before the recording began is not in it") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  Events events = record(recorded);
  std::erase_if(events,
                [](const auto& event) { return event.timestamp < kBackgroundScan + 4'500'000; });
  const Recording recording({folder.save("a.lcm", events)}, "", "");
  REQUIRE(recording.scans().size() == 1);
  CHECK(recording.scans().begin()->first == kWorkpieceScan);
}

TEST_CASE("images that the logger lost are told where later stages were recorded whole") {
  const Folder folder;
  Recorded recorded;
  recorded.stripes = recorded.profiles = true;
  Events events = record(recorded);
  int lost = 0;
  std::erase_if(events,
                [&](const auto& event) { return event.channel == "LASER0_STRIPE" && ++lost > 90; });
  const Recording recording({folder.save("a.lcm", events)}, "", "");
  REQUIRE(recording.warnings().size() == 1);
  CHECK_THAT(recording.warnings()[0], Contains("44 of its stripes were recorded, but 46 profiles"));
}
