// Images that a camera command asks for.
#include <catch2/catch.hpp>

#include "tests/sensor_capture/support/scripted_cell.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;
using namespace arcstart::test;

TEST_CASE("sensor_capture: a camera command's images, surely under its settings") {
  ScriptedCell cell;
  cell.find_camera();
  cell.expose();
  const Frame before = cell.make_frame();  // on its way when the command comes
  cell.settle();
  cell.camera_command(31, 2, camera_command_t::LASER_ON, 9'000, 6);
  cell.script.events.push_back(before);
  cell.step();
  CHECK(cell.images.empty());
  CHECK(cell.script.requests.back().second == CameraSettings{9'000, 6, true});
  cell.expose();
  CHECK(cell.images.empty());
  cell.answer();
  cell.settle();
  cell.expose();  // may still have the old exposure
  CHECK(cell.images.empty());
  cell.expose();
  cell.expose();
  REQUIRE(cell.images.size() == 2);
  for (const image_t& image : cell.images) {
    CHECK(image.command_id == 31);
    CHECK(image.scan_id == 0);
    CHECK(image.scan_index == -1);
    CHECK(image.exposure_us == 9'000);
    CHECK(image.gain_db == 6);
    CHECK(image.laser_on);
  }
  // Then as configured, and dark.
  CHECK(cell.script.requests.back().second == CameraSettings{kScriptedExposure, 0, false});
  cell.answer();
  for (int i = 0; i < 4; ++i) cell.expose();
  CHECK(cell.images.size() == 2);
  cell.camera_command(31, 2, camera_command_t::LASER_ON, 9'000, 6);  // repeated
  CHECK(cell.script.requests.back().second == CameraSettings{kScriptedExposure, 0, false});
}

TEST_CASE("sensor_capture: camera commands give way to scans, and are refused while they run") {
  ScriptedCell cell;
  cell.find_camera();
  cell.camera_command(31, 50, camera_command_t::LASER_OFF, 9'000);
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.script.requests.back().second == CameraSettings{kScriptedExposure, 0, true});
  cell.answer();
  cell.settle();
  cell.camera_command(32, 5, camera_command_t::LASER_OFF, 1'000);
  CHECK(cell.script.requests.back().second == CameraSettings{kScriptedExposure, 0, true});
  for (int i = 0; i < 4; ++i) cell.expose();
  // The first one is lit, but may still have the command's exposure.
  REQUIRE(cell.images.size() == 3);
  for (const image_t& image : cell.images) {
    CHECK(image.scan_id > 0);
    CHECK(image.exposure_us == kScriptedExposure);
  }
}

TEST_CASE("sensor_capture: the laser stays on for a command only while that is repeated") {
  ScriptedCell cell;
  cell.find_camera();
  CHECK(cell.app->health().notice == "laser off");
  cell.camera_command(31, 10'000, camera_command_t::LASER_ON);
  CHECK(cell.laser_asked());
  cell.answer();
  CHECK(cell.app->health().notice == "laser on for camera command 31");
  for (const std::int64_t begin = steady_now(); steady_now() - begin < 1'500'000;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    cell.camera_command(31, 10'000, camera_command_t::LASER_ON);
    CHECK(cell.laser_asked());
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1'050));
  cell.step();
  CHECK_FALSE(cell.laser_asked());
  CHECK(cell.app->health().notice == "laser goes off");
  cell.answer();
  CHECK(cell.app->health().notice == "laser off");
  cell.camera_command(31, 10'000, camera_command_t::LASER_ON);  // it has ended
  CHECK_FALSE(cell.laser_asked());
}

TEST_CASE("sensor_capture: a command that lights the laser once lights it for a second") {
  ScriptedCell cell;
  cell.find_camera();
  cell.camera_command(31, 10'000, camera_command_t::LASER_ON);
  cell.camera_command(33, 10'000, camera_command_t::LASER_OFF);  // dark, it needs nobody
  CHECK_FALSE(cell.laser_asked());
  cell.camera_command(34, 10'000, camera_command_t::LASER_ON);
  CHECK(cell.laser_asked());
  std::this_thread::sleep_for(std::chrono::milliseconds(1'050));
  cell.step();
  CHECK_FALSE(cell.laser_asked());
  CHECK(cell.script.requests.back().second == CameraSettings{kScriptedExposure, 0, false});
}

TEST_CASE("sensor_capture: settings that the camera cannot do end the command") {
  ScriptedCell cell;
  cell.find_camera();
  cell.camera_command(31, 1, camera_command_t::LASER_OFF, 500'000);
  cell.script.events.push_back(SettingsApplied{cell.script.requests.back().first,
                                               cell.script.requests.back().second, utime_now(),
                                               "exposure of 500000 us: at most 100000"});
  cell.answered = cell.script.requests.size();
  cell.step();
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK(cell.app->health().last_error.find("500000 us") != std::string::npos);
  cell.answer();
  for (int i = 0; i < 4; ++i) cell.expose();
  CHECK(cell.images.empty());
  CHECK(cell.script.requests.back().second == CameraSettings{kScriptedExposure, 0, false});
}

TEST_CASE(
    "sensor_capture: a region or a frame rate is refused, and told, not taken for the whole") {
  ScriptedCell cell;
  cell.find_camera();
  camera_command_t command{};
  command.utime = utime_now();
  command.command_id = 33;
  command.images = 1;
  if (GENERATE(true, false))
    command.width = 100, command.height = 50;
  else
    command.frame_rate = 20;
  const auto requests = cell.script.requests.size();
  cell.bus->publish("LASER0_CAMERA_COMMAND", command);
  while (cell.bus->handle(std::chrono::milliseconds(0))) {
  }
  cell.step();
  for (int i = 0; i < 4; ++i) cell.expose();
  CHECK(cell.images.empty());
  CHECK(cell.script.requests.size() == requests);
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK_THAT(cell.app->health().last_error,
             Catch::Contains("camera command 33 is refused") && Catch::Contains("cell.yaml"));
}
