// How far the positions' clock is from the images', as a scan's state tells it.
#include <catch2/catch.hpp>
#include <functional>

#include "tests/sensor_capture/support/scripted_cell.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;
using namespace arcstart::test;

namespace {

// robot_pose on a host whose clock is ahead.
struct OtherHost {
  ScriptedCell& cell;
  std::int64_t ahead = 0;  // us
  std::int64_t run_id = 900;
  int questions = 0;
  std::function<void(clock_probe_t&)> spoil = [](clock_probe_t&) {};  // the answer

  explicit OtherHost(ScriptedCell& of) : cell(of) {
    cell.bus->subscribe<clock_probe_t>(
        "CLOCK_PROBE", Queue::measurements(), [this](clock_probe_t probe) {
          if (probe.answerer_run_id != 0) return;
          ++questions;
          probe.answerer_run_id = run_id;
          probe.heard_utime = probe.answered_utime = utime_now() + ahead;
          spoil(probe);
          cell.bus->publish("CLOCK_PROBE", probe);
        });
  }
  void run(double seconds) {
    for (const std::int64_t end = steady_now() + seconds_to_us(seconds); steady_now() < end;) {
      cell.step();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
};

bool holds(const scan_t& state, double seconds) {
  return std::abs(state.clock_difference - seconds) <= state.clock_bound;
}

}  // namespace

TEST_CASE("sensor_capture: without an answer the clocks' difference is not known") {
  ScriptedCell cell;
  cell.find_camera();
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.scans.back().clock_bound == -1);
  CHECK(cell.app->health().last_error.empty());
}

TEST_CASE("sensor_capture: what answers another's question says nothing of the clocks") {
  ScriptedCell cell;
  cell.find_camera();
  OtherHost other(cell);
  SECTION("of another process") {
    other.spoil = [](clock_probe_t& answer) { ++answer.asker_run_id; };
  }
  SECTION("of another robot") {
    other.spoil = [](clock_probe_t& answer) { answer.robot = "ROBOT1"; };
  }
  SECTION("the one before") {
    other.spoil = [](clock_probe_t& answer) { --answer.seq; };
  }
  SECTION("asked at another time") {
    other.spoil = [](clock_probe_t& answer) { ++answer.asked_utime; };
  }
  other.run(0.3);
  cell.scan_command(7, scan_command_t::START);
  CHECK(other.questions >= 2);
  CHECK(cell.scans.back().clock_bound == -1);
}

TEST_CASE(
    "sensor_capture: a scan's state carries the clocks' difference, also of a step within it") {
  ScriptedCell cell;
  cell.find_camera();
  OtherHost other(cell);
  other.ahead = 50'000;
  other.run(0.5);
  cell.scan_command(7, scan_command_t::START);
  CHECK(other.questions >= 2);
  CHECK(holds(cell.scans.back(), 0.05));
  CHECK(cell.scans.back().clock_bound < 0.04);  // whatever the load, some exchange was quicker
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK_THAT(cell.app->health().last_error, Catch::Contains("chrony or PTP"));
  other.ahead = 2'000'000;
  other.run(0.5);
  cell.scan_command(8, scan_command_t::STOP);
  for (int i = 0; i < 3; ++i) cell.expose();
  REQUIRE(cell.scans.back().state == scan_t::ENDED);
  CHECK(holds(cell.scans.back(), 0.05));
  CHECK(holds(cell.scans.back(), 2));
}

TEST_CASE("sensor_capture: an answer that was not asked for tells nothing") {
  ScriptedCell cell;
  cell.find_camera();
  clock_probe_t forged{};
  forged.robot = "ROBOT0";
  forged.asker_run_id = 55;
  forged.answerer_run_id = 900;
  forged.asked_utime = utime_now();
  forged.heard_utime = forged.answered_utime = utime_now() + 50'000;
  for (forged.seq = 0; forged.seq < 5; ++forged.seq) cell.bus->publish("CLOCK_PROBE", forged);
  cell.step();
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.scans.back().clock_bound == -1);
}
