// A sensor_capture that was started again, and two of one kind.
#include <arcstart/seam_t.hpp>
#include <catch2/catch.hpp>

#include "tests/seam_finding/scan/delivered_scans.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

TEST_CASE("a restarted sensor_capture ends the scan with the same refusal, in any order") {
  Traffic traffic;
  ScanMessages messages = scan_of(8);
  for (int i = 0; i < 3; ++i) traffic.states.push_back(messages.scanning);
  traffic.profiles = messages.profiles;
  traffic.states.push_back(idle_state(messages.scanning.run_id + kOneSecond));
  ScanIdentity next{messages.scanning.run_id + kOneSecond,
                    messages.scanning.scan_id + 60 * kOneSecond};
  add(traffic, scan_of(6, next));
  for (int seed = 0; seed < 200; ++seed) {
    const auto scans = deliver(traffic, seed, seed == 0 ? 1 : seed == 1 ? -1 : 0);
    REQUIRE(scans.size() == 2);
    CHECK_THAT(scans[0].refusal.words, Catch::Contains("sensor_capture restarted"));
    CHECK(scans[0].refusal.code == seam_t::SENSOR_CAPTURE_RESTARTED);
    CHECK(scans[0].profiles.empty());  // how many had come hangs on the order
    CHECK(scans[0].profiles_lost == 0);
    CHECK(scans[1].refusal.empty());
    CHECK(scans[1].profiles.size() == 6);
  }
}

TEST_CASE("two profiles of one seq that differ refuse the scan, equal ones do not") {
  for (const bool differ : {false, true}) {
    ScanCollector collector;
    const ScanMessages messages = scan_of(10);
    profile_t other = messages.profiles[4];
    if (differ) other.tool_position[0] += 30;
    collector.take(messages.scanning);
    for (const auto& profile : messages.profiles) {
      if (profile.seq == other.seq) collector.take(other);
      collector.take(profile);
    }
    collector.take(messages.ended);
    const auto scan = collector.next();
    REQUIRE(scan);
    CHECK(scan->refusal.code == (differ ? seam_t::TWO_SENDERS : 0));
    CHECK(scan->profiles.size() == (differ ? 0 : 10));
    CHECK(scan->profiles_lost == 0);
  }
}

TEST_CASE("two sensor_captures refuse each other's scans, and the next is heard when one is gone") {
  ScanCollector collector;
  const ScanMessages messages = scan_of(6);
  scan_t other = idle_state(messages.scanning.run_id + GENERATE(-1, 1) * kOneSecond);
  collector.take(messages.scanning);
  for (const auto& profile : messages.profiles) collector.take(profile);
  collector.take(other);
  CHECK_FALSE(collector.next());
  scan_t scanning = messages.scanning;
  scanning.utime += 200'000;
  collector.take(scanning);
  const auto scan = collector.next();
  REQUIRE(scan);
  CHECK(scan->refusal.code == seam_t::TWO_SENDERS);
  CHECK(scan->state.scan_id == messages.scanning.scan_id);

  scan_t idle = idle_state(messages.scanning.run_id);
  for (int i = 0; i < 10; ++i) {
    idle.utime += 200'000;
    collector.take(idle);
  }
  const ScanMessages next = scan_of(6, {.scan_id = messages.scanning.scan_id + 60 * kOneSecond});
  collector.take(next.scanning);
  for (const auto& profile : next.profiles) collector.take(profile);
  collector.take(next.ended);
  const auto answered = collector.next();
  REQUIRE(answered);
  CHECK(answered->refusal.empty());
}

TEST_CASE("a scan that had ended before the restart is answered when its profiles come") {
  ScanCollector collector;
  const ScanMessages messages = scan_of(4);
  collector.take(messages.ended);
  collector.take(idle_state(messages.ended.run_id + kOneSecond));
  CHECK_FALSE(collector.next());
  for (const auto& profile : messages.profiles) collector.take(profile);
  const auto scan = collector.next();
  REQUIRE(scan);
  CHECK(scan->refusal.empty());
  CHECK(scan->profiles.size() == 4);
}
