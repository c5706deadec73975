#include "services/seam_finding/scan/scan_collector.hpp"

#include <arcstart/seam_t.hpp>
#include <catch2/catch.hpp>

#include "tests/seam_finding/scan/delivered_scans.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

TEST_CASE("a scan is whole when it ended and its last profile has come, in whichever order") {
  const ScanMessages messages = scan_of(10);
  SECTION("the state last") {
    ScanCollector collector;
    for (const auto& profile : messages.profiles) collector.take(profile);
    CHECK_FALSE(collector.next());
    collector.take(messages.scanning);
    CHECK_FALSE(collector.next());
    collector.take(messages.ended);
    const auto scan = collector.next();
    REQUIRE(scan);
    CHECK(scan->profiles.size() == 10);
    CHECK(scan->profiles_lost == 0);
    CHECK_FALSE(collector.next());
    CHECK_FALSE(collector.is_open());
  }
  SECTION("the last profile last") {
    ScanCollector collector;
    collector.take(messages.scanning);
    collector.take(messages.ended);
    for (const auto& profile : messages.profiles) {
      CHECK_FALSE(collector.next());
      CHECK(collector.awaits_profiles());
      collector.take(profile);
    }
    CHECK(collector.next());
    CHECK_FALSE(collector.awaits_profiles());
  }
}

TEST_CASE("no order between the channels makes a difference") {
  Traffic traffic;
  ScanIdentity identity;
  for (int i = 0; i < 3; ++i) {
    auto messages = scan_of(12 + i, identity);
    if (i == 1) messages.profiles.erase(messages.profiles.begin() + 4);  // lost on its way
    if (i == 1) messages.profiles.pop_back();                            // the last one, too
    add(traffic, messages);
    identity.scan_id += 10 * kOneSecond;
    identity.first_seq += 100;
    identity.kind = scan_t::BACKGROUND;
  }
  const auto judge = deliver(traffic, 0, 1);
  REQUIRE(judge.size() == 3);
  CHECK(judge[1].profiles_lost == 2);
  for (int seed = 0; seed < 200; ++seed) {
    const auto scans = deliver(traffic, seed, seed == 1 ? -1 : 0);
    REQUIRE(scans.size() == judge.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
      CHECK(scans[i].state.scan_id == judge[i].state.scan_id);
      CHECK(scans[i].state.kind == judge[i].state.kind);
      CHECK(scans[i].profiles.size() == judge[i].profiles.size());
      CHECK(scans[i].profiles_lost == judge[i].profiles_lost);
      CHECK(scans[i].refusal.empty());
    }
  }
}

TEST_CASE("what is lost at a scan's end, or all of it, is counted when its end comes by") {
  // As sensor_capture sends it after the last image, and the chain carries it on.
  const ScanMessages messages = scan_of(10);
  profile_t end = messages.profiles.back();
  end.scan_id = 0;
  end.scan_index = -1;
  ++end.seq;
  for (const std::size_t lost : {std::size_t{1}, std::size_t{10}}) {
    ScanCollector collector;
    collector.take(messages.scanning);
    for (std::size_t i = 0; i + lost < 10; ++i) collector.take(messages.profiles[i]);
    collector.take(messages.ended);
    CHECK_FALSE(collector.next());
    collector.take(end);
    const auto scan = collector.next();
    REQUIRE(scan);
    CHECK(scan->refusal.empty());
    CHECK(scan->profiles_lost == static_cast<int>(lost));
    CHECK(collector.lost() == static_cast<std::int64_t>(lost));
  }
}

TEST_CASE("a scan is given once, however often its end is told") {
  ScanCollector collector;
  const ScanMessages messages = scan_of(5);
  collector.take(messages.scanning);
  for (const auto& profile : messages.profiles) collector.take(profile);
  collector.take(messages.ended);
  CHECK(all_of(collector).size() == 1);
  collector.take(messages.ended);
  collector.take(messages.profiles.back());
  CHECK(all_of(collector).empty());
  CHECK_FALSE(collector.is_open());
}

TEST_CASE("a scan without images is decided by its end alone") {
  ScanCollector collector;
  const ScanMessages messages = scan_of(0);
  collector.take(messages.scanning);
  CHECK_FALSE(collector.next());
  collector.take(messages.ended);
  const auto scan = collector.next();
  REQUIRE(scan);
  CHECK(scan->state.images == 0);
  CHECK(scan->refusal.empty());
}

TEST_CASE("a lost end is told by the next scan") {
  ScanCollector collector;
  const ScanMessages first = scan_of(7);
  ScanMessages second =
      scan_of(5, {.scan_id = first.scanning.scan_id + 9 * kOneSecond, .first_seq = 600});
  collector.take(first.scanning);
  for (const auto& profile : first.profiles) collector.take(profile);
  second.scanning.previous_scan_id = first.scanning.scan_id;
  second.scanning.previous_kind = first.ended.kind;
  second.scanning.previous_end_utime = first.ended.end_utime;
  second.scanning.previous_end_cause = scan_t::CAMERA_LOST;
  second.scanning.previous_first_seq = first.ended.first_seq;
  second.scanning.previous_last_seq = first.ended.last_seq;
  second.scanning.previous_lost = 2;
  second.scanning.previous_images = first.ended.images;
  collector.take(second.scanning);
  const auto scan = collector.next();
  REQUIRE(scan);
  CHECK(scan->state.scan_id == first.scanning.scan_id);
  CHECK(scan->state.end_utime == first.ended.end_utime);
  CHECK(scan->state.end_cause == scan_t::CAMERA_LOST);
  CHECK(scan->state.first_seq == first.ended.first_seq);
  CHECK(scan->state.lost == 2);
  CHECK(scan->state.request == 7);  // as the scan itself had said
  CHECK(scan->state.job == "job");
  CHECK(scan->state.part == "part");
  CHECK(scan->state.start_command_id == first.scanning.start_command_id);
  CHECK(scan->profiles.size() == 7);
}

TEST_CASE("a late starter counts what it missed") {
  ScanCollector collector;
  const ScanMessages messages = scan_of(10);
  for (std::size_t i = 4; i < 10; ++i) collector.take(messages.profiles[i]);
  collector.take(messages.ended);
  const auto scan = collector.next();
  REQUIRE(scan);
  CHECK(scan->profiles_lost == 4);
  CHECK(collector.lost() == 4);
}

TEST_CASE("scans answered in an earlier life are left alone") {
  ScanCollector collector;
  const ScanMessages messages = scan_of(3);
  collector.skip(messages.ended.scan_id);
  collector.take(messages.ended);
  for (const auto& profile : messages.profiles) collector.take(profile);
  CHECK_FALSE(collector.next());
  CHECK_FALSE(collector.is_open());
}

TEST_CASE("a dead chain is given up only on demand") {
  ScanCollector collector;
  const ScanMessages messages = scan_of(5);
  collector.take(messages.scanning);
  collector.take(messages.profiles.front());
  collector.take(messages.ended);
  CHECK_FALSE(collector.next());
  collector.give_up(refuse_scan(seam_t::NO_PROFILES, "5"));
  const auto scan = collector.next();
  REQUIRE(scan);
  CHECK(scan->refusal.code == seam_t::NO_PROFILES);
  CHECK_THAT(scan->refusal.words, Catch::Contains("no profile for 5 s"));
  for (const auto& profile : messages.profiles) collector.take(profile);
  CHECK_FALSE(collector.next());
}

TEST_CASE("a scan of which no end is ever told does not keep the next from its answer") {
  ScanCollector collector;
  const ScanMessages lost = scan_of(5);
  const ScanMessages next =
      scan_of(5, {.scan_id = lost.scanning.scan_id + 9 * kOneSecond, .first_seq = 700});
  for (const auto& profile : lost.profiles) collector.take(profile);
  collector.take(next.scanning);
  for (const auto& profile : next.profiles) collector.take(profile);
  collector.take(next.ended);
  const auto scans = all_of(collector);
  REQUIRE(scans.size() == 2);
  CHECK_THAT(scans[0].refusal.words, Catch::Contains("end was never told"));
  CHECK(scans[1].refusal.empty());
}

TEST_CASE("ids without end do not fill the memory") {
  ScanCollector collector;
  profile_t profile = scan_of(1).profiles.front();
  for (int i = 0; i < 10000; ++i) {
    profile.scan_id += kOneSecond;
    collector.take(profile);
  }
  CHECK_FALSE(collector.next());
  // One scan of more points than can be: refused when it is seen, not kept.
  ScanCollector other;
  profile.count = 100000;
  profile.x.resize(100000);
  profile.why = profile_t::NONE;
  profile.empty.clear();
  for (int i = 0; i < 30; ++i) {
    ++profile.seq;
    other.take(profile);
  }
  const auto scan = other.next();
  REQUIRE(scan);
  CHECK(scan->refusal.code == seam_t::TOO_MANY_POINTS);
  CHECK_THAT(scan->refusal.words, Catch::Contains("more points"));
}
