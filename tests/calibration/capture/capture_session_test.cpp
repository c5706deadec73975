// Making a calibration over the bus: what is asked of the camera, what is kept, and what is said.
#include <arcstart/camera_command_t.hpp>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "common/bus/crc32c.hpp"
#include "common/time.hpp"
#include "services/calibration/calibration_app.hpp"
#include "services/calibration/files/calibration_set.hpp"
#include "tests/calibration/support/drawn_plate.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const DrawnPose kSquare{{0, 0, 0}, {-54, -48, 300}};
const DrawnPose kTiltedX{{0.5, 0, 0}, {-54, -40, 310}};
const DrawnPose kTiltedY{{0, 0.5, 0}, {-48, -48, 320}};

// The calibration service on a memq bus, with a camera and a robot that the test plays. Time is
// the test's own.
struct SessionCell {
  fs::path folder;
  std::unique_ptr<Bus> bus;
  std::unique_ptr<CalibrationApp> app;
  calibration_capture_t state{};
  std::vector<camera_command_t> commands;
  std::int64_t now = utime_now();
  cv::Mat grid = draw_grid(kSquare), laser = draw_laser(kSquare);

  SessionCell() {
    std::string name = (fs::temp_directory_path() / "arcstart_capture_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    folder = name;
    std::ofstream(folder / "my_plate.yaml") << kPlateYaml;
    start();
  }
  ~SessionCell() {
    app.reset();
    fs::remove_all(folder);
  }
  SessionCell(const SessionCell&) = delete;
  SessionCell& operator=(const SessionCell&) = delete;

  void start() {
    app.reset();
    bus = Bus::in_memory();
    CalibrationSettings settings;
    settings.file = folder / "calibration.yaml";
    settings.plate = folder / "my_plate.yaml";
    settings.folder = folder / "set";
    app = std::make_unique<CalibrationApp>(*bus, settings, Instance{}, 4711);
    bus->subscribe<calibration_capture_t>(
        "LASER0_CALIBRATION_CAPTURE", Queue::measurements(),
        [this](const calibration_capture_t& message) { state = message; });
    bus->subscribe<camera_command_t>(
        "LASER0_CAMERA_COMMAND", Queue::measurements(), [this](const camera_command_t& command) {
          if (!commands.empty() && commands.back().command_id == command.command_id) return;
          commands.push_back(command);
          answer(command);
        });
    run(0.1);
  }

  void answer(const camera_command_t& command) {
    const cv::Mat& grey = command.laser == camera_command_t::LASER_ON ? laser : grid;
    image_t image{};
    image.utime = now + 40'000;
    image.run_id = 1;
    image.scan_index = -1;
    image.width = image.sensor_width = static_cast<std::int16_t>(grey.cols);
    image.height = image.sensor_height = static_cast<std::int16_t>(grey.rows);
    image.exposure_us = command.exposure_us;
    image.laser_on = command.laser == camera_command_t::LASER_ON;
    image.command_id = command.command_id;
    image.arrival_utime = image.utime;
    image.size = grey.cols * grey.rows;
    image.data.assign(grey.data, grey.data + image.size);
    image.crc32c = crc32c(image.data);
    bus->publish("LASER0_IMAGE", image);
  }

  void run(double seconds) {
    for (const std::int64_t end = now + seconds_to_us(seconds); now < end; now += 20'000) {
      robot_pose_t pose{};
      pose.utime = now;
      pose.run_id = 1;
      pose.seq = now / 20'000;
      pose.position[0] = 900;
      pose.quaternion[0] = 1;
      pose.device_tick_us = 1;
      bus->publish("ROBOT0_POSE", pose);
      app->tick(now);
      bus->handle(std::chrono::milliseconds(0));
    }
  }

  // Until it is carried out; what runs beside the bus takes real time.
  void order(std::int8_t action, int pose = 0) {
    calibration_command_t command{};
    command.utime = command.command_id = ++ids;
    command.action = action;
    command.pose = pose;
    bus->publish("LASER0_CALIBRATION_COMMAND", command);
    bus->publish("LASER0_CALIBRATION_COMMAND", command);  // repeated, it changes nothing
    run(0.1);
    REQUIRE(state.command_id == command.command_id);
    for (int i = 0; i < 2000 && state.state != calibration_capture_t::IDLE; ++i) {
      run(0.1);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    run(0.1);
    REQUIRE(state.state == calibration_capture_t::IDLE);
  }
  std::int64_t ids = 100;
};

}  // namespace

TEST_CASE("a capture asks for both images, keeps them with the pose and judges them") {
  SessionCell cell;
  CHECK(cell.state.run_id == 4711);
  CHECK(cell.state.pose_count == 0);
  cell.order(calibration_command_t::CAPTURE);
  CHECK(cell.state.refusal.empty());
  REQUIRE(cell.commands.size() == 2);
  CHECK(cell.commands[0].laser == camera_command_t::LASER_OFF);
  CHECK(cell.commands[0].exposure_us == 20000);
  CHECK(cell.commands[1].laser == camera_command_t::LASER_ON);
  CHECK(cell.commands[1].exposure_us == 2000);
  REQUIRE(cell.state.pose_count == 1);
  INFO(cell.state.poses[0].reason);
  CHECK(cell.state.poses[0].usable);
  CHECK(cell.state.poses[0].index == 1);
  const CalibrationSet set = read_calibration_set(cell.folder / "set");
  REQUIRE(set.poses.size() == 1);
  CHECK(set.poses[0].T_base_tool.translation().x() == Approx(900));
}

TEST_CASE("what cannot be used is said at once, and what to change") {
  SessionCell cell;
  std::string expected;
  SECTION("no plate") {
    cell.grid = cv::Scalar(90);
    expected = "points are not all to be seen";
  }
  SECTION("too dark") {
    cell.grid = cell.grid / 5;
    expected = "contrast";
  }
  SECTION("overexposed") {
    cell.grid = cell.grid * 1.5;
    expected = "saturated: expose shorter, or turn";
  }
  SECTION("blurred") {
    cv::GaussianBlur(cell.grid.clone(), cell.grid, {}, 4);
    expected = "blurred";
  }
  SECTION("no stripe") {
    cell.laser = cv::Scalar(4);
    expected = "no stripe";
  }
  SECTION("the stripe beside the plate") {
    cell.laser = draw_laser({kSquare.turn, {-54, -110, 300}});
    expected = "does not cross";
  }
  SECTION("the stripe saturated") {
    cell.laser = cell.laser * 4;
    expected = "% of the stripe are saturated";
  }
  cell.order(calibration_command_t::CAPTURE);
  REQUIRE(cell.state.pose_count == 1);
  CHECK_FALSE(cell.state.poses[0].usable);
  CHECK_THAT(cell.state.poses[0].reason, Contains(expected));
}

TEST_CASE("poses are located, discarded and found again after a restart") {
  SessionCell cell;
  for (const DrawnPose& pose : {kSquare, kTiltedX, kTiltedY}) {
    cell.grid = draw_grid(pose);
    cell.laser = draw_laser(pose);
    cell.order(calibration_command_t::CAPTURE);
    REQUIRE(cell.state.poses.back().reason.empty());
  }
  REQUIRE(cell.state.pose_count == 3);
  REQUIRE(cell.state.poses[1].located);
  CHECK(cell.state.poses[0].tilt == Approx(0).margin(0.05));
  CHECK(cell.state.poses[1].tilt == Approx(0.5).margin(0.05));
  CHECK(cell.state.poses[2].tilt == Approx(0.5).margin(0.05));
  CHECK(cell.state.poses[2].distance == Approx(320).epsilon(0.05));
  CHECK_FALSE(cell.state.advice.empty());

  // Killed before the pose was written down.
  cv::imwrite(cell.folder / "set" / "grid" / "0004.png", cell.grid);
  cell.start();
  REQUIRE(cell.state.pose_count == 3);
  CHECK(fs::exists(cell.folder / "set" / "grid" / "0004.png.without_pose"));
  fs::remove(cell.folder / "set" / "grid" / "0004.png.without_pose");
  CHECK(cell.state.poses[2].usable);
  cell.order(calibration_command_t::DISCARD, 2);
  CHECK(cell.state.refusal.empty());
  REQUIRE(cell.state.pose_count == 2);
  CHECK(cell.state.poses[1].index == 3);
  CHECK(read_calibration_set(cell.folder / "set").poses.size() == 2);
  cell.order(calibration_command_t::DISCARD, 2);
  CHECK(cell.state.refusal == "there is no pose 2");
  cell.order(calibration_command_t::DISCARD, -1);
  CHECK(cell.state.pose_count == 0);
  CHECK(fs::is_empty(cell.folder / "set" / "grid"));
}

TEST_CASE("a plate that cannot be read ends the service with what to do") {
  SessionCell cell;
  CalibrationSettings settings;
  settings.plate = cell.folder / "none.yaml";
  settings.folder = cell.folder / "set";
  CHECK_THROWS_AS(CalibrationApp(*cell.bus, settings, Instance{}, 1), ConfigurationError);
  std::ofstream(cell.folder / "none.yaml") << "pattern: triangles\n";
  CHECK_THROWS_WITH(CalibrationApp(*cell.bus, settings, Instance{}, 1), Contains("none.yaml"));
}
