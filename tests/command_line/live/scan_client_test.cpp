// The client against a double of sensor_capture and seam_finding on one bus in memory. Time is the
// test's own.
#include "services/command_line/live/scan_client.hpp"

#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <set>

#include "services/seam_finding/scan/answer_mark.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using Catch::Matchers::Contains;

namespace {

constexpr std::int64_t kStep = 50'000;                  // us
constexpr std::int64_t kUtime = 1'700'000'000'000'000;  // us, of the test's time 0
constexpr std::int64_t kScan = kUtime + 5;              // a scan's id

struct Cell {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  Instance instance;
  std::vector<scan_command_t> commands;
  std::function<void(const scan_command_t&)> on_command = [](const scan_command_t&) {};
  std::int64_t now = 1'000'000;

  Cell() {
    bus->subscribe<scan_command_t>("LASER0_SCAN_COMMAND", Queue::measurements(),
                                   [this](const scan_command_t& command) {
                                     commands.push_back(command);
                                     on_command(command);
                                   });
  }

  void tell(std::int8_t state, std::int64_t scan_id, std::int64_t command_id,
            std::int64_t run_id = 7) {
    scan_t scan{};
    scan.utime = kUtime + now;
    scan.run_id = run_id;
    scan.state = state;
    scan.scan_id = scan_id;
    scan.command_id = command_id;
    scan.begin_utime = scan_id;
    scan.end_utime = state == scan_t::ENDED ? scan.utime : 0;
    scan.end_cause = state == scan_t::ENDED ? scan_t::STOP : scan_t::NONE;
    bus->publish("LASER0_SCAN", scan);
  }
  void refuse(std::int64_t command_id, const std::string& why) {
    scan_t scan{};
    scan.utime = kUtime + now;
    scan.run_id = 7;
    scan.refused_command_id = command_id;
    scan.refusal = why;
    bus->publish("LASER0_SCAN", scan);
  }
  static seam_t seam_of(std::int64_t scan_id, std::int8_t verdict, double x = 0) {
    seam_t seam{};
    seam.start[0] = x;
    seam.scan_id = scan_id;
    seam.verdict = verdict;
    seam.refusal = verdict == seam_t::REFUSED ? seam_t::NO_WORKPIECE : 0;
    seam.reason = verdict == seam_t::FOUND ? "" : "for the test";
    seam.direction[0] = 1;
    return seam;
  }
  void send(const seam_t& seam) { bus->publish("LASER0_SEAM", seam); }
  // STATUS of a seam_finding that gave this answer.
  void name(const seam_t& seam, std::int64_t run_id = 7, int pid = 70) {
    service_status_t status{};
    status.utime = kUtime + now;
    status.host = "cell-pc";
    status.pid = pid;
    status.run_id = run_id;
    status.last_error = "the disk is slow; " + seam_finding::answer_mark(seam);
    bus->publish("LASER0_SEAM_FINDING_STATUS", status);
  }
  void answer(std::int64_t scan_id, std::int8_t verdict) {
    const seam_t seam = seam_of(scan_id, verdict);
    send(seam);
    name(seam);
  }
  void state_of(const std::string& channel, std::int8_t state, const std::string& error) {
    service_status_t status{};
    status.utime = kUtime + now;
    status.run_id = 7;
    status.state = state;
    status.last_error = error;
    bus->publish(channel, status);
  }
  void step(ScanClient& client) {
    client.tick(now, kUtime + now);
    bus->handle(std::chrono::milliseconds(0));
    now += kStep;
  }
  // Steps until done or so many seconds have passed.
  void run(ScanClient& client, double seconds) {
    const std::int64_t end = now + static_cast<std::int64_t>(seconds * 1e6);
    while (!client.is_done() && now < end) step(client);
  }
};

}  // namespace

TEST_CASE("a scan is started once, followed and answered") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {scan_t::BACKGROUND, 12, 5});
  cell.on_command = [&](const scan_command_t& command) {
    cell.tell(scan_t::SCANNING, kScan, command.command_id);
  };
  cell.run(client, 1);
  REQUIRE(cell.commands.size() == 1);
  CHECK(cell.commands[0].action == scan_command_t::START);
  CHECK(cell.commands[0].kind == scan_t::BACKGROUND);
  CHECK(cell.commands[0].longest_duration == 12);
  CHECK(cell.commands[0].command_id == client.command_id());
  CHECK(cell.commands[0].utime >= kUtime);
  CHECK_THAT(client.progress(), Contains("scanning"));

  cell.answer(kScan - 1, seam_t::FOUND);  // of the scan before, repeated until now
  cell.tell(scan_t::ENDED, kScan, client.command_id());
  cell.run(client, 1);
  CHECK_FALSE(client.is_done());
  cell.answer(kScan, seam_t::BACKGROUND_STORED);
  cell.run(client, 1);
  REQUIRE(client.is_done());
  REQUIRE(client.seam());
  CHECK(client.seam()->scan_id == kScan);
  CHECK(client.failure().empty());
}

TEST_CASE(
    "a start that is lost is sent again at 5 Hz, under the same id, until the scan shows it") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  cell.on_command = [&](const scan_command_t& command) {
    if (cell.commands.size() == 4)
      cell.tell(scan_t::SCANNING, kScan, command.command_id);
    else
      cell.tell(scan_t::IDLE, 0, 0);
  };
  cell.run(client, 3);
  REQUIRE(cell.commands.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(cell.commands[i].command_id == client.command_id());
    if (i > 0) CHECK(cell.commands[i].utime - cell.commands[i - 1].utime == 200'000);
  }
}

TEST_CASE("whoever asks has the number, the job and the part in every command") {
  Cell cell;
  ScanRequest request;
  request.number = 4711;
  request.job = "bracket";
  request.part = "K-0815";
  ScanClient client(*cell.bus, cell.instance, request);
  cell.on_command = [&](const scan_command_t& command) {
    cell.tell(scan_t::SCANNING, kScan, command.command_id);
  };
  cell.run(client, 1);
  client.stop();
  cell.run(client, 1);
  REQUIRE(cell.commands.size() > 1);  // START and STOP
  for (const scan_command_t& command : cell.commands) {
    CHECK(command.request == 4711);
    CHECK(command.job == "bracket");
    CHECK(command.part == "K-0815");
  }
}

TEST_CASE("a refused start ends with the reason") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  cell.on_command = [&](const scan_command_t& command) {
    cell.refuse(command.command_id, "a scan runs\x1b[2J already");
  };
  cell.run(client, 1);
  REQUIRE(client.is_done());
  CHECK_FALSE(client.seam());
  CHECK(client.failure() == "refused: a scan runs\\x1b[2J already");
}

TEST_CASE("the refusal of another's command is not ours") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  cell.on_command = [&](const scan_command_t&) { cell.refuse(99, "not ours"); };
  cell.run(client, 1);
  CHECK_FALSE(client.is_done());
}

TEST_CASE(
    "stop is sent under an id of its own until the scan has ended, and its answer is waited for") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  int stops = 0;
  cell.on_command = [&](const scan_command_t& command) {
    if (command.action == scan_command_t::START)
      return cell.tell(scan_t::SCANNING, kScan, command.command_id);
    CHECK(command.command_id != client.command_id());
    if (++stops == 3) cell.tell(scan_t::ENDED, kScan, command.command_id);
  };
  cell.run(client, 1);
  client.stop();
  cell.run(client, 2);
  CHECK(stops == 3);
  CHECK_FALSE(client.is_done());
  cell.answer(kScan, seam_t::FOUND);
  cell.run(client, 1);
  REQUIRE(client.seam());
  CHECK(client.seam()->verdict == seam_t::FOUND);
}

TEST_CASE("stopped before its scan began, the client ends nobody else's") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  cell.on_command = [&](const scan_command_t&) { cell.tell(scan_t::SCANNING, kScan, 99); };
  cell.run(client, 0.5);
  const auto sent = cell.commands.size();
  client.stop();
  cell.run(client, 3);
  REQUIRE(client.is_done());
  CHECK(cell.commands.size() == sent);
  CHECK_THAT(client.failure(), Contains("stopped before"));
}

TEST_CASE("a start that was on its way when the client was stopped is stopped too") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  cell.step(client);
  REQUIRE(cell.commands.size() == 1);
  client.stop();
  cell.tell(scan_t::SCANNING, kScan, client.command_id());
  cell.run(client, 0.5);
  CHECK(cell.commands.back().action == scan_command_t::STOP);
}

TEST_CASE("a SEAM that no STATUS names, and one within the scan, are no answers") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {scan_t::WORKPIECE, 30, 4});
  cell.on_command = [&](const scan_command_t& command) {
    cell.tell(scan_t::SCANNING, kScan, command.command_id);
  };
  cell.run(client, 1);
  cell.send(Cell::seam_of(kScan, seam_t::FOUND, 25));
  cell.name(Cell::seam_of(kScan - 1, seam_t::FOUND));  // of the scan before
  cell.tell(scan_t::ENDED, kScan, client.command_id());
  cell.run(client, 1);
  cell.send(Cell::seam_of(kScan, seam_t::FOUND, 26));
  cell.run(client, 1);
  CHECK_FALSE(client.is_done());
  SECTION("the true one comes") {
    cell.answer(kScan, seam_t::FOUND);
    cell.run(client, 1);
    REQUIRE(client.seam());
    CHECK(client.seam()->start[0] == 0);
    CHECK_THAT(client.stranger(), Contains("start 25.000"));
  }
  SECTION("none comes") {
    cell.run(client, 5);
    CHECK_THAT(client.failure(), Contains("no STATUS of seam_finding"));
  }
  SECTION("two come, of two seam_finding") {
    cell.answer(kScan, seam_t::REFUSED);
    cell.name(Cell::seam_of(kScan, seam_t::FOUND, 26), 8, 80);
    cell.run(client, 1);
    CHECK_THAT(client.failure(), Contains("process 70") && Contains("process 80"));
  }
}

TEST_CASE("where sensor_capture dies in the scan, its answer is taken all the same") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  cell.on_command = [&](const scan_command_t& command) {
    cell.tell(scan_t::SCANNING, kScan, command.command_id);
  };
  cell.run(client, 5);
  cell.answer(kScan, seam_t::REFUSED);
  cell.run(client, 1);
  REQUIRE(client.seam());
  CHECK(client.seam()->verdict == seam_t::REFUSED);
}

TEST_CASE("where nobody answers, what is missing is named") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {scan_t::WORKPIECE, 30, 4});
  SECTION("nothing at all is heard") {
    cell.run(client, 10);
    CHECK_THAT(client.failure(),
               Contains("LASER0_SCAN is not heard") && Contains("no service of the chain"));
  }
  SECTION("sensor_capture is missing, robot_pose is ill, extraction fell silent") {
    cell.state_of("LASER0_EXTRACTION_STATUS", service_status_t::RUNNING, "");
    cell.step(client);
    cell.now += 3'500'000;
    for (const std::string name : {"CALIBRATION", "RECONSTRUCTION", "SEAM_FINDING"})
      cell.state_of(fmt::format("LASER0_{}_STATUS", name), service_status_t::RUNNING, "");
    cell.state_of("ROBOT0_ROBOT_POSE_STATUS", service_status_t::FAULT, "robot silent for 1 s");
    cell.run(client, 10);
    CHECK_THAT(client.failure(),
               Contains("not heard (not running?): sensor_capture, extraction;") &&
                   Contains("robot_pose says: robot silent for 1 s"));
  }
  REQUIRE(client.is_done());
  CHECK_FALSE(client.seam());
  CHECK(client.failure().find('\n') == std::string::npos);
}

TEST_CASE(
    "a scan that never ends, a sensor_capture that falls silent and a seam that never comes are "
    "given up") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {scan_t::WORKPIECE, 3, 4});
  cell.on_command = [&](const scan_command_t& command) {
    cell.tell(scan_t::SCANNING, kScan, command.command_id);
  };
  cell.run(client, 1);
  SECTION("silent") {
    cell.run(client, 10);
    CHECK_THAT(client.failure(), Contains("fell silent in the scan"));
  }
  SECTION("never ends") {
    for (int i = 0; i < 200 && !client.is_done(); ++i) {
      cell.tell(scan_t::SCANNING, kScan, client.command_id());
      cell.step(client);
    }
    CHECK_THAT(client.failure(), Contains("does not end"));
  }
  SECTION("no seam") {
    cell.tell(scan_t::ENDED, kScan, client.command_id());
    cell.run(client, 10);
    CHECK_THAT(client.failure(), Contains("no LASER0_SEAM came for the scan within 4 s"));
  }
  CHECK(client.is_done());
}

TEST_CASE("a sensor_capture restarted in the scan leaves the answer to seam_finding") {
  Cell cell;
  ScanClient client(*cell.bus, cell.instance, {});
  cell.on_command = [&](const scan_command_t& command) {
    cell.tell(scan_t::SCANNING, kScan, command.command_id);
  };
  cell.run(client, 1);
  cell.tell(scan_t::IDLE, 0, 0, 8);
  cell.run(client, 1);
  CHECK(cell.commands.size() == 1);  // it is not started anew
  cell.answer(kScan, seam_t::REFUSED);
  cell.run(client, 1);
  REQUIRE(client.seam());
  CHECK(client.seam()->verdict == seam_t::REFUSED);
}

TEST_CASE("no two scans have the same command id, and none has 0") {
  Cell cell;
  std::set<std::int64_t> ids;
  for (int i = 0; i < 21; ++i) {
    const auto bus = Bus::in_memory();
    ids.insert(ScanClient(*bus, cell.instance, {}).command_id());
  }
  CHECK(ids.size() == 21);
  CHECK_FALSE(ids.contains(0));
}
