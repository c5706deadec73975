// Which commands a scan obeys, and what else ends it.
#include <catch2/catch.hpp>
#include <limits>

#include "services/sensor_capture/scan/scan_owner.hpp"
#include "tests/sensor_capture/support/ideal_cell.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;
using namespace arcstart::test;
using Phase = ScanState::Phase;

TEST_CASE("scan: repeated commands change nothing") {
  IdealCell cell;
  for (int i = 0; i < 5; ++i) cell.start(1, 50 + i * 200);
  CHECK(cell.scan().scan_id == IdealCell::at(50));
  const auto revision = cell.owner.revision();
  CHECK(revision == 1);
  cell.frame(11);
  for (int i = 0; i < 5; ++i) cell.stop(2, 1150 + i * 200);
  CHECK(cell.scan().end_utime == IdealCell::at(1150));
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
  IdealCell cell;
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
  IdealCell cell;
  cell.owner.order({1, true, 1, 10}, IdealCell::at(0), "camera 10.0.0.2 is lost");
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
  IdealCell cell;
  cell.start(1, 50);
  cell.frame(1);
  cell.frame(2);
  const bool stopping = GENERATE(true, false);
  if (stopping) cell.stop(2, 320);
  cell.owner.camera_lost(IdealCell::at(900));
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().end_cause == (stopping ? EndCause::kStop : EndCause::kCameraLost));
  CHECK(cell.scan().end_utime == IdealCell::at(stopping ? 320 : 900));
  CHECK(cell.scan().last_seq == 2);
  CHECK(cell.frame(20).scan_id == 0);
  // The camera is back, its count has gone on: the next scan knows nothing of the gap.
  cell.start(3, 2'050);
  cell.frame(21);
  cell.frame(22);
  CHECK(cell.scan().lost == 0);
}

TEST_CASE("scan: lost and incomplete frames are counted") {
  IdealCell cell;
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
  IdealCell cell;
  cell.start(1, 50, 60, 0);
  for (int n = 1; n <= 3; ++n) cell.frame(n);
  cell.stop(2, 310);
  const Scan first = cell.scan();
  CHECK(cell.state().previous.scan_id == 0);
  cell.start(3, 311);
  CHECK(cell.state().previous.scan_id == first.scan_id);
  CHECK(cell.state().previous.kind == 0);
  CHECK(cell.state().previous.end_utime == IdealCell::at(310));
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
  IdealCell cell;
  cell.start(1, 50);
  cell.stop(2, 60);
  CHECK(cell.state().phase == Phase::kScanning);  // one could still come
  cell.owner.tick(IdealCell::at(10'000));
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().first_seq == -1);
  CHECK(cell.scan().last_seq == -1);
  CHECK(cell.scan().images == 0);
}

TEST_CASE("scan: ends when the tool has moved and then stood") {
  IdealCell cell(ScanOwnerSettings{120, true, {}});
  cell.start(1, 50);
  const auto still = Eigen::Quaterniond::Identity();
  std::int64_t t = 60;
  const auto stand = [&](double x, std::int64_t until) {
    for (; t < until; t += 20) cell.owner.position(IdealCell::at(t), {x, 0, 0}, still);
  };
  stand(0, 1'500);  // standing before the search begins ends nothing
  CHECK(cell.owner.laser_wanted());
  for (double x = 0; x < 20; x += 1, t += 20)
    cell.owner.position(IdealCell::at(t), {x, 0, 0}, still);
  const std::int64_t stopped = t;
  stand(20, stopped + 490);
  CHECK(cell.owner.laser_wanted());
  stand(20, stopped + 520);
  CHECK_FALSE(cell.owner.laser_wanted());
  cell.frame(100);
  CHECK(cell.scan().end_cause == EndCause::kStandstill);
  CHECK(cell.scan().end_utime == IdealCell::at(stopped + 500));
}

TEST_CASE("scan: positions from before it, or where it is not so configured, end nothing") {
  const bool configured = GENERATE(true, false);
  IdealCell cell(ScanOwnerSettings{120, configured, {}});
  cell.start(1, 5'000);
  for (std::int64_t t = 0; t < 9'000; t += 20)
    cell.owner.position(IdealCell::at(t), {t < 3'000 ? static_cast<double>(t) : 3'000, 0, 0},
                        Eigen::Quaterniond::Identity());
  CHECK(cell.owner.laser_wanted());
}

TEST_CASE("scan: frames that were given to it lie within it") {
  IdealCell cell(ScanOwnerSettings{120, true, {}});
  cell.start(1, 50);
  const auto still = Eigen::Quaterniond::Identity();
  cell.owner.position(IdealCell::at(100), {0, 0, 0}, still);
  for (std::int64_t t = 120; t <= 600; t += 20)
    cell.owner.position(IdealCell::at(t), {5, 0, 0}, still);
  for (int n = 1; n <= 7; ++n) cell.frame(n);
  // The position comes late: it says that the end was before frame 7.
  cell.owner.position(IdealCell::at(625), {5, 0, 0}, still);
  CHECK(cell.state().phase == Phase::kEnded);
  CHECK(cell.scan().last_seq == 7);
  CHECK(cell.scan().end_utime == IdealCell::at(704));
}
