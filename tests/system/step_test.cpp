// A cell in step: clocks of several hosts, two processes of one role, and supervision that holds.
#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "paths.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;

namespace {

// A zombie, which nobody has asked for its code, runs no more.
bool is_running(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  return !text.empty() && text.compare(text.rfind(')'), 3, ") Z") != 0;
}

}  // namespace

TEST_CASE("positions stamped by a clock 50 ms ahead refuse the scan; put right, scans are taken") {
  // Small and slow, and with a camera that is not soon given up: a machine under load loses nothing
  // that matters here.
  RunningCell cell("clocks",
                   {"cell_simulator.image_width_px: 400", "cell_simulator.image_height_px: 300",
                    "cell_simulator.frame_rate_hz: 5", "sensor_capture.frame_rate_hz: 5",
                    "sensor_capture.silent_periods: 100", "reconstruction.keep_every: 4"});
  for (const auto& service : RunningCell::services()) {
    const bool is_apart = service == "robot_pose";
    if (is_apart) {
      setenv("LD_PRELOAD", ARCSTART_SHIFTED_CLOCK, 1);
      setenv("ARCSTART_CLOCK_AHEAD_US", "50000", 1);
    }
    cell.start(service);
    if (is_apart) unsetenv("LD_PRELOAD");
  }
  REQUIRE(cell.wait_until_ready());
  const auto refused = cell.scan(scan_t::BACKGROUND);
  REQUIRE(refused);
  INFO(refused->reason);
  CHECK(refused->verdict == seam_t::REFUSED);
  CHECK(refused->refusal == seam_t::CLOCKS_DIFFER);
  CHECK(std::abs(cell.heard().scan->clock_difference - 0.05) <= cell.heard().scan->clock_bound);
  CHECK(cell.listen_until(
      [&] {
        return cell.status("sensor_capture").last_error.find("chrony or PTP") != std::string::npos;
      },
      20));

  cell.terminate("robot_pose");
  cell.start("robot_pose");
  REQUIRE(cell.wait_until_ready());
  const auto stored = cell.scan(scan_t::BACKGROUND);
  REQUIRE(stored);
  INFO(stored->reason);
  CHECK(stored->refusal != seam_t::CLOCKS_DIFFER);
  CHECK(std::abs(cell.heard().scan->clock_difference) <= cell.heard().scan->clock_bound);
}

TEST_CASE(
    "a second service of one role is named, from another host; on this host it does not start") {
  RunningCell cell("twins");
  cell.start("extraction");
  REQUIRE(cell.listen_until([&] { return cell.status("extraction").pid != 0; }, 10));
  const service_status_t own = cell.status("extraction");
  const auto names_another = [](const service_status_t& status) {
    return status.last_error.find("another extraction") != std::string::npos;
  };
  CHECK_FALSE(names_another(own));

  service_status_t other = own;
  other.host = "elsewhere";
  other.pid = 4711;
  bool told = false;
  cell.listen_until(
      [&] {
        if (told) return true;
        cell.bus().publish("LASER0_EXTRACTION_STATUS", other);
        cell.listen(0.1);
        const service_status_t now = cell.status("extraction");
        told = now.pid == own.pid && now.state == service_status_t::DEGRADED &&
               now.last_error.find(
                   "another extraction does the same work: host elsewhere, pid "
                   "4711") != std::string::npos;
        return told;
      },
      20);
  CHECK(told);
  CHECK(cell.listen_until(
      [&] {
        const service_status_t now = cell.status("extraction");
        return now.pid == own.pid && !names_another(now);
      },
      20));

  const Output second =
      run({program("arcstart-extraction"), "--cell", cell.cell_file(), "--state", cell.folder()});
  CHECK(second.code == 2);
  CHECK_THAT(second.err, Catch::Contains("extraction runs on this host already, for LASER0"));
  CHECK(cell.process("extraction").is_running());
}

TEST_CASE("scripts/start loses none of two that die at once, and takes all with it") {
  RunningCell cell("started");
  Process start({std::string(ARCSTART_SOURCE) + "/scripts/start", cell.cell_file(), "--only",
                 "extraction,reconstruction,seam_finding", "--state", cell.folder()},
                cell.folder() + "/start.log");
  const std::vector<std::string> services = {"extraction", "reconstruction", "seam_finding"};
  const auto pid = [&](const std::string& service) { return cell.status(service).pid; };
  const auto all_heard = [&] {
    return std::all_of(services.begin(), services.end(),
                       [&](const std::string& service) { return pid(service) != 0; });
  };
  REQUIRE(cell.listen_until(all_heard, 20));
  for (const std::size_t victims : {std::size_t{2}, std::size_t{3}}) {
    std::vector<pid_t> before;
    for (std::size_t i = 0; i < victims; ++i) before.push_back(pid(services[i]));
    for (const pid_t one : before) kill(one, SIGKILL);
    for (std::size_t i = 0; i < victims; ++i) {
      INFO(services[i]);
      CHECK(cell.listen_until([&] { return pid(services[i]) != before[i]; }, 20));
    }
  }
  std::vector<pid_t> last;
  for (const auto& service : services) last.push_back(pid(service));
  start.send(SIGKILL);
  CHECK(cell.listen_until([&] { return std::none_of(last.begin(), last.end(), is_running); }, 20));
}

TEST_CASE("a network that is not there yet is waited for") {
  RunningCell cell("no_route");
  const std::string log = cell.folder() + "/start.log";
  Process start(
      {"/usr/bin/unshare", "--net", "bash", "-c",
       "ip link set lo up; (sleep 3; ip link set lo multicast on; ip route add 224.0.0.0/4 dev lo)"
       " & exec " +
           std::string(ARCSTART_SOURCE) + "/scripts/start " + cell.cell_file() +
           " --only cell_simulator,calibration --state " + cell.folder()},
      log);
  // The simulated cell writes its calibration when it has its bus; that file calibration then
  // reads.
  CHECK(cell.listen_until(
      [&] { return std::filesystem::exists(cell.folder() + "/LASER0.calibration.yaml"); }, 30));
  std::ifstream file(log);
  const std::string said((std::istreambuf_iterator<char>(file)), {});
  INFO(said);
  CHECK_THAT(said, Catch::Contains("it is waited for"));
  CHECK_THAT(said, !Catch::Contains("start:"));
  CHECK(start.is_running());
  start.send(SIGINT);
  CHECK(start.wait(20) == 0);
}
