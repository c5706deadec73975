// The service over a bus in memory, its controller a set of registers.
#include "services/robot_link/robot_link_app.hpp"

#include <arcstart/scan_command_t.hpp>
#include <catch2/catch.hpp>
#include <thread>

#include "common/time.hpp"

using namespace arcstart;
using namespace arcstart::robot_link;

namespace {

// Registers that several threads reach; can be unplugged.
struct Shared {
  std::mutex mutex;
  std::array<std::int32_t, kSlots> numbers{};
  Positions positions;
  bool unplugged = false;

  std::int32_t get(Slot slot) {
    const std::lock_guard lock(mutex);
    return numbers[static_cast<std::size_t>(slot)];
  }
  void set(Slot slot, std::int32_t number) {
    const std::lock_guard lock(mutex);
    numbers[static_cast<std::size_t>(slot)] = number;
  }
};

class RegisterLink : public ControllerLink {
 public:
  explicit RegisterLink(Shared& shared) : shared_(shared) {}
  void connect() override { check(); }
  Reading carry_out(const Operation& operation) override {
    check();
    const std::lock_guard lock(shared_.mutex);
    auto& number = shared_.numbers[static_cast<std::size_t>(operation.slot)];
    auto& position = shared_.positions[static_cast<std::size_t>(operation.place)];
    if (operation.kind == Operation::Kind::kWriteNumber) number = operation.number;
    if (operation.kind == Operation::Kind::kWritePosition) position = operation.position;
    return {number, position};
  }
  void end() override {}
  std::string description() const override { return "registers"; }

 private:
  void check() {
    const std::lock_guard lock(shared_.mutex);
    if (shared_.unplugged) throw LinkError("the cable is out");
  }
  Shared& shared_;
};

struct Cell {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  Instance instance;
  Shared registers;
  RobotLinkSettings settings;
  std::optional<RobotLinkApp> app;
  std::optional<scan_command_t> command;
  std::optional<delivery_t> delivery;
  std::int32_t beat = 0;

  Cell() {
    settings.jobs = {"flat", "tee"};
    settings.box_low_mm = {800, -100, -10};
    settings.box_high_mm = {1100, 100, 200};
    app.emplace(*bus, settings, instance, utime_now(), std::make_unique<RegisterLink>(registers));
    bus->subscribe<scan_command_t>("LASER0_SCAN_COMMAND", Queue::newest(),
                                   [this](const scan_command_t& m) { command = m; });
    bus->subscribe<delivery_t>("ROBOT0_DELIVERY", Queue::newest(),
                               [this](const delivery_t& m) { delivery = m; });
  }

  void services_run() {
    for (const char* service :
         {"LASER0_SENSOR_CAPTURE", "ROBOT0_ROBOT_POSE", "LASER0_CALIBRATION", "LASER0_EXTRACTION",
          "LASER0_RECONSTRUCTION", "LASER0_SEAM_FINDING"}) {
      service_status_t status{};
      status.utime = status.run_id = utime_now();
      status.pid = 1;
      status.state = service_status_t::RUNNING;
      bus->publish(std::string(service) + "_STATUS", status);
    }
  }

  // Until it holds; 20 s at most, for a machine that is busy.
  template <class Condition>
  bool wait(Condition condition) {
    for (const std::int64_t end = steady_now() + 20'000'000; steady_now() < end;) {
      registers.set(Slot::kRobotBeat, ++beat);
      while (bus->handle(std::chrono::milliseconds(0))) continue;
      app->tick(utime_now());
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  void ask(std::int32_t request, std::int32_t job, std::int32_t part) {
    registers.set(Slot::kJob, job);
    registers.set(Slot::kPart, part);
    registers.set(Slot::kRequest, request);
  }

  void scan(std::int8_t state) {
    scan_t scan{};
    scan.utime = scan.run_id = utime_now();
    scan.state = state;
    scan.kind = scan_t::WORKPIECE;
    scan.scan_id = scan.begin_utime = 1'700'000'000'000'000;
    if (state == scan_t::ENDED) {
      scan.end_utime = scan.begin_utime + 1'000'000;
      scan.end_cause = scan_t::STOP;
    }
    scan.command_id = scan.start_command_id = command->command_id;
    scan.request = command->request;
    scan.job = command->job;
    scan.part = command->part;
    scan.first_seq = scan.last_seq = scan.previous_first_seq = scan.previous_last_seq = -1;
    bus->publish("LASER0_SCAN", scan);
  }
};

}  // namespace

TEST_CASE("robot_link: a question becomes a scan, its refusal an answer") {
  Cell cell;
  REQUIRE(cell.wait([&] { return cell.delivery && cell.delivery->robot_alive; }));
  cell.services_run();
  cell.ask(7, 2, 99);
  REQUIRE(cell.wait([&] { return cell.command.has_value(); }));
  CHECK(cell.command->request == 7);
  CHECK(cell.command->job == "tee");
  CHECK(cell.command->part == "99");
  CHECK(cell.command->kind == scan_t::WORKPIECE);
  CHECK(cell.registers.get(Slot::kAnswer) == 0);
  cell.scan(scan_t::SCANNING);
  CHECK(cell.wait(
      [&] { return cell.registers.get(Slot::kStatus) == static_cast<int>(Status::kScanning); }));
  cell.scan(scan_t::ENDED);
  CHECK(cell.wait(
      [&] { return cell.registers.get(Slot::kStatus) == static_cast<int>(Status::kScanEnded); }));

  seam_t seam{};
  seam.verdict = seam_t::REFUSED;
  seam.refusal = seam_t::NO_WORKPIECE;
  seam.reason = "no plane";
  seam.thickness = seam.mismatch = seam.groove_angle = -1;
  seam.worst_contradiction = -1;
  seam.stripes_checked = -1;
  seam.utime = utime_now();
  seam.scan_id = 1'700'000'000'000'000;
  seam.command_id = cell.command->command_id;
  seam.job = "tee";
  seam.part = "99";
  seam.request = 6;  // another's
  cell.bus->publish("LASER0_SEAM", seam);
  for (int i = 0; i < 20; ++i) cell.wait([] { return true; });
  CHECK(cell.registers.get(Slot::kAnswer) == 0);
  seam.request = 7;
  cell.bus->publish("LASER0_SEAM", seam);
  CHECK(cell.wait([&] { return cell.registers.get(Slot::kAnswer) == 7; }));
  CHECK(cell.registers.get(Slot::kVerdict) == seam_t::NO_WORKPIECE);
  CHECK(cell.wait([&] { return cell.delivery->progress == delivery_t::DELIVERED; }));
  CHECK(cell.delivery->reason == "no plane");
  CHECK(cell.delivery->job == "tee");
}

TEST_CASE("robot_link: what it cannot scan for is refused by its number") {
  Cell cell;
  REQUIRE(cell.wait([&] { return cell.delivery && cell.delivery->robot_alive; }));
  SECTION("no such job") {
    cell.services_run();
    cell.ask(7, 3, 99);
    CHECK(cell.wait([&] { return cell.registers.get(Slot::kAnswer) == 7; }));
    CHECK(cell.registers.get(Slot::kVerdict) == kUnknownJob);
  }
  SECTION("no services") {
    cell.ask(7, 2, 99);
    CHECK(cell.wait([&] { return cell.registers.get(Slot::kAnswer) == 7; }));
    CHECK(cell.registers.get(Slot::kVerdict) == kCellNotReady);
    CHECK(cell.wait([&] { return cell.delivery->verdict == kCellNotReady; }));
    CHECK_THAT(cell.delivery->reason, Catch::Contains("sensor_capture is not heard"));
  }
  CHECK_FALSE(cell.command);
}

TEST_CASE("robot_link: a controller that is away is told, and found again") {
  Cell cell;
  REQUIRE(cell.wait([&] { return cell.delivery && cell.delivery->connected; }));
  {
    const std::lock_guard lock(cell.registers.mutex);
    cell.registers.unplugged = true;
  }
  REQUIRE(cell.wait([&] { return !cell.delivery->connected; }));
  CHECK(cell.delivery->trouble == "the cable is out");
  CHECK(cell.app->health().state == service_status_t::FAULT);
  {
    const std::lock_guard lock(cell.registers.mutex);
    cell.registers.unplugged = false;
  }
  CHECK(cell.wait([&] { return cell.delivery->connected; }));
}
