#include "services/robot_pose/robot_pose_app.hpp"

#include <catch2/catch.hpp>
#include <deque>
#include <thread>

#include "common/time.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;

namespace {

// Gives out what the test puts in.
struct ScriptedSource : PoseSource {
  std::deque<ReportedPosition>& script;
  PoseSourceCounts& numbers;
  std::string& error;
  ScriptedSource(std::deque<ReportedPosition>& s, PoseSourceCounts& n, std::string& e)
      : script(s), numbers(n), error(e) {}
  void start() override {}
  std::optional<ReportedPosition> poll() override {
    if (script.empty()) return std::nullopt;
    auto next = script.front();
    script.pop_front();
    return next;
  }
  PoseSourceCounts counts() const override { return numbers; }
  std::string last_error() const override { return error; }
  std::string description() const override { return "a script"; }
  std::string why_silent() const override { return "it has ended"; }
};

struct Cell {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  std::deque<ReportedPosition> script;
  PoseSourceCounts counts;
  std::string error;
  std::vector<robot_pose_t> poses;
  std::unique_ptr<RobotPoseApp> app;

  explicit Cell(double silence_s = 1) {
    bus->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(),
                                 [this](const robot_pose_t& m) { poses.push_back(m); });
    RobotPoseSettings settings;
    settings.silence_s = silence_s;
    app = std::make_unique<RobotPoseApp>(*bus, settings, Instance{}, 77,
                                         std::make_unique<ScriptedSource>(script, counts, error));
  }
  void step() {
    app->tick(0);
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
  }
  void report(std::int64_t seq, std::int64_t clock, std::int64_t arrival) {
    ReportedPosition position;
    position.seq = seq;
    position.device_clock = clock;
    position.arrival_utime = arrival;
    position.clock_begins = script.empty() && poses.empty();
    script.push_back(position);
  }
  void publish_scan(std::int8_t state) {
    scan_t scan{};
    scan.utime = scan.run_id = 1;
    scan.state = state;
    scan.end_cause = state == scan_t::ENDED ? scan_t::STOP : scan_t::NONE;
    bus->publish("LASER0_SCAN", scan);
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
  }
};

constexpr std::int64_t kStart = 1'700'000'000'000'000;

}  // namespace

TEST_CASE(
    "robot_pose: a clock's question is answered with this host's stamps, another robot's is not") {
  Cell cell;
  std::vector<clock_probe_t> heard;
  cell.bus->subscribe<clock_probe_t>("CLOCK_PROBE", Queue::measurements(),
                                     [&](const clock_probe_t& m) { heard.push_back(m); });
  clock_probe_t question{};
  question.robot = "ROBOT0";
  question.asker_run_id = 5;
  question.seq = 9;
  question.asked_utime = 4711;
  const std::int64_t before = utime_now();
  cell.bus->publish("CLOCK_PROBE", question);
  cell.step();
  REQUIRE(heard.size() == 2);  // the question, and one answer: it does not answer itself
  const clock_probe_t& answer = heard.back();
  CHECK(answer.answerer_run_id == 77);
  CHECK(answer.robot == "ROBOT0");
  CHECK(answer.asker_run_id == 5);
  CHECK(answer.seq == 9);
  CHECK(answer.asked_utime == 4711);
  CHECK(answer.heard_utime >= before);
  CHECK(answer.answered_utime >= answer.heard_utime);
  CHECK(answer.answered_utime <= utime_now());
  question.robot = "ROBOT1";
  cell.bus->publish("CLOCK_PROBE", question);
  cell.step();
  CHECK(heard.size() == 3);
}

TEST_CASE("robot_pose: one message a position, every field carried over") {
  Cell cell;
  ReportedPosition position;
  position.seq = 41;
  position.position = {1, 2, 3};
  position.rotation = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  position.source = RobotProtocol::kRtde;
  position.tool_frame = 3;
  position.joints = {0.1, 0.2};
  position.device_clock = 500;
  position.device_tick_us = 2000;
  position.arrival_utime = kStart;
  position.clock_begins = true;
  cell.script = {position};
  cell.step();
  cell.step();
  REQUIRE(cell.poses.size() == 1);
  const robot_pose_t& pose = cell.poses[0];
  CHECK(pose.utime == kStart);
  CHECK(pose.run_id == 77);
  CHECK(pose.seq == 41);
  CHECK(pose.position[2] == 3);
  CHECK(pose.quaternion[0] == 0.5);
  CHECK(pose.quaternion[2] == -0.5);
  CHECK(pose.source == robot_pose_t::RTDE);
  CHECK(pose.tool_frame == 3);
  CHECK(pose.user_frame == -1);
  CHECK(pose.joint_count == 2);
  CHECK(pose.joints == std::vector<double>{0.1, 0.2});
  CHECK(pose.device_clock == 500);
  CHECK(pose.device_tick_us == 2000);
  CHECK(pose.arrival_utime == kStart);
  CHECK(pose.invalid == "");
}

TEST_CASE("robot_pose: utime is the mapped device clock, ticks included") {
  Cell cell;
  cell.report(1, 100, kStart);
  cell.report(2, 110, kStart + 25'000);  // 5 ms late
  cell.report(3, 120, kStart + 40'000);
  for (auto& position : cell.script) position.device_tick_us = 2000;
  cell.step();
  REQUIRE(cell.poses.size() == 3);
  CHECK(cell.poses[1].utime == kStart + 20'000);
  CHECK(cell.poses[2].utime == kStart + 40'000);
}

TEST_CASE("robot_pose: the clock's mapping stands still in a scan, not in a dead one") {
  Cell cell;
  cell.report(1, 0, kStart + 3'000);
  cell.step();
  cell.publish_scan(scan_t::SCANNING);
  cell.report(2, 20'000, kStart + 20'000);  // 3 ms earlier than any before
  cell.step();
  CHECK(cell.poses[1].utime == kStart + 23'000);
  SECTION("until the scan has ended") {
    cell.publish_scan(scan_t::ENDED);
    cell.report(3, 40'000, kStart + 40'500);
    cell.step();
    CHECK(cell.poses[2].utime == kStart + 40'000);
  }
  SECTION("until nothing is heard of it any more") {
    std::this_thread::sleep_for(std::chrono::milliseconds(2'100));
    cell.report(3, 40'000, kStart + 40'500);
    cell.step();
    CHECK(cell.poses[2].utime == kStart + 40'000);
  }
}

TEST_CASE("robot_pose: invalid positions go out with their reason and do not touch the clock") {
  Cell cell;
  cell.report(1, 0, kStart);
  cell.report(2, 900'000, kStart + 10'000);
  cell.script.back().invalid = "the controller's clock jumped ahead";
  cell.report(3, 20'000, kStart + 20'000);
  cell.step();
  REQUIRE(cell.poses.size() == 3);
  CHECK(cell.poses[1].invalid == "the controller's clock jumped ahead");
  CHECK(cell.poses[1].utime == kStart + 10'000);
  CHECK(cell.poses[2].utime == kStart + 20'000);
  CHECK(cell.poses[2].invalid == "");
}

TEST_CASE("robot_pose: a new clock of the controller is mapped anew, times go on rising") {
  Cell cell;
  for (int i = 0; i < 50; ++i) cell.report(i + 1, 7'000'000 + i * 20'000, kStart + i * 20'000);
  for (int i = 0; i < 50; ++i) {
    cell.report(100 + i, i * 20'000, kStart + 3'000'000 + i * 20'000);
    if (i == 0) cell.script.back().clock_begins = true;
  }
  cell.step();
  REQUIRE(cell.poses.size() == 100);
  for (std::size_t i = 1; i < 100; ++i) CHECK(cell.poses[i].utime > cell.poses[i - 1].utime);
  CHECK(cell.poses[99].utime == kStart + 3'000'000 + 49 * 20'000);
}

TEST_CASE("robot_pose: a host clock that is set back makes positions invalid, not late") {
  Cell cell;
  for (int i = 0; i < 50; ++i) cell.report(i + 1, i * 20'000, kStart + i * 20'000);
  for (int i = 50; i < 55; ++i) cell.report(i + 1, i * 20'000, kStart - 2'000'000 + i * 20'000);
  cell.step();
  REQUIRE(cell.poses.size() == 55);
  CHECK(cell.poses[49].invalid == "");
  CHECK(cell.poses[50].invalid.find("set back") != std::string::npos);
  for (std::size_t i = 1; i < 55; ++i) CHECK(cell.poses[i].utime > cell.poses[i - 1].utime);
}

TEST_CASE("robot_pose: health") {
  Cell cell(0.05);
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  cell.step();
  CHECK(cell.app->health().state == service_status_t::STARTING);

  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  cell.step();
  CHECK(cell.app->health().state == service_status_t::FAULT);
  CHECK(cell.app->health().last_error.find("no position from the robot for 0.05 s (a script): "
                                           "it has ended") == 0);

  cell.report(1, 0, kStart);
  cell.step();
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  CHECK(cell.app->health().last_error == "");

  cell.counts.malformed = 2;
  cell.counts.lost = 3;
  cell.error = "HSPO packet of 47 bytes is cut short";
  cell.report(2, 20'000, kStart + 20'000);
  cell.step();
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK(cell.app->health().last_error == "HSPO packet of 47 bytes is cut short");
  CHECK(cell.app->health().lost == 3);
  CHECK(cell.app->health().undecodable == 2);

  // Rubbish alone is no position.
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  cell.counts.malformed = 9;
  cell.step();
  CHECK(cell.app->health().state == service_status_t::FAULT);
  CHECK(cell.app->health().last_error.find("47 bytes") != std::string::npos);
}
