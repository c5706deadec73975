// Scans in closed form: an ideal camera exposes at known times, so which frames belong to a scan,
// and when its end can be told, follows by hand.
#include "services/sensor_capture/scan_owner.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

using namespace arcstart;
using Phase = ScanState::Phase;

namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000;
constexpr std::int64_t ms = 1000;
constexpr std::int64_t kPeriod = 100 * ms;
constexpr std::int64_t kExposure = 4 * ms;

// Frame n is exposed from n * 100 ms to n * 100 + 4 ms, all counted from kStart.
struct Cell {
  ScanOwner owner;
  std::vector<std::int64_t> members;  // seq
  std::vector<std::int32_t> indices;

  explicit Cell(ScanOwnerSettings settings = {}) : owner(settings) {
    owner.set_shortest_period(kPeriod * 95 / 100);
  }
  static std::int64_t at(std::int64_t milliseconds) { return kStart + milliseconds * ms; }

  Membership frame(std::int64_t n, bool lit = true, bool complete = true) {
    const ExposedFrame frame{n, kStart + n * kPeriod, kStart + n * kPeriod + kExposure, lit,
                             complete};
    const Membership membership = owner.frame(frame);
    if (membership.scan_id != 0) {
      CHECK(membership.scan_id == owner.state().scan.scan_id);
      members.push_back(n);
      indices.push_back(membership.scan_index);
    }
    return membership;
  }
  void start(std::int64_t id, std::int64_t milliseconds, double longest_s = 60,
             std::int8_t kind = 1) {
    owner.order({id, true, kind, longest_s}, at(milliseconds), "");
  }
  void stop(std::int64_t id, std::int64_t milliseconds) {
    owner.order({id, false, 0, 0}, at(milliseconds), "");
  }
  const ScanState& state() const { return owner.state(); }
  const Scan& scan() const { return owner.state().scan; }
};

}  // namespace

TEST_CASE("scan: idle before the first") {
  Cell cell;
  CHECK(cell.state().phase == Phase::kIdle);
  CHECK(cell.frame(1).scan_id == 0);
  CHECK(cell.frame(1).scan_index == -1);
  CHECK(cell.scan().scan_id == 0);
  CHECK(cell.scan().first_seq == -1);
  CHECK(cell.scan().last_seq == -1);
  CHECK_FALSE(cell.owner.laser_wanted());
}

TEST_CASE("scan: from start to stop, frames wholly within and lit") {
  Cell cell;
  for (int n = 1; n <= 3; ++n) cell.frame(n, false);
  cell.start(11, 401, 60, 1);  // frame 4 is being exposed
  CHECK(cell.owner.laser_wanted());
  CHECK(cell.state().phase == Phase::kScanning);
  CHECK(cell.state().command_id == 11);
  CHECK(cell.scan().scan_id == Cell::at(401));
  CHECK(cell.scan().kind == 1);
  cell.frame(4, true);   // it began before the scan
  cell.frame(5, false);  // the laser's switching is not answered yet
  CHECK(cell.scan().first_seq == -1);
  for (int n = 6; n <= 9; ++n) cell.frame(n);
  CHECK(cell.scan().first_seq == 6);
  CHECK(cell.scan().last_seq == 9);
  CHECK(cell.scan().images == 4);
  cell.stop(12, 1001);  // frame 10 is being exposed, its end is not within
  CHECK_FALSE(cell.owner.laser_wanted());
  CHECK(cell.state().phase == Phase::kScanning);
  CHECK(cell.frame(10).scan_id == 0);
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.members == std::vector<std::int64_t>{6, 7, 8, 9});
  CHECK(cell.indices == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(cell.state().command_id == 12);
  CHECK(cell.scan().end_utime == Cell::at(1001));
  CHECK(cell.scan().end_reason == "stop");
  CHECK(cell.scan().last_seq == 9);
  CHECK(cell.scan().lost == 0);
}

TEST_CASE("scan: ended is told at once where no further frame can be exposed in time") {
  Cell cell;
  cell.start(1, 50);
  cell.frame(1);
  cell.stop(2, 195);  // frame 2 cannot have begun before 195 and ended by 195 ms
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().last_seq == 1);
}

TEST_CASE("scan: ended is not told while its last frame is on its way") {
  Cell cell;
  cell.start(1, 50);
  cell.frame(1);
  cell.frame(2);
  cell.stop(2, 310);  // frame 3, exposed from 300 to 304 ms, has not come yet
  CHECK(cell.state().phase == Phase::kScanning);
  CHECK_FALSE(cell.owner.laser_wanted());
  CHECK(cell.scan().end_utime == 0);
  CHECK(cell.scan().end_reason == "");
  CHECK(cell.state().command_id == 1);
  const auto told = cell.owner.revision();

  SECTION("it comes") {
    CHECK(cell.frame(3).scan_index == 2);
    CHECK(cell.state().phase == Phase::kEnded);
    CHECK(cell.scan().last_seq == 3);
    CHECK(cell.scan().lost == 0);
  }
  SECTION("it is lost: the one after it tells, and it is counted") {
    CHECK(cell.frame(4).scan_id == 0);
    CHECK(cell.state().phase == Phase::kEnded);
    CHECK(cell.scan().last_seq == 2);
    CHECK(cell.scan().lost == 1);
  }
  SECTION("two are lost, one of them after the end") {
    cell.frame(5);
    CHECK(cell.state().phase == Phase::kEnded);
    CHECK(cell.scan().lost == 1);
  }
  SECTION("nothing more comes: after the longest delay") {
    cell.owner.set_longest_delay(500 * ms);
    cell.owner.tick(Cell::at(809));
    CHECK(cell.state().phase == Phase::kScanning);
    cell.owner.tick(Cell::at(811));
    CHECK(cell.state().phase == Phase::kEnded);
    CHECK(cell.scan().last_seq == 2);
    CHECK(cell.frame(3).scan_id == 0);  // too late to belong
    CHECK(cell.scan().last_seq == 2);
  }
  SECTION("a second stop is refused, a start too") {
    cell.stop(3, 320);
    CHECK(cell.state().refused_command_id == 3);
    CHECK(cell.state().refusal == "the scan has ended already");
    cell.start(4, 330);
    CHECK(cell.state().refused_command_id == 4);
    CHECK(cell.state().refusal.find("a scan is running") == 0);
    cell.frame(3);
  }
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.owner.revision() > told);
  CHECK(cell.scan().end_utime == Cell::at(310));
  CHECK(cell.scan().end_reason == "stop");
  CHECK(cell.state().command_id == 2);
}

TEST_CASE("scan: without a known period the next frame decides") {
  Cell cell;
  cell.owner.set_shortest_period(0);
  cell.start(1, 50);
  cell.frame(1);
  cell.stop(2, 110);
  CHECK(cell.state().phase == Phase::kScanning);
  CHECK(cell.frame(2).scan_id == 0);
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().last_seq == 1);
}

TEST_CASE("scan: every stop time gives exactly the frames exposed before it") {
  for (std::int64_t stop = 60; stop <= 900; stop += 1) {
    for (const std::int64_t latency : {5, 40, 99}) {
      Cell cell;
      cell.start(1, 50);
      std::int64_t n = 1;
      for (; n * 100 + latency <= stop; ++n) cell.frame(n);
      cell.stop(2, stop);
      for (; n <= 12 && cell.owner.scanning(); ++n) cell.frame(n);
      // The last n with 100 n + 4 <= stop.
      const std::int64_t last = (stop - 4) / 100;
      INFO("stop at " << stop << " ms, latency " << latency << " ms");
      REQUIRE(cell.state().phase == Phase::kEnded);
      REQUIRE(static_cast<std::int64_t>(cell.members.size()) == last);
      REQUIRE(cell.scan().last_seq == (last == 0 ? -1 : last));
      REQUIRE(cell.scan().images == last);
      REQUIRE(cell.scan().lost == 0);
    }
  }
}

TEST_CASE("scan: the longest duration ends it, told by a tick or by the frames") {
  Cell cell;
  cell.start(1, 50, 0.5);
  for (int n = 1; n <= 4; ++n) cell.frame(n);
  SECTION("by a tick") {
    cell.owner.tick(Cell::at(549));
    CHECK(cell.owner.laser_wanted());
    cell.owner.tick(Cell::at(570));
    CHECK_FALSE(cell.owner.laser_wanted());
    CHECK(cell.frame(5).scan_index == 4);
  }
  SECTION("by the first frame after it") {
    cell.frame(5);
    CHECK(cell.owner.laser_wanted());
    CHECK(cell.frame(6).scan_id == 0);
  }
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.members == std::vector<std::int64_t>{1, 2, 3, 4, 5});
  CHECK(cell.scan().end_utime == Cell::at(550));
  CHECK(cell.scan().end_reason == "longest duration");
  CHECK(cell.state().command_id == 1);
  cell.stop(2, 700);
  CHECK(cell.state().refused_command_id == 2);
  CHECK(cell.state().refusal == "no scan is running");
}

TEST_CASE("scan: a stop after the longest duration has passed does not prolong it") {
  Cell cell;
  cell.start(1, 50, 0.5);
  cell.frame(1);
  cell.stop(2, 900);
  CHECK(cell.scan().end_reason == "");
  cell.frame(9);
  CHECK(cell.scan().end_reason == "longest duration");
  CHECK(cell.scan().end_utime == Cell::at(550));
  CHECK(cell.state().refused_command_id == 2);
  CHECK(cell.scan().lost == 4);  // frames 2 to 5
}

TEST_CASE("scan: the setting's limit holds whatever the command says") {
  Cell cell(ScanOwnerSettings{0.3, false, {}});
  cell.start(1, 0, 3600);
  cell.owner.tick(Cell::at(301));
  CHECK_FALSE(cell.owner.laser_wanted());
}

TEST_CASE("scan: repeated commands change nothing") {
  Cell cell;
  for (int i = 0; i < 5; ++i) cell.start(1, 50 + i * 200);
  CHECK(cell.scan().scan_id == Cell::at(50));
  const auto revision = cell.owner.revision();
  CHECK(revision == 1);
  cell.frame(11);
  for (int i = 0; i < 5; ++i) cell.stop(2, 1150 + i * 200);
  CHECK(cell.scan().end_utime == Cell::at(1150));
  for (int i = 0; i < 5; ++i) cell.start(1, 3000 + i * 200);  // late copies of the first
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.state().refused_command_id == 0);
  CHECK(cell.owner.revision() == 2);

  cell.stop(7, 5000);
  cell.start(8, 5100);
  cell.stop(7, 5200);  // refused once, it does not stop the next scan
  CHECK(cell.owner.laser_wanted());
  CHECK(cell.state().refused_command_id == 7);
}

TEST_CASE("scan: a start while scanning is refused and the scan goes on") {
  Cell cell;
  cell.start(1, 50);
  cell.frame(1);
  cell.start(2, 150, 5, 0);
  CHECK(cell.state().refused_command_id == 2);
  CHECK(cell.state().refusal == "a scan is running (begun by command 1): stop it first");
  CHECK(cell.scan().kind == 1);
  CHECK(cell.frame(2).scan_index == 1);
  cell.start(1, 160);
  CHECK(cell.state().command_id == 1);
}

TEST_CASE("scan: a start without a camera, or without a duration, is refused with the reason") {
  Cell cell;
  cell.owner.order({1, true, 1, 10}, Cell::at(0), "camera 10.0.0.2 is lost");
  CHECK(cell.state().phase == Phase::kIdle);
  CHECK(cell.state().refusal == "camera 10.0.0.2 is lost");
  std::int64_t id = 2;
  for (const double duration : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    cell.start(id, 10, duration);
    CHECK(cell.state().phase == Phase::kIdle);
    CHECK(cell.state().refused_command_id == id++);
  }
  CHECK(cell.state().refusal == "the longest duration must be above 0 s");
}

TEST_CASE("scan: a lost camera ends it at once") {
  Cell cell;
  cell.start(1, 50);
  cell.frame(1);
  cell.frame(2);
  const bool stopping = GENERATE(true, false);
  if (stopping) cell.stop(2, 320);
  cell.owner.camera_lost(Cell::at(900));
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().end_reason == (stopping ? "stop" : "camera lost"));
  CHECK(cell.scan().end_utime == Cell::at(stopping ? 320 : 900));
  CHECK(cell.scan().last_seq == 2);
  CHECK(cell.frame(20).scan_id == 0);
  // The camera is back, its count has gone on: the next scan knows nothing of the gap.
  cell.start(3, 2'050);
  cell.frame(21);
  cell.frame(22);
  CHECK(cell.scan().lost == 0);
}

TEST_CASE("scan: lost and incomplete frames are counted") {
  Cell cell;
  cell.frame(2, false);
  cell.start(1, 350);  // the gap before the first member is not the scan's
  cell.frame(5);
  cell.frame(6, true, false);  // incomplete: it is sent, without bytes
  cell.frame(9);               // 7 and 8 never came
  CHECK(cell.scan().images == 3);
  CHECK(cell.scan().lost == 3);
  CHECK(cell.indices == std::vector<std::int32_t>{0, 1, 2});
}

TEST_CASE("scan: two in a row, the first is remembered") {
  Cell cell;
  cell.start(1, 50, 60, 0);
  for (int n = 1; n <= 3; ++n) cell.frame(n);
  cell.stop(2, 310);
  const Scan first = cell.scan();
  CHECK(cell.state().previous.scan_id == 0);
  cell.start(3, 311);
  CHECK(cell.state().previous.scan_id == first.scan_id);
  CHECK(cell.state().previous.kind == 0);
  CHECK(cell.state().previous.end_utime == Cell::at(310));
  CHECK(cell.state().previous.last_seq == 3);
  CHECK(cell.state().previous.images == 3);
  CHECK(cell.scan().images == 0);
  CHECK(cell.scan().first_seq == -1);
  CHECK(cell.scan().end_utime == 0);
  CHECK(cell.frame(4).scan_index == 0);
  // At the same microsecond as the end: still another scan.
  cell.stop(4, 410);
  cell.start(5, 410);
  CHECK(cell.scan().scan_id > cell.state().previous.end_utime);
}

TEST_CASE("scan: without a single frame") {
  Cell cell;
  cell.start(1, 50);
  cell.stop(2, 60);
  CHECK(cell.state().phase == Phase::kScanning);  // one could still come
  cell.owner.tick(Cell::at(10'000));
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().first_seq == -1);
  CHECK(cell.scan().last_seq == -1);
  CHECK(cell.scan().images == 0);
}

TEST_CASE("scan: ends when the tool has moved and then stood") {
  Cell cell(ScanOwnerSettings{120, true, {}});
  cell.start(1, 50);
  const auto still = Eigen::Quaterniond::Identity();
  std::int64_t t = 60;
  const auto stand = [&](double x, std::int64_t until) {
    for (; t < until; t += 20) cell.owner.position(Cell::at(t), {x, 0, 0}, still);
  };
  stand(0, 1'500);  // standing before the search begins ends nothing
  CHECK(cell.owner.laser_wanted());
  for (double x = 0; x < 20; x += 1, t += 20) cell.owner.position(Cell::at(t), {x, 0, 0}, still);
  const std::int64_t stopped = t;
  stand(20, stopped + 490);
  CHECK(cell.owner.laser_wanted());
  stand(20, stopped + 520);
  CHECK_FALSE(cell.owner.laser_wanted());
  cell.frame(100);
  CHECK(cell.scan().end_reason == "tool stood still");
  CHECK(cell.scan().end_utime == Cell::at(stopped + 500));
}

TEST_CASE("scan: positions from before it, or where it is not so configured, end nothing") {
  const bool configured = GENERATE(true, false);
  Cell cell(ScanOwnerSettings{120, configured, {}});
  cell.start(1, 5'000);
  for (std::int64_t t = 0; t < 9'000; t += 20)
    cell.owner.position(Cell::at(t), {t < 3'000 ? static_cast<double>(t) : 3'000, 0, 0},
                        Eigen::Quaterniond::Identity());
  CHECK(cell.owner.laser_wanted());
}

TEST_CASE("scan: frames that were given to it lie within it") {
  Cell cell(ScanOwnerSettings{120, true, {}});
  cell.start(1, 50);
  const auto still = Eigen::Quaterniond::Identity();
  cell.owner.position(Cell::at(100), {0, 0, 0}, still);
  for (std::int64_t t = 120; t <= 600; t += 20) cell.owner.position(Cell::at(t), {5, 0, 0}, still);
  for (int n = 1; n <= 7; ++n) cell.frame(n);
  // The position comes late: it says that the end was before frame 7.
  cell.owner.position(Cell::at(625), {5, 0, 0}, still);
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().last_seq == 7);
  CHECK(cell.scan().end_utime == Cell::at(704));
}
