// What breaks in a running cell: killed processes, lost packets, repeated commands, devices that
// go. Never a wrong seam.
#include <catch2/catch.hpp>
#include <csignal>

#include "services/command_line/output/seam_error.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;
using namespace arcstart::command_line;

namespace {

constexpr double kHeartbeat = 3;  // s: the longest that a camera keeps a client that is gone

constexpr double kAnswered = 15;  // s: to a command, however busy the machine is
// Twice as fast as the others: what goes wrong here does so whatever lies between stripes.
const std::vector<std::string> kFast = {"cell_simulator.search_speed_mm_s: 100"};

// Starts a scan and returns when it has run for so long; its id, 0 where it did not start.
std::int64_t begin_scan(RunningCell& cell, double seconds) {
  const std::int64_t scan_id = cell.begin_scan(scan_t::WORKPIECE);
  if (scan_id != 0) cell.listen(seconds);
  return scan_id;
}

}  // namespace

TEST_CASE(
    "a process killed in the middle of a scan: refused or flagged, and the next scan is right") {
  RunningCell cell("killed", kFast);
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  ARCSTART_REQUIRE_OF(cell, cell.scan(scan_t::BACKGROUND));
  ARCSTART_REQUIRE_OF(cell, cell.change_scene(true, 21));
  for (const std::string service : {"extraction", "reconstruction", "seam_finding", "robot_pose",
                                    "calibration", "sensor_capture"}) {
    INFO(service);
    const std::int64_t scan_id = begin_scan(cell, 1.5);
    ARCSTART_REQUIRE_OF(cell, scan_id != 0);
    cell.kill_9(service);
    if (service == "sensor_capture") {
      // The laser follows the camera's exposures, which end with its client.
      CHECK(cell.listen_until([&] { return cell.heard().truth && !cell.heard().truth->laser_on; },
                              kHeartbeat + 1.5));
    }
    cell.start(service);
    cell.listen_until([&] { return cell.seam_of(scan_id).has_value(); },
                      service == "seam_finding" ? 12 : 60);
    if (const auto seam = cell.seam_of(scan_id)) {
      WARN(service << ": " << static_cast<int>(seam->verdict) << " " << seam->reason
                   << seam->remark);
      if (seam->verdict == seam_t::FOUND) {
        CHECK_FALSE(seam_error(*seam, *cell.heard().truth).wrong);
        if (service != "calibration") CHECK_FALSE(seam->remark.empty());
      } else {
        CHECK_FALSE(seam->reason.empty());
      }
    } else {
      WARN(service << ": no answer to the scan");
      CHECK(service == "seam_finding");
    }
    ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
    CHECK(cell.finds_right_seam());
  }
}

TEST_CASE("late starters learn the state, and answers survive a restart") {
  RunningCell cell("late", kFast);
  for (const std::string service : {"cell_simulator", "robot_pose", "sensor_capture"})
    cell.start(service);
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  for (const std::string service :
       {"seam_finding", "reconstruction", "extraction", "calibration"}) {
    cell.start(service);
    cell.listen(0.5);
  }
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  ARCSTART_REQUIRE_OF(cell, cell.scan(scan_t::BACKGROUND));
  cell.terminate("seam_finding");
  cell.start("seam_finding");  // finds the background again
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  ARCSTART_REQUIRE_OF(cell, cell.change_scene(true, 22));
  ARCSTART_REQUIRE_OF(cell, cell.finds_right_seam());
  REQUIRE_FALSE(cell.heard().seam_bytes.empty());
  // A restarted seam_finding repeats its last answer and gives no other to that scan.
  const auto bytes = cell.heard().seam_bytes.back();
  cell.kill_9("seam_finding");
  cell.forget();
  cell.start("seam_finding");
  CHECK(cell.listen_until([&] { return !cell.heard().seam_bytes.empty(); }, kAnswered));
  cell.listen(2);
  ARCSTART_REQUIRE_OF(cell, cell.heard().seam_bytes.size() == 1);
  CHECK(cell.heard().seam_bytes.front() == bytes);
}

TEST_CASE("commands repeated, refused and lost end as the design says") {
  RunningCell cell("commands");
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  const auto scan = [&]() -> const scan_t& { return *cell.heard().scan; };

  scan_command_t start{};
  start.utime = start.command_id = 4711;
  start.action = scan_command_t::START;
  start.kind = scan_t::BACKGROUND;
  start.longest_duration = 2;
  for (int i = 0; i < 5; ++i) cell.bus().publish("LASER0_SCAN_COMMAND", start);
  REQUIRE(cell.listen_until([&] { return scan().command_id == 4711; }, kAnswered));
  const std::int64_t first = scan().scan_id;
  CHECK(scan().state == scan_t::SCANNING);

  // Another start while it runs is refused, and changes nothing.
  const std::int64_t other = cell.command(scan_command_t::START, scan_t::WORKPIECE);
  CHECK(cell.listen_until([&] { return scan().refused_command_id == other; }, kAnswered));
  CHECK_FALSE(scan().refusal.empty());
  CHECK(scan().scan_id == first);

  // No stop comes: the scan ends by its longest duration.
  REQUIRE(cell.listen_until([&] { return scan().state == scan_t::ENDED; }, kAnswered));
  CHECK(scan().scan_id == first);
  CHECK(scan().end_utime - scan().begin_utime < 3'000'000);
  cell.bus().publish("LASER0_SCAN_COMMAND", start);  // the old id starts nothing
  cell.listen(0.5);
  CHECK(scan().scan_id == first);
  CHECK(scan().state == scan_t::ENDED);

  // A second scan right after the first, stopped by command.
  const std::int64_t second_id = cell.command(scan_command_t::START, scan_t::BACKGROUND);
  REQUIRE(cell.listen_until([&] { return scan().command_id == second_id; }, kAnswered));
  CHECK(scan().previous_scan_id == first);
  cell.listen(1);
  const std::int64_t stop_id = cell.command(scan_command_t::STOP, scan_t::BACKGROUND);
  CHECK(cell.listen_until([&] { return scan().state == scan_t::ENDED; }, kAnswered));
  CHECK(scan().command_id == stop_id);
  CHECK(cell.listen_until([&] { return cell.seam_of(scan().scan_id).has_value(); }, kAnswered));
  // A stop of nothing is refused.
  const std::int64_t nothing = cell.command(scan_command_t::STOP, scan_t::BACKGROUND);
  CHECK(cell.listen_until([&] { return scan().refused_command_id == nothing; }, kAnswered));
}

TEST_CASE("a robot that falls silent and a camera that goes: told, survived, never a wrong seam") {
  RunningCell robot("robot_silent",
                    {"cell_simulator.fault_scan: 2", "cell_simulator.fault_after_s: 2",
                     "cell_simulator.fault_robot_silent_s: 2"});
  robot.start_all();
  ARCSTART_REQUIRE_OF(robot, robot.wait_until_ready());
  ARCSTART_REQUIRE_OF(robot, robot.scan(scan_t::BACKGROUND));
  ARCSTART_REQUIRE_OF(robot, robot.change_scene(true, 23));
  bool told = false;
  const std::int64_t scan_id = begin_scan(robot, 0);
  ARCSTART_REQUIRE_OF(robot, scan_id != 0);
  robot.listen_until(
      [&] {
        told = told || robot.status("robot_pose").state == service_status_t::FAULT;
        return robot.seam_of(scan_id).has_value();
      },
      60);
  ARCSTART_REQUIRE_OF(robot, told);  // two seconds of silence, a status a second
  CHECK_THAT(robot.log_of("robot_pose"), Catch::Contains("warning") || Catch::Contains("error"));
  ARCSTART_REQUIRE_OF(robot, robot.seam_of(scan_id));
  WARN(robot.seam_of(scan_id)->reason << robot.seam_of(scan_id)->remark);
  if (robot.seam_of(scan_id)->verdict == seam_t::FOUND)
    CHECK_FALSE(seam_error(*robot.seam_of(scan_id), *robot.heard().truth).wrong);
  ARCSTART_REQUIRE_OF(robot, robot.wait_until_ready());
  CHECK(robot.finds_right_seam());
}

TEST_CASE("a camera lost in a scan ends it; it is found again") {
  RunningCell cell("camera_lost",
                   {"cell_simulator.fault_scan: 2", "cell_simulator.fault_after_s: 2",
                    "cell_simulator.fault_camera_away_s: 4"});
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  ARCSTART_REQUIRE_OF(cell, cell.scan(scan_t::BACKGROUND));
  ARCSTART_REQUIRE_OF(cell, cell.change_scene(true, 24));
  bool told = false;
  const std::int64_t scan_id = begin_scan(cell, 0);
  ARCSTART_REQUIRE_OF(cell, scan_id != 0);
  cell.listen_until(
      [&] {
        told = told || cell.status("sensor_capture").state == service_status_t::FAULT;
        return told && cell.seam_of(scan_id).has_value();
      },
      60);
  ARCSTART_REQUIRE_OF(cell, told);
  ARCSTART_REQUIRE_OF(cell, cell.seam_of(scan_id));
  WARN(cell.heard().scan->end_reason << "; " << cell.seam_of(scan_id)->reason
                                     << cell.seam_of(scan_id)->remark);
  if (cell.seam_of(scan_id)->verdict == seam_t::FOUND)
    CHECK_FALSE(seam_error(*cell.seam_of(scan_id), *cell.heard().truth).wrong);
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  CHECK(cell.finds_right_seam());
}

TEST_CASE("position stamps that go back are dropped or refused, never believed") {
  RunningCell cell("stamps_back",
                   {"cell_simulator.fault_scan: 2", "cell_simulator.fault_after_s: 2",
                    "cell_simulator.fault_robot_clock_back_s: 0.5"});
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  ARCSTART_REQUIRE_OF(cell, cell.scan(scan_t::BACKGROUND));
  ARCSTART_REQUIRE_OF(cell, cell.change_scene(true, 25));
  const auto seam = cell.scan(scan_t::WORKPIECE);
  ARCSTART_REQUIRE_OF(cell, seam);
  WARN(seam->reason << seam->remark);
  if (seam->verdict == seam_t::FOUND) CHECK_FALSE(seam_error(*seam, *cell.heard().truth).wrong);
  CHECK(cell.finds_right_seam());
}

TEST_CASE("a camera that is absent, a configuration that is wrong: one clear line") {
  {  // ended before the others, which else find it on their host
    RunningCell cell("absent");
    cell.start("sensor_capture");
    CHECK(cell.listen_until(
        [&] { return cell.status("sensor_capture").state == service_status_t::FAULT; }, kAnswered));
    CHECK(cell.process("sensor_capture").is_running());
    WARN(cell.status("sensor_capture").last_error);
    CHECK_THAT(cell.status("sensor_capture").last_error, Catch::Contains("camera"));
  }

  for (const char* service : {"sensor-capture", "robot-pose", "extraction", "reconstruction",
                              "seam-finding", "calibration", "cell-simulator"}) {
    std::string section = service;
    for (char& character : section) character = character == '-' ? '_' : character;
    RunningCell wrong("wrong_" + section, {section + ".no_such_key: 1"});
    const Output output = run({program(std::string("arcstart-") + service), "--cell",
                               wrong.cell_file(), "--state", wrong.folder() + "/state"});
    CHECK(output.code == 2);
    CHECK_THAT(output.err, Catch::Contains("cell.yaml:") &&
                               Catch::Contains(section + ".no_such_key: unknown key"));
    CHECK(std::count(output.err.begin(), output.err.end(), '\n') == 1);
  }
}
