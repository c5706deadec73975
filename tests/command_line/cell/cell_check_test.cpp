// Each fault of a host and of a cell gives its line and what mends it. The cell is messages on a
// bus in memory.
#include <fmt/core.h>

#include <catch2/catch.hpp>

#include "services/command_line/cell/census.hpp"
#include "services/command_line/cell/host_checks.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using Catch::Matchers::Contains;

namespace {

HostFacts good_host() {
  HostFacts facts;
  facts.clock = {true, 900};
  facts.interface = "eth1";
  facts.receive_buffer = BusSettings{}.receive_buffer_bytes;
  facts.dropped = 0;
  facts.disk = {50'000'000'000, 100'000'000'000};
  facts.state_folder = "/var/lib/arcstart";
  facts.is_writable = true;
  return facts;
}

// The lines that ask to be mended, as "what -> command".
std::string to_mend(const std::vector<CheckLine>& lines) {
  std::string text;
  for (const CheckLine& line : lines)
    if (!line.mended_by.empty()) text += line.what + " -> " + line.mended_by + "\n";
  return text;
}

struct CheckedCell {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  Instance instance;
  Census census{*bus, instance};

  void status(const std::string& channel, const std::string& host, int pid,
              std::int8_t state = service_status_t::RUNNING, const std::string& error = "") {
    service_status_t status{};
    status.utime = status.run_id = 5;
    status.host = host;
    status.service = "extraction";
    status.pid = pid;
    status.state = state;
    status.last_error = error;
    bus->publish(channel + "_STATUS", status);
    bus->handle(std::chrono::milliseconds(0));
  }
  void scan(double difference, double bound) {
    scan_t state{};
    state.utime = state.run_id = 5;
    state.first_seq = state.last_seq = state.previous_first_seq = state.previous_last_seq = -1;
    state.clock_difference = difference;
    state.clock_bound = bound;
    bus->publish("LASER0_SCAN", state);
    bus->handle(std::chrono::milliseconds(0));
  }
  void all_run() {
    for (const std::string role :
         {"LASER0_SENSOR_CAPTURE", "LASER0_CALIBRATION", "LASER0_EXTRACTION",
          "LASER0_RECONSTRUCTION", "LASER0_SEAM_FINDING"})
      status(role, "cell-pc", 100);
    status("ROBOT0_ROBOT_POSE", "robot-pc", 200);
    scan(0.0002, 0.0001);
  }
  std::vector<CheckLine> lines() const { return census.lines("1.2", "my.yaml"); }
};

}  // namespace

TEST_CASE("a host that is fit has green lines alone") {
  BusSettings two_hosts;
  two_hosts.ttl = 1;
  const auto lines = host_checks(good_host(), two_hosts);
  CHECK(lines.size() == 4);
  CHECK(to_mend(lines).empty());
  CHECK_THAT(to_text(lines, false), Contains("good  clock       synchronised within 0.9 ms\n"));
  CHECK_THAT(to_text(lines, true), Contains("\033[32m"));
}

TEST_CASE("each fault of a host is told with what mends it") {
  HostFacts facts = good_host();
  BusSettings bus;
  bus.ttl = 1;
  const auto mended = [&] { return to_mend(host_checks(facts, bus)); };
  SECTION("clock") {
    facts.clock.is_synchronised = false;
    CHECK_THAT(mended(), Contains("clock -> ") && Contains("chrony"));
    bus.ttl = 0;  // one host needs no other's time
    CHECK(mended().empty());
  }
  SECTION("route") {
    facts.interface = "";
    CHECK(mended() == "route -> ip route add 224.0.0.0/4 dev INTERFACE\n");
    facts.interface = "lo";
    CHECK(mended() == "route -> ip route replace 224.0.0.0/4 dev INTERFACE\n");
    bus.ttl = 0;
    CHECK(mended().empty());
  }
  SECTION("buffers") {
    facts.receive_buffer = 212'992;
    facts.dropped = 7;
    CHECK_THAT(mended(), Contains("buffers -> sysctl -w net.core.rmem_max=4194304"));
    CHECK_THAT(to_text(host_checks(facts, bus), false), Contains("7 datagrams were dropped"));
  }
  SECTION("disk full") {
    facts.disk.free = 900'000'000;
    CHECK_THAT(mended(), Contains("disk -> du "));
  }
  SECTION("disk read-only") {
    facts.is_writable = false;
    CHECK_THAT(mended(), Contains("disk -> mkdir -p /var/lib/arcstart"));
  }
}

TEST_CASE("a cell in which all are heard is whole; calibration is still to be had") {
  CheckedCell cell;
  cell.all_run();
  CHECK(to_mend(cell.lines()) ==
        "calibration -> arcstart calibrate FOLDER -o FILE, then calibration: file: FILE in "
        "cell.yaml (docs/calibrate.md)\n");
  const std::string text = to_text(cell.lines(), false);
  CHECK_THAT(text, Contains("robot-pc: ROBOT0_ROBOT_POSE runs") &&
                       Contains("LASER0_EXTRACTION runs, LASER0_RECONSTRUCTION runs") &&
                       Contains("arcstart 1.2 here"));
}

TEST_CASE("each fault of a cell is told with what mends it") {
  CheckedCell cell;
  SECTION("nobody speaks") {
    CHECK_THAT(to_mend(cell.lines()),
               Contains("clocks -> scripts/start my.yaml on the host of sensor_capture") &&
                   Contains("missing -> scripts/start my.yaml --only "
                            "sensor_capture,robot_pose,calibration,extraction,reconstruction,"
                            "seam_finding"));
    return;
  }
  cell.all_run();
  SECTION("clocks apart") {
    cell.scan(0.05, 0.0002);
    CHECK_THAT(to_mend(cell.lines()), Contains("clocks -> chronyc"));
    cell.scan(0.0013, 0.0004);  // may be 0.9 ms
    CHECK(to_mend(cell.lines()).find("clocks") == std::string::npos);
  }
  SECTION("clocks not compared") {
    cell.scan(0, -1);
    CHECK_THAT(to_mend(cell.lines()), Contains("clocks -> scripts/start"));
  }
  SECTION("two of a role") {
    cell.status("LASER0_EXTRACTION", "other-pc", 300);
    cell.status("LASER0_EXTRACTION", "cell-pc", 100);
    cell.status("LASER0_EXTRACTION", "other-pc", 300);
    CHECK_THAT(to_mend(cell.lines()), Contains("twins -> on other-pc: kill 300"));
  }
  SECTION("a successor is no twin") {
    cell.status("LASER0_EXTRACTION", "cell-pc", 99);
    cell.status("LASER0_EXTRACTION", "cell-pc", 99);
    CHECK(to_mend(cell.lines()).find("twins") == std::string::npos);
  }
  SECTION("one ends") {
    cell.status("LASER0_EXTRACTION", "cell-pc", 100, service_status_t::STOPPING);
    CHECK_THAT(to_mend(cell.lines()),
               Contains("missing -> scripts/start my.yaml --only extraction\n"));
  }
  SECTION("one cannot work") {
    cell.status("LASER0_EXTRACTION", "cell-pc", 100, service_status_t::FAULT, "no\x1b light");
    CHECK_THAT(to_mend(cell.lines()), Contains("fault -> no\\x1b light"));
  }
  SECTION("another version") {
    cell.bus->publish_bytes("LASER1_EXTRACTION_STATUS", {1, 2, 3});
    cell.bus->handle(std::chrono::milliseconds(0));
    CHECK_THAT(to_mend(cell.lines()), Contains("versions -> install the same"));
  }
}
