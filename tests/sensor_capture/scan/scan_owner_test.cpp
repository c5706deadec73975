// Scans in closed form: which frames are theirs, and when they end.
#include "services/sensor_capture/scan/scan_owner.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/sensor_capture/support/ideal_cell.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;
using namespace arcstart::test;
using Phase = ScanState::Phase;

TEST_CASE("scan: idle before the first") {
  IdealCell cell;
  CHECK(cell.state().phase == Phase::kIdle);
  CHECK(cell.frame(1).scan_id == 0);
  CHECK(cell.frame(1).scan_index == -1);
  CHECK(cell.scan().scan_id == 0);
  CHECK(cell.scan().first_seq == -1);
  CHECK(cell.scan().last_seq == -1);
  CHECK_FALSE(cell.owner.laser_wanted());
}

TEST_CASE("scan: from start to stop, frames wholly within and lit") {
  IdealCell cell;
  for (int n = 1; n <= 3; ++n) cell.frame(n, false);
  cell.start(11, 401, 60, 1);  // frame 4 is being exposed
  CHECK(cell.owner.laser_wanted());
  CHECK(cell.state().phase == Phase::kScanning);
  CHECK(cell.state().command_id == 11);
  CHECK(cell.scan().scan_id == IdealCell::at(401));
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
  CHECK(cell.scan().end_utime == IdealCell::at(1001));
  CHECK(cell.scan().end_cause == EndCause::kStop);
  CHECK(cell.scan().last_seq == 9);
  CHECK(cell.scan().lost == 0);
}

TEST_CASE("scan: ended is told at once where no further frame can be exposed in time") {
  IdealCell cell;
  cell.start(1, 50);
  cell.frame(1);
  cell.stop(2, 195);  // frame 2 cannot have begun before 195 and ended by 195 ms
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().last_seq == 1);
}

TEST_CASE("scan: ended is not told while its last frame is on its way") {
  IdealCell cell;
  cell.start(1, 50);
  cell.frame(1);
  cell.frame(2);
  cell.stop(2, 310);  // frame 3, exposed from 300 to 304 ms, has not come yet
  CHECK(cell.state().phase == Phase::kScanning);
  CHECK_FALSE(cell.owner.laser_wanted());
  CHECK(cell.scan().end_utime == 0);
  CHECK(cell.scan().end_cause == EndCause::kNone);
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
    cell.owner.tick(IdealCell::at(809));
    CHECK(cell.state().phase == Phase::kScanning);
    cell.owner.tick(IdealCell::at(811));
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
  CHECK(cell.scan().end_utime == IdealCell::at(310));
  CHECK(cell.scan().end_cause == EndCause::kStop);
  CHECK(cell.state().command_id == 2);
}

TEST_CASE("scan: without a known period the next frame decides") {
  IdealCell cell;
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
      IdealCell cell;
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
  IdealCell cell;
  cell.start(1, 50, 0.5);
  for (int n = 1; n <= 4; ++n) cell.frame(n);
  SECTION("by a tick") {
    cell.owner.tick(IdealCell::at(549));
    CHECK(cell.owner.laser_wanted());
    cell.owner.tick(IdealCell::at(570));
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
  CHECK(cell.scan().end_utime == IdealCell::at(550));
  CHECK(cell.scan().end_cause == EndCause::kLongestDuration);
  CHECK(cell.state().command_id == 1);
  cell.stop(2, 700);
  CHECK(cell.state().refused_command_id == 2);
  CHECK(cell.state().refusal == "no scan is running");
}

TEST_CASE("scan: a stop after the longest duration has passed does not prolong it") {
  IdealCell cell;
  cell.start(1, 50, 0.5);
  cell.frame(1);
  cell.stop(2, 900);
  CHECK(cell.scan().end_cause == EndCause::kNone);
  cell.frame(9);
  CHECK(cell.scan().end_cause == EndCause::kLongestDuration);
  CHECK(cell.scan().end_utime == IdealCell::at(550));
  CHECK(cell.state().refused_command_id == 2);
  CHECK(cell.scan().lost == 4);  // frames 2 to 5
}

TEST_CASE("scan: what whoever asked said of it stays with it, and with no other") {
  IdealCell cell;
  cell.owner.order({1, true, 1, 60, {42, "job", "part"}}, IdealCell::at(0), "");
  cell.frame(1);
  cell.stop(2, 150);
  cell.frame(2);
  REQUIRE(cell.state().phase == Phase::kEnded);
  CHECK(cell.state().command_id == 2);
  CHECK(cell.scan().start_command_id == 1);
  CHECK(cell.scan().purpose.request == 42);
  CHECK(cell.scan().purpose.job == "job");
  CHECK(cell.scan().purpose.part == "part");
  cell.start(3, 300);
  CHECK(cell.scan().start_command_id == 3);
  CHECK(cell.scan().purpose.request == 0);
  CHECK(cell.scan().purpose.job == "");
  CHECK(cell.state().previous.first_seq == 1);
  CHECK(cell.state().previous.end_cause == EndCause::kStop);
}

TEST_CASE("scan: the setting's limit holds whatever the command says") {
  IdealCell cell(ScanOwnerSettings{0.3, false, {}});
  cell.start(1, 0, 3600);
  cell.owner.tick(IdealCell::at(301));
  CHECK_FALSE(cell.owner.laser_wanted());
}
