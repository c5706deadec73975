#include "services/command_line/recordings/recording.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/command_line/recordings/fed_messages.hpp"
#include "tests/command_line/support/synthetic_recording.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;

TEST_CASE("a recording's scans, sensor and robot are found") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  recorded.sensor = "LASER7";
  recorded.robot = "ARM";
  const Recording recording({folder.save("a.lcm", record(recorded))}, "", "");
  CHECK(recording.sensor() == "LASER7");
  CHECK(recording.robot() == "ARM");
  REQUIRE(recording.scans().size() == 2);
  const RecordedScan& scan = recording.scans().at(kWorkpieceScan);
  CHECK(scan.is_workpiece());
  CHECK(scan.ended);
  CHECK(scan.stage() == Stage::kProfiles);
  CHECK(scan.messages[2] == 46);
  CHECK(scan.newest[2] == scan.last_seq);
  CHECK(recording.scans().at(kBackgroundScan).kind == scan_t::BACKGROUND);
  CHECK(recording.warnings().empty());
  CHECK(recording.configuration("extraction")->starts_with("extraction:\n"));
  CHECK_FALSE(recording.configuration("robot_pose"));
  CHECK_NOTHROW(recording.require_channels());
}

TEST_CASE("the earliest stage that was recorded is fed, and nothing derived from it") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = recorded.stripes = true;
  SECTION("images, with all that was made of them beside") {
    recorded.images = true;
    Events events = record(recorded);
    const std::size_t whole = events.size();
    for (std::size_t i = 0; i < whole; ++i) {
      RecordedEvent event = events[i];
      if (event.channel != "LASER0_IMAGE") continue;
      event.channel = "LASER0_PREVIEW";
      events.push_back(event);
    }
    const Recording recording({folder.save("a.lcm", events)}, "", "");
    CHECK(recording.scans().at(kWorkpieceScan).stage() == Stage::kImages);
    for (const auto& [channel, bytes] : fed(recording))
      CHECK((channel == "LASER0_IMAGE" || channel == "ROBOT0_POSE" || channel == "LASER0_SCAN" ||
             channel == "LASER0_CALIBRATION"));
    CHECK(count(recording, "LASER0_IMAGE") == 92);
    CHECK(count(recording, "ROBOT0_POSE") == 650);
  }
  SECTION("with what tells of a scan's end outside it, once") {
    recorded.images = true;
    Events events = record(recorded);
    for (const std::string channel : {"LASER0_IMAGE", "LASER0_PROFILE"}) {
      const auto last = std::find_if(events.rbegin(), events.rend(),
                                     [&](const auto& event) { return event.channel == channel; });
      RecordedEvent end = *last;
      std::fill(end.bytes.begin() + 32, end.bytes.begin() + 40, 0);  // its scan_id
      end.bytes[31] += 1;                                            // its seq
      events.push_back(end);
    }
    const Recording recording({folder.save("a.lcm", events)}, "", "");
    CHECK(count(recording, "LASER0_IMAGE") == 93);
    CHECK(count(recording, "LASER0_PROFILE") == 0);
  }
  SECTION("previews alone are no images") {
    Events events = record(recorded);
    events[100].channel = "LASER0_PREVIEW";
    const Recording recording({folder.save("a.lcm", events)}, "", "");
    CHECK(recording.scans().at(kWorkpieceScan).stage() == Stage::kStripes);
    CHECK(count(recording, "LASER0_STRIPE") == 92);
    CHECK(count(recording, "LASER0_PROFILE") == 0);
  }
  SECTION("each scan from its own") {
    Events events = record(recorded);
    std::erase_if(events, [](const auto& event) {
      stripe_t stripe;
      return event.channel == "LASER0_STRIPE" && decode(event.bytes, stripe).empty() &&
             stripe.scan_id == kBackgroundScan;
    });
    const Recording recording({folder.save("a.lcm", events)}, "", "");
    CHECK(count(recording, "LASER0_STRIPE") == 46);
    CHECK(count(recording, "LASER0_PROFILE") == 46);
  }
}

TEST_CASE("an unwanted scan is left out with the states that tell of it") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  const Recording recording({folder.save("a.lcm", record(recorded))}, "", "");
  const auto messages =
      recording.sources([](const RecordedScan& scan) { return scan.is_workpiece(); });
  for (const auto& message : messages) {
    if (channel_kind(recording.channel(message)) != ChannelKind::kScan) continue;
    scan_t state;
    REQUIRE(decode(recording.read(message), state).empty());
    CHECK(state.scan_id != kBackgroundScan);
  }
}

TEST_CASE("the order of replay does not hang on when the logger got what") {
  const Folder folder;
  Recorded recorded;
  recorded.stripes = true;
  Events events = record(recorded);
  const auto expected = fed(Recording({folder.save("a.lcm", events)}, "", ""));
  for (auto& event : events) {
    if (event.channel == "LASER0_STRIPE") event.timestamp += 300'000;
    if (event.channel == "ROBOT0_POSE") event.timestamp -= 300'000;
    if (event.channel == "LASER0_SCAN") event.timestamp += 150'000;
  }
  sort(events);
  CHECK((fed(Recording({folder.save("b.lcm", events)}, "", "")) == expected));
}

TEST_CASE(
    "files that split a recording, by time or by channel, and loggers that ran at once give the "
    "same") {
  const Folder folder;
  Recorded recorded;
  recorded.stripes = true;
  const Events events = record(recorded);
  const auto expected = fed(Recording({folder.save("a.lcm", events)}, "", ""));

  const auto middle = events.begin() + static_cast<std::ptrdiff_t>(events.size() / 2);
  const auto first = folder.save("a.00", {events.begin(), middle});
  const auto second = folder.save("a.01", {middle, events.end()});
  CHECK((fed(Recording({first, second}, "", "")) == expected));
  CHECK((fed(Recording({second, first}, "", "")) == expected));

  const auto poses = [](const auto& event) { return event.channel == "ROBOT0_POSE"; };
  Events robot, others;
  std::copy_if(events.begin(), events.end(), std::back_inserter(robot), poses);
  std::remove_copy_if(events.begin(), events.end(), std::back_inserter(others), poses);
  const Recording apart({folder.save("robot.lcm", robot), folder.save("others.lcm", others)}, "",
                        "");
  CHECK((fed(apart) == expected));

  const Recording twice({folder / "robot.lcm", folder / "a.lcm"}, "", "");
  CHECK(count(twice, "ROBOT0_POSE") == 650);
  CHECK((fed(twice) == expected));
}
