// In a network of its own: the camera's control port is fixed.
#include "services/cell_simulator/cell_simulator_app.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "common/time.hpp"
#include "tests/cell_simulator/camera/camera_client.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

CellSimulatorSettings small_cell() {
  CellSimulatorSettings settings;
  settings.sensor.image_width_px = 400;
  settings.sensor.image_height_px = 300;
  settings.scene.table_pitch_mm = 20;
  settings.search_speed_mm_s = 500;
  settings.acceleration_mm_s2 = 5000;
  settings.seed = 3;
  return settings;
}

// The app with its bus in memory, ticked on the real clock.
struct Cell {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  std::vector<truth_t> truths;
  CellSimulatorApp app;

  explicit Cell(const CellSimulatorSettings& settings = small_cell())
      : app(*bus, settings, Instance{}, utime_now()) {
    bus->subscribe<truth_t>("CELL_TRUTH", Queue::measurements(),
                            [this](const truth_t& truth) { truths.push_back(truth); });
    run_until([this] { return !truths.empty(); });
  }
  const truth_t& truth() const { return truths.back(); }

  void tick() {
    app.tick(utime_now());
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  template <class Condition>
  void run_until(Condition condition) {
    for (int i = 0; i < 6000 && !condition(); ++i) tick();
    REQUIRE(condition());
  }

  void scan(std::int8_t state, std::int64_t scan_id) {
    scan_t scan{};
    scan.utime = utime_now();
    scan.run_id = 1;
    scan.state = state;
    scan.scan_id = scan.begin_utime = scan_id;
    if (state == scan_t::ENDED) scan.end_utime = scan.utime, scan.end_cause = scan_t::STOP;
    scan.first_seq = scan.last_seq = -1;
    bus->publish("LASER0_SCAN", scan);
    tick();
  }
  void command(std::int64_t id, std::int8_t scene, std::int64_t seed) {
    cell_command_t command{};
    command.utime = utime_now();
    command.command_id = id;
    command.scene = scene;
    command.seed = seed;
    command.quaternion[0] = 1;
    bus->publish("CELL_COMMAND", command);
    tick();
  }
};

RigidTransform tool(const truth_t& truth) {
  return transform_from_arrays(truth.tool_position, truth.tool_quaternion);
}

bool stands_at(const truth_t& truth, const RigidTransform& T_base_tool) {
  return !truth.moving && tool(truth).isApprox(T_base_tool, 1e-9);
}

}  // namespace

TEST_CASE("the truth tells scene, seam and arm; a command changes the scene once") {
  const CellSimulatorSettings settings = small_cell();
  Cell cell(settings);
  CHECK(cell.truth().scene == cell_command_t::BACKGROUND);
  CHECK(cell.truth().seed == 3);
  CHECK(cell.truth().command_id == 0);
  CHECK(cell.truth().joint_type.empty());
  CHECK_FALSE(cell.truth().moving);
  CHECK_FALSE(cell.truth().laser_on);
  const RigidTransform begin =
      taught_tool_pose(settings.sensor, settings.scene, settings.scene.search_begin_mm);
  CHECK(tool(cell.truth()).isApprox(begin, 1e-9));
  cell.run_until([&] { return cell.truth().positions > 0; });

  cell.command(11, cell_command_t::WORKPIECE, 5);
  cell.run_until([&] { return cell.truth().command_id == 11; });
  CHECK(cell.truth().scene == cell_command_t::WORKPIECE);
  CHECK(cell.truth().seed == 5);
  const SeamTruth seam = make_scene(settings.scene, SceneKind::workpiece, 5).seam().value();
  CHECK(cell.truth().joint_type == "tee");
  CHECK(Eigen::Vector3d(cell.truth().start) == seam.start);
  CHECK(Eigen::Vector3d(cell.truth().end) == seam.end);
  CHECK(Eigen::Vector3d(cell.truth().direction) == seam.direction);
  CHECK(Eigen::Vector3d(cell.truth().normals[0]) == seam.normals[0]);
  CHECK(Eigen::Vector3d(cell.truth().normals[1]) == seam.normals[1]);
  CHECK(cell.truth().angle == seam.angle);

  cell.command(11, cell_command_t::BACKGROUND, 6);  // the id is known: nothing changes
  cell.command(12, cell_command_t::KEEP, 7);
  cell.run_until([&] { return cell.truth().command_id == 12; });
  CHECK(cell.truth().scene == cell_command_t::WORKPIECE);
  CHECK(cell.truth().seed == 7);
}

TEST_CASE("a scan starts the search, its end brings the arm back, and commands wait for that") {
  const CellSimulatorSettings settings = small_cell();
  Cell cell(settings);
  const RigidTransform begin =
      taught_tool_pose(settings.sensor, settings.scene, settings.scene.search_begin_mm);
  const RigidTransform end =
      taught_tool_pose(settings.sensor, settings.scene, settings.scene.search_end_mm);
  const std::int64_t scan_id = utime_now();
  cell.scan(scan_t::SCANNING, scan_id);
  cell.command(21, cell_command_t::WORKPIECE, -1);
  cell.run_until([&] {
    cell.scan(scan_t::SCANNING, scan_id);  // it is stated at 5 Hz
    return stands_at(cell.truth(), end);
  });
  for (const truth_t& truth : cell.truths)
    if (truth.utime < scan_id + 500'000) CHECK(stands_at(truth, begin));
  CHECK(cell.truth().command_id == 0);
  CHECK(cell.truth().scene == cell_command_t::BACKGROUND);

  cell.scan(scan_t::ENDED, scan_id);
  cell.run_until([&] { return cell.truth().command_id == 21; });
  CHECK(cell.truth().scene == cell_command_t::WORKPIECE);
  cell.run_until([&] { return stands_at(cell.truth(), begin); });
}

TEST_CASE("a scan of which nothing more is heard is over") {
  Cell cell;
  const std::int64_t scan_id = utime_now();
  cell.scan(scan_t::SCANNING, scan_id);
  cell.command(31, cell_command_t::WORKPIECE, -1);
  cell.run_until([&] { return cell.truth().command_id == 31; });
  CHECK(cell.truth().utime >= scan_id + 2'000'000);
}

TEST_CASE("the arm goes to a pose it reaches, and a pose out of reach is refused in words") {
  Cell cell;
  cell_command_t command{};
  command.utime = utime_now();
  command.command_id = 41;
  command.seed = -1;
  command.move = true;
  RigidTransform pose = tool(cell.truth());
  pose.translation() += Eigen::Vector3d(-60, 40, 30);
  transform_to_arrays(pose, command.position, command.quaternion);
  cell.bus->publish("CELL_COMMAND", command);
  cell.run_until([&] { return stands_at(cell.truth(), pose); });
  CHECK(cell.app.health().last_error.empty());

  command.command_id = 42;
  command.position[0] = 5000;
  cell.bus->publish("CELL_COMMAND", command);
  cell.run_until([&] { return !cell.app.health().last_error.empty(); });
  CHECK_THAT(cell.app.health().last_error,
             Catch::Contains("42") && Catch::Contains("does not reach"));
  CHECK(cell.truth().command_id == 41);
  CHECK(tool(cell.truth()).isApprox(pose, 1e-9));
}

TEST_CASE("a client sees the scene by the laser's light") {
  CellSimulatorSettings settings = small_cell();
  settings.scene_at_start = "workpiece";
  settings.frame_rate_hz = 20;
  const auto brightest = [](const ReceivedFrame& frame) {
    return *std::max_element(frame.grey.begin(), frame.grey.end());
  };
  Cell cell(settings);
  CameraClient client;
  REQUIRE(client.get());
  client.start();
  CHECK(brightest(client.next()) < 40);
  client.light_the_laser();
  ReceivedFrame frame = client.next();
  for (int i = 0; i < 5; ++i) frame = client.next();
  CHECK(brightest(frame) > 70);
  cell.tick();
  CHECK(cell.truth().laser_on);
  CHECK(cell.truth().frames > 6);
}

TEST_CASE("the same search of the same scene gives the same frames") {
  CellSimulatorSettings settings = small_cell();
  settings.scene_at_start = "workpiece";
  settings.frame_rate_hz = 20;
  settings.search_speed_mm_s = 150;
  Cell cell(settings);
  CameraClient client;
  REQUIRE(client.get());
  client.light_the_laser();
  client.start();
  const auto taught = [&](double along) {
    return taught_tool_pose(settings.sensor, settings.scene, along);
  };
  const RigidTransform begin = taught(settings.scene.search_begin_mm),
                       end = taught(settings.scene.search_end_mm);
  // The frames of a search, by the arm's moving; those at its edges may fall on either side.
  const auto search = [&](std::int64_t scan_id) {
    std::vector<ReceivedFrame> frames;
    while (!stands_at(cell.truth(), end)) {
      cell.scan(scan_t::SCANNING, scan_id);
      const bool begun = cell.truth().moving;
      ReceivedFrame frame = client.next();
      if (begun) frames.push_back(std::move(frame));
    }
    cell.scan(scan_t::ENDED, scan_id);
    cell.run_until([&] { return stands_at(cell.truth(), begin); });
    return frames;
  };
  const auto first = search(utime_now()), second = search(utime_now());
  // Equal frames are one time apart, and frames that time apart are equal. A machine that stalls
  // loses some, or has them exposed between two triggers: those have no partner.
  std::vector<std::int64_t> apart_ns;
  for (const ReceivedFrame& frame : first) {
    CHECK(std::count_if(first.begin(), first.end(), [&](const ReceivedFrame& other) {
            return other.grey == frame.grey;
          }) == 1);  // the arm moves
    for (const ReceivedFrame& again : second)
      if (again.grey == frame.grey) apart_ns.push_back(again.device_ns - frame.device_ns);
  }
  REQUIRE(apart_ns.size() > 5);
  const auto [least, most] = std::minmax_element(apart_ns.begin(), apart_ns.end());
  CHECK(*most - *least < 100'000);
  int unequal = 0;
  for (const ReceivedFrame& frame : first)
    for (const ReceivedFrame& again : second)
      unequal += std::abs(again.device_ns - frame.device_ns - *least) < 1'000'000 &&
                 again.grey != frame.grey;
  CHECK(unequal <= 3);
}

TEST_CASE("the faults set for a scan take the camera away and bring it back") {
  CellSimulatorSettings settings = small_cell();
  settings.fault_scan = 1;
  settings.fault_after_s = 0.1;
  settings.fault_camera_away_s = 0.5;
  Cell cell(settings);
  CHECK(CameraClient().get());
  const std::int64_t scan_id = utime_now();
  cell.scan(scan_t::SCANNING, scan_id);
  cell.run_until([&] { return utime_now() > scan_id + 150'000; });
  CHECK_FALSE(CameraClient().get());
  cell.run_until([&] { return utime_now() > scan_id + 700'000; });
  cell.tick();
  CHECK(CameraClient().get());
}

TEST_CASE("the true calibration is written at start") {
  const auto path = std::filesystem::temp_directory_path() /
                    ("arcstart-app-test-" + std::to_string(getpid()) + ".yaml");
  CellSimulatorSettings settings = small_cell();
  settings.calibration_file = path;
  { Cell cell(settings); }
  CHECK(YAML::LoadFile(path)["time_offset"].as<double>() == Approx(-0.02732));
  CHECK(YAML::LoadFile(path)["width"].as<int>() == 400);
  std::filesystem::remove(path);
}
