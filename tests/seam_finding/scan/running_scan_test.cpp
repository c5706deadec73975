// What is made ready while a scan runs is what is made of the whole scan at once, bit by bit.
#include "services/seam_finding/scan/running_scan.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "tests/seam_finding/scan/answered_scans.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

std::vector<std::uint8_t> bytes_of(const seam_t& seam) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(seam.getEncodedSize()));
  seam.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

struct Cell {
  Scene scene = make_scene({.tool = true}, 11);
  CollectedScan work;
  std::unique_ptr<StoredBackground> background, another;

  Cell() {
    Scene cell = scene;
    cell.boxes.clear();
    ScanIdentity identity;
    work = as_collected(to_messages(make_scan(scene, {}, 1).cloud, identity));
    identity.kind = scan_t::BACKGROUND;
    for (auto* stored : {&another, &background}) {
      identity.scan_id -= 60'000'000;
      *stored = std::make_unique<StoredBackground>(
          as_collected(
              to_messages(make_scan(cell, {}, stored == &another ? 3 : 2).cloud, identity)),
          SeamFindingSettings());
    }
  }
  void lose(std::size_t profile) {
    work.profiles.erase(work.profiles.begin() + static_cast<std::ptrdiff_t>(profile));
    ++work.profiles_lost;
  }
};

// The same as at once, whatever came before the end.
bool same_as_at_once(RunningScan& running, const CollectedScan& scan,
                     const StoredBackground* background) {
  const PreparedScan ready = running.finish(scan, background);
  const PreparedScan judge = prepare(scan, background);
  REQUIRE(ready.cloud.size() == judge.cloud.size());
  REQUIRE(ready.cloud.stripes.size() == judge.cloud.stripes.size());
  bool same = ready.cloud.points == judge.cloud.points &&
              ready.segmentation.background == judge.segmentation.background &&
              ready.segmentation.workpiece == judge.segmentation.workpiece;
  for (std::size_t k = 0; k < judge.cloud.stripes.size(); ++k) {
    const ScanStripe &a = ready.cloud.stripes[k], &b = judge.cloud.stripes[k];
    same = same && a.seen == b.seen && a.first == b.first && a.count == b.count &&
           a.camera_centre == b.camera_centre && a.tool_position == b.tool_position;
  }
  for (std::size_t i = 0; i < judge.cloud.origins.size(); ++i) {
    const PointOrigin &a = ready.cloud.origins[i], &b = judge.cloud.origins[i];
    same = same && a.stripe == b.stripe && a.segment == b.segment &&
           a.segment_end == b.segment_end && a.deviation == b.deviation && a.step == b.step;
  }
  REQUIRE(ready.thinned.points.size() == judge.thinned.points.size());
  same = same && ready.thinned.behind == judge.thinned.behind &&
         std::equal(judge.thinned.points.begin(), judge.thinned.points.end(),
                    ready.thinned.points.begin(), [](const ThinnedPoint& a, const ThinnedPoint& b) {
                      return a.at == b.at && a.index == b.index && a.segment == b.segment &&
                             a.ends == b.ends;
                    });
  return same && bytes_of(answer_workpiece(scan, ready, background, {})) ==
                     bytes_of(answer_workpiece(scan, background, {}));
}

}  // namespace

TEST_CASE("profiles in their order are ready with the last one, and the same as at once") {
  Cell cell;
  SECTION("all of them") {}
  SECTION("some lost on their way") {
    for (const std::size_t k : {40, 22, 21}) cell.lose(k);
  }
  SECTION("the last ones lost") {
    cell.lose(cell.work.profiles.size() - 1);
    cell.lose(cell.work.profiles.size() - 1);
  }
  SECTION("the first one lost") { cell.lose(0); }
  SECTION("the state does not know the first") { cell.work.state.first_seq = -1; }
  SECTION("one sent twice") {
    RunningScan running;
    for (const profile_t& profile : cell.work.profiles)
      for (int twice = 0; twice < 2; ++twice) running.take(profile, cell.background.get());
    CHECK(same_as_at_once(running, cell.work, cell.background.get()));
    CHECK(running.was_ready());
  }
  RunningScan running;
  for (const profile_t& profile : cell.work.profiles) running.take(profile, cell.background.get());
  CHECK(same_as_at_once(running, cell.work, cell.background.get()));
  CHECK(running.was_ready());
  running.take(cell.work.profiles.back(), cell.background.get());  // late, and harmless
}

TEST_CASE("profiles in any other order are put right at the end") {
  Cell cell;
  std::vector<profile_t> order = cell.work.profiles;
  std::mt19937 engine(3);
  for (int seed = 0; seed < 5; ++seed) {
    std::shuffle(order.begin() + 10, order.end(), engine);
    RunningScan running;
    for (const profile_t& profile : order) running.take(profile, cell.background.get());
    CHECK(same_as_at_once(running, cell.work, cell.background.get()));
    CHECK_FALSE(running.was_ready());
  }
}

TEST_CASE("the background may come late, be missing, or be another than was thought") {
  Cell cell;
  const StoredBackground *one = cell.background.get(), *two = cell.another.get();
  const auto count = static_cast<int>(cell.work.profiles.size());
  for (const auto& [before, change, after, last] :
       {std::tuple(static_cast<const StoredBackground*>(nullptr), 20, one, one),
        std::tuple(static_cast<const StoredBackground*>(nullptr), count, one, one),
        std::tuple(one, 20, two, two), std::tuple(one, 20, two, one),
        std::tuple(one, count, one, two),
        std::tuple(one, 20, static_cast<const StoredBackground*>(nullptr), one),
        std::tuple(one, count, one, static_cast<const StoredBackground*>(nullptr))}) {
    RunningScan running;
    for (int k = 0; k < count; ++k)
      running.take(cell.work.profiles[static_cast<std::size_t>(k)], k < change ? before : after);
    CHECK(same_as_at_once(running, cell.work, last));
  }
}

TEST_CASE("a scan begun anew, and one of another run, leave nothing behind") {
  Cell cell;
  RunningScan running;
  for (std::size_t k = 0; k < 20; ++k) {
    profile_t other = cell.work.profiles[k];
    if (k < 10)
      ++other.scan_id;
    else
      ++other.run_id;
    running.take(other, cell.background.get());
  }
  for (const profile_t& profile : cell.work.profiles) running.take(profile, cell.background.get());
  CHECK(same_as_at_once(running, cell.work, cell.background.get()));
  CHECK(running.was_ready());
}

TEST_CASE("a scan that is not the one that runs is made ready without it") {
  Cell cell;
  RunningScan running;
  profile_t next = cell.work.profiles.front();
  next.scan_id += 60'000'000;
  for (const profile_t& profile : cell.work.profiles) running.take(profile, cell.background.get());
  running.take(next, cell.background.get());
  CHECK(same_as_at_once(running, cell.work, cell.background.get()));
  CHECK_FALSE(running.was_ready());
}

TEST_CASE("profiles without end, and numbers of damage, stay within bounds while they come") {
  Cell cell;
  profile_t crowd = cell.work.profiles[30];
  const auto full = static_cast<std::size_t>(100'000);
  crowd.count = static_cast<int>(full);
  for (auto* list : {&crowd.x, &crowd.y, &crowd.z, &crowd.u, &crowd.v, &crowd.deviation})
    list->assign(full, 5);  // equal points all
  crowd.segment.assign(full, 0);
  crowd.segment_end.assign(full, profile_t::CONTINUES);
  RunningScan running;
  ScanCollector collector;
  for (int k = 0; k < 40; ++k) {
    crowd.seq += k % 2 == 0 ? 1 : 1'000'000'000'000;
    collector.take(crowd);
    running.take(crowd, cell.background.get());
  }
  scan_t ended = cell.work.state;
  ended.last_seq = crowd.seq;
  collector.take(ended);
  const auto scan = collector.next();
  REQUIRE(scan);
  CHECK_FALSE(scan->refusal.empty());
  const PreparedScan prepared = running.finish(*scan, cell.background.get());
  CHECK(prepared.cloud.size() == 0);
}

TEST_CASE("a million equal points, and a background of another cell, while they come") {
  Cell cell;
#if defined(__SANITIZE_ADDRESS__)
  constexpr int kEach = 2'000;
#else
  constexpr int kEach = 20'000;
#endif
  std::vector<Eigen::Vector3d> far_away;
  for (double x = 0; x < 60; x += 2)
    for (double y = 0; y < 60; y += 2) far_away.emplace_back(5000 + x, y, 0);
  for (profile_t& profile : cell.work.profiles) {
    profile.count = kEach;
    for (auto* list :
         {&profile.x, &profile.y, &profile.z, &profile.u, &profile.v, &profile.deviation})
      list->assign(kEach, 20);
    profile.segment.assign(kEach, 0);
    profile.segment_end.assign(kEach, profile_t::CONTINUES);
    profile.why = profile_t::NONE;
    profile.empty.clear();
  }
  RunningScan running;
  for (const profile_t& profile : cell.work.profiles) running.take(profile, cell.background.get());
  CHECK(same_as_at_once(running, cell.work, cell.background.get()));
  const seam_t seam = answer_workpiece(cell.work, cell.background.get(), {});
  CHECK(seam.verdict == seam_t::REFUSED);
  CHECK_FALSE(seam.reason.empty());
}
