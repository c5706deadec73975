#include "services/seam_finding/scan/scan_collector.hpp"

#include <arcstart/seam_t.hpp>
#include <catch2/catch.hpp>
#include <random>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "tests/seam_finding/support/synthetic_messages.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

constexpr std::int64_t kOneSecond = 1'000'000;

// A scan of so many empty stripes: what they show does not matter here.
ScanMessages scan_of(int images, ScanIdentity identity = {}) {
  ScanCloud cloud;
  for (int k = 0; k < images; ++k) end_stripe(cloud, ScanStripe::Seen::kEmpty);
  return to_messages(cloud, identity);
}

std::vector<CollectedScan> all_of(ScanCollector& collector) {
  std::vector<CollectedScan> scans;
  while (auto scan = collector.next()) scans.push_back(std::move(*scan));
  return scans;
}

// Two channels, each in its own order.
struct Traffic {
  std::vector<scan_t> states;
  std::vector<profile_t> profiles;
};

// Delivers both channels in an order drawn at random, and gives what came of it.
std::vector<CollectedScan> deliver(const Traffic& traffic, std::uint64_t seed, int lead) {
  std::mt19937 engine(seed);
  ScanCollector collector;
  std::vector<CollectedScan> scans;
  std::size_t s = 0, p = 0;
  while (s < traffic.states.size() || p < traffic.profiles.size()) {
    bool state = s < traffic.states.size() && (p == traffic.profiles.size() || engine() % 2 == 0);
    // lead > 0: the states come first, lead < 0: last.
    if (lead > 0 && s < traffic.states.size()) state = true;
    if (lead < 0 && p < traffic.profiles.size()) state = false;
    if (state)
      collector.take(traffic.states[s++]);
    else
      collector.take(traffic.profiles[p++]);
    for (auto& scan : all_of(collector)) scans.push_back(std::move(scan));
  }
  return scans;
}

void add(Traffic& traffic, const ScanMessages& messages) {
  for (int i = 0; i < 3; ++i) traffic.states.push_back(messages.scanning);
  for (int i = 0; i < 3; ++i) traffic.states.push_back(messages.ended);
  traffic.profiles.insert(traffic.profiles.end(), messages.profiles.begin(),
                          messages.profiles.end());
}

}  // namespace

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
