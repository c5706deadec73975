// The app with a scripted camera: its scans, its state and what is wrong with the camera.
#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/bus/crc32c.hpp"
#include "tests/sensor_capture/support/scripted_cell.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;
using namespace arcstart::test;

TEST_CASE("sensor_capture: without a scan there is a preview and the scan's state, no image") {
  ScriptedCell cell;
  cell.find_camera();
  const std::int64_t begin = steady_now();
  for (int i = 0; i < 5; ++i) cell.expose();
  CHECK(cell.images.empty());
  REQUIRE_FALSE(cell.previews.empty());  // twice a second, however long this took
  CHECK(static_cast<std::int64_t>(cell.previews.size()) <= 1 + (steady_now() - begin) / 500'000);
  CHECK(cell.previews[0].width == 8);
  REQUIRE_FALSE(cell.scans.empty());
  CHECK(cell.scans.back().state == scan_t::IDLE);
  CHECK(cell.scans.back().run_id == 55);
  CHECK_FALSE(cell.laser_asked());
}

TEST_CASE("sensor_capture: a scan's images, their fields and its state") {
  ScriptedCell cell;
  cell.find_camera();
  cell.expose();
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.laser_asked());
  REQUIRE(cell.scans.back().state == scan_t::SCANNING);
  const std::int64_t scan_id = cell.scans.back().scan_id;
  cell.expose();  // the laser's switching is not answered: in no scan
  CHECK(cell.images.empty());
  cell.answer();
  cell.settle();
  for (int i = 0; i < 3; ++i) cell.expose();
  REQUIRE(cell.images.size() == 3);
  cell.scan_command(8, scan_command_t::STOP);
  CHECK_FALSE(cell.laser_asked());
  cell.expose();  // tells that no other is on its way
  REQUIRE(cell.scans.back().state == scan_t::ENDED);

  for (int i = 0; i < 3; ++i) {
    const image_t& image = cell.images[static_cast<std::size_t>(i)];
    CHECK(image.run_id == 55);
    CHECK(image.seq == 103 + i);
    CHECK(image.scan_id == scan_id);
    CHECK(image.scan_index == i);
    CHECK(image.width == 8);
    CHECK(image.height == 4);
    CHECK(image.offset_u == 16);
    CHECK(image.offset_v == 2);
    CHECK(image.sensor_width == 40);
    CHECK(image.sensor_height == 30);
    CHECK(image.exposure_us == kScriptedExposure);
    CHECK(image.gain_db == 0);
    CHECK(image.laser_on);
    CHECK(image.command_id == 0);
    CHECK(image.encoding == image_t::MONO8);
    CHECK(image.incomplete == "");
    CHECK(image.data == std::vector<std::uint8_t>(32, static_cast<std::uint8_t>(103 + i)));
    CHECK(image.crc32c == crc32c(image.data));
    // The middle of the exposure. The clock's mapping stands still: the difference is the first
    // frame's, and here every frame arrives as it is stamped.
    CHECK(image.utime == image.device_time_ns / 1000 - kDeviceAhead + kScriptedExposure / 2);
    CHECK(image.arrival_utime == image.device_time_ns / 1000 - kDeviceAhead);
  }
  const scan_t& ended = cell.scans.back();
  CHECK(ended.scan_id == scan_id);
  CHECK(ended.begin_utime == scan_id);
  CHECK(ended.command_id == 8);
  CHECK(ended.kind == scan_t::WORKPIECE);
  CHECK(ended.first_seq == 103);
  CHECK(ended.last_seq == 105);
  CHECK(ended.images == 3);
  CHECK(ended.lost == 0);
  CHECK(ended.end_cause == scan_t::STOP);
  CHECK(ended.end_reason == "stop");
  CHECK(ended.start_command_id == 7);
  CHECK(ended.request == 42);
  CHECK(ended.job == "job 7");
  CHECK(ended.part == "part 7");
  CHECK(ended.clock_bound == -1);
  CHECK(ended.end_utime > cell.images.back().utime);
  // The last image comes before the word that it was the last.
  const auto last_image = std::find(cell.order.rbegin(), cell.order.rend(), "image");
  const auto last_scan = std::find(cell.order.rbegin(), cell.order.rend(), "scan");
  CHECK(last_scan < last_image);
}

TEST_CASE("sensor_capture: a scan's end is told three times on the images' channel, behind them") {
  ScriptedCell cell;
  cell.find_camera();
  cell.expose();
  CHECK(cell.ends.empty());  // no scan has run
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  for (int i = 0; i < 3; ++i) cell.expose();
  REQUIRE(cell.images.size() == 3);
  CHECK(cell.ends.empty());
  SECTION("by the frames that follow") {
    cell.scan_command(8, scan_command_t::STOP);
    for (int i = 0; i < 6; ++i) cell.expose();
    REQUIRE(cell.ends.size() == 3);
  }
  SECTION("at once where the camera is lost") {
    cell.script.events.push_back(CameraLost{"gone"});
    cell.step();
    REQUIRE(cell.ends.size() == 1);  // the same three times, of which the bus gives out one
  }
  REQUIRE(cell.scans.back().state == scan_t::ENDED);
  CHECK(cell.images.size() == 3);
  for (const image_t& end : cell.ends) {
    CHECK(end.run_id == 55);
    CHECK(end.seq > cell.scans.back().last_seq);
    CHECK(end.utime > cell.images.back().utime);
    CHECK(end.scan_index == -1);
    CHECK(end.size == 0);
    CHECK_FALSE(end.incomplete.empty());
  }
}

TEST_CASE("sensor_capture: the clock's mapping stands still while a scan runs") {
  ScriptedCell cell;
  cell.find_camera();
  Frame late = cell.make_frame();
  late.arrival_utime += 3'000;  // so far the shortest delay is 3 ms
  cell.script.events.push_back(late);
  cell.step();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.settle();
  cell.expose();
  cell.expose();
  REQUIRE_FALSE(cell.images.empty());
  for (const image_t& image : cell.images)
    CHECK(image.utime ==
          image.device_time_ns / 1000 - kDeviceAhead + 3'000 + kScriptedExposure / 2);
}

TEST_CASE("sensor_capture: a start without a camera is refused, with why") {
  ScriptedCell cell;
  cell.script.events.push_back(CameraLost{"camera 10.0.0.2 is lost: no frame for 0.7 s"});
  cell.step();
  CHECK(cell.app->health().state == service_status_t::FAULT);
  CHECK(cell.app->health().last_error.find("10.0.0.2") != std::string::npos);
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.scans.back().state == scan_t::IDLE);
  CHECK(cell.scans.back().refused_command_id == 7);
  CHECK(cell.scans.back().refusal.find("10.0.0.2") != std::string::npos);
  CHECK(cell.script.requests.empty());
}

TEST_CASE("sensor_capture: a camera lost in a scan ends it; found again it is dark") {
  ScriptedCell cell;
  CHECK(cell.app->health().state == service_status_t::STARTING);
  cell.find_camera();
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  REQUIRE(cell.images.size() == 1);
  cell.script.events.push_back(CameraLost{"gone"});
  cell.step();
  CHECK(cell.scans.back().state == scan_t::ENDED);
  CHECK(cell.scans.back().end_cause == scan_t::CAMERA_LOST);
  CHECK(cell.scans.back().end_reason == "camera lost");
  CHECK(cell.scans.back().last_seq == cell.images.back().seq);
  CHECK(cell.app->health().state == service_status_t::FAULT);
  const std::size_t requests = cell.script.requests.size();
  cell.step();
  CHECK(cell.script.requests.size() == requests);  // nobody is there to ask

  cell.find_camera();
  CHECK(cell.script.requests.size() == requests + 1);
  CHECK_FALSE(cell.laser_asked());
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  cell.expose();
  CHECK(cell.images.size() == 1);
  CHECK(cell.scans.back().state == scan_t::ENDED);
  // Whatever it may have been asked before: a camera that is found is told to be dark.
  cell.script.events.push_back(CameraLost{"gone again"});
  cell.find_camera();
  CHECK(cell.script.requests.size() == requests + 2);
}

TEST_CASE("sensor_capture: incomplete frames go out without bytes, with the reason") {
  ScriptedCell cell;
  cell.find_camera();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  Frame bad = cell.make_frame();
  bad.pixels.clear();
  bad.width = bad.height = bad.offset_u = bad.offset_v = 0;
  bad.incomplete = "packets are missing";
  cell.script.events.push_back(bad);
  cell.step();
  REQUIRE(cell.images.size() == 2);
  CHECK(cell.images[1].incomplete == "packets are missing");
  CHECK(cell.images[1].size == 0);
  CHECK(cell.images[1].scan_index == 1);
  CHECK(cell.scans.back().lost <= 1);
  cell.scan_command(8, scan_command_t::STOP);
  cell.settle();
  cell.expose();
  CHECK(cell.scans.back().lost == 1);
  CHECK(cell.scans.back().images == 2);
  CHECK(cell.app->health().received == 0);  // the source's own counts are told
  cell.script.counts = {10, 2, 3};
  CHECK(cell.app->health().received == 10);
  CHECK(cell.app->health().lost == 5);
}

TEST_CASE("sensor_capture: png carries the same pixels") {
  SensorCaptureSettings settings;
  settings.encoding = "png";
  ScriptedCell cell(settings);
  cell.find_camera();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  REQUIRE(cell.images.size() == 1);
  CHECK(cell.images[0].encoding == image_t::PNG);
  const cv::Mat image = cv::imdecode(cell.images[0].data, cv::IMREAD_UNCHANGED);
  REQUIRE(image.type() == CV_8U);
  CHECK(image.cols == 8);
  CHECK(image.rows == 4);
  CHECK(cv::countNonZero(image != static_cast<int>(cell.images[0].seq)) == 0);
}

TEST_CASE("sensor_capture: a laser that is wired to the camera counts as lit") {
  ScriptedCell cell;
  CameraFound found;
  found.settings = {kScriptedExposure, 0, false};
  found.wired_laser = true;
  cell.script.events.push_back(found);
  cell.step();
  cell.answer();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  REQUIRE(cell.images.size() == 1);
  CHECK(cell.images[0].laser_on);
}

TEST_CASE("sensor_capture: the robot's standing still ends a scan where so configured") {
  SensorCaptureSettings settings;
  settings.end_when_still = true;
  settings.still_duration_s = 0.1;
  ScriptedCell cell(settings);
  cell.find_camera();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  const std::int64_t begin = cell.scans.back().scan_id;
  const auto publish = [&](std::int64_t utime, double x, const char* invalid) {
    robot_pose_t pose{};
    pose.utime = utime;
    pose.run_id = 1;
    pose.position[0] = x;
    pose.quaternion[0] = 1;
    pose.invalid = invalid;
    cell.bus->publish("ROBOT0_POSE", pose);
  };
  for (int i = 0; i < 10; ++i) publish(begin + 10'000 * (i + 1), 10.0 * i, "clock");
  for (int i = 0; i < 30; ++i) publish(begin + 10'000 * (i + 1), 0, "");
  cell.step();
  CHECK(cell.laser_asked());
  for (int i = 30; i < 42; ++i) publish(begin + 10'000 * (i + 1), 5, "");
  cell.step();
  CHECK_FALSE(cell.laser_asked());
}

TEST_CASE(
    "sensor_capture: the state is repeated 5 times a second; the camera is let go at the end") {
  ScriptedCell cell;
  cell.find_camera();
  const std::size_t before = cell.scans.size();
  const std::int64_t begin = steady_now();
  while (steady_now() - begin < 1'000'000) {
    cell.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto told = static_cast<std::int64_t>(cell.scans.size() - before);
  CHECK(told >= 1);
  CHECK(told <= 1 + (steady_now() - begin) / 200'000);
  CHECK_FALSE(cell.script.stopped);
  cell.app.reset();
  CHECK(cell.script.stopped);
}
