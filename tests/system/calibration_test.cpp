// A cell that calibrates itself: plate, robot that errs, real processes; and then finds the seam
// with what it found.
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>

#include "paths.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/calibration/sweeps/time_offset.hpp"
#include "services/cell_simulator/cell_simulator_settings.hpp"
#include "services/command_line/output/seam_error.hpp"
#include "tests/bench/calibration/simulated_plate.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::cell_simulator;
using namespace arcstart::command_line;
namespace fs = std::filesystem;

namespace {

void calibrate_and_scan(int seed) {
  const std::string plate = std::string(ARCSTART_SOURCE) + "/scripts/simulated_plate.yaml";
  const std::string name = "calibration_" + std::to_string(seed);
  const std::string set = std::string(ARCSTART_BUILD) + "/tests/system/" + name + "/set";
  RunningCell cell(
      name, {"calibration.plate: " + plate, "calibration.folder: " + set, "calibration.tool: TCP1",
             "cell_simulator.robot_error_mm: 0.1", "cell_simulator.robot_error_deg: 0.01"});
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  const std::string file = cell.folder() + "/LASER0.calibration.yaml";
  const Calibration before = read_calibration_file(file);

  const Output output =
      run({program("arcstart"), "calibrate", "--live", "--seed", std::to_string(seed)}, 600);
  INFO(output.err);
  REQUIRE(output.code == 0);
  CHECK_THAT(output.out, Catch::Contains("in force"));
  const Calibration found = read_calibration_file(file);
  CHECK(found.id != before.id);
  CHECK(found.time_offset == before.time_offset);
  const double error = test::end_to_end(found.sensor_model, found.T_tool_camera,
                                        test::probe_points(make_true_sensor(SensorSettings{})));
  WARN("seed " << seed << ": end to end " << error << " mm RMS; " << output.out);
  CHECK(error < 0.2);  // twice what is claimed of the mean over seeds
  CHECK(fs::file_size(set + "/calibration.html") > 10000);

  // From what was captured, the same again without the cell.
  const Output again = run({program("arcstart"), "calibrate", set, "-o",
                            cell.folder() + "/again.yaml", "--tool", "TCP1"},
                           120);
  CHECK(again.code == 0);
  const Calibration repeated = read_calibration_file(cell.folder() + "/again.yaml");
  CHECK((repeated.T_tool_camera.translation() - found.T_tool_camera.translation()).norm() < 1e-3);

  // The cell works with it.
  ARCSTART_REQUIRE_OF(cell, cell.change_scene(false, seed));
  ARCSTART_REQUIRE_OF(cell, cell.scan(scan_t::BACKGROUND));
  ARCSTART_REQUIRE_OF(cell, cell.change_scene(true, seed));
  ARCSTART_REQUIRE_OF(cell, cell.finds_right_seam());
  REQUIRE_FALSE(cell.heard().seams.empty());
  const seam_t& seam = cell.heard().seams.back();
  CHECK(seam.calibration_id == found.id);
  if (seam.verdict != seam_t::FOUND) return;  // the machine did not keep up
  const SeamError wrong_by = seam_error(seam, *cell.heard().truth);
  WARN("start " << wrong_by.start_mm << " mm, lateral " << wrong_by.lateral_mm << " mm");
  CHECK(wrong_by.lateral_mm < 0.6);
  CHECK(wrong_by.start_mm < 2);  // half a stripe spacing, and what the calibration errs
}

}  // namespace

TEST_CASE("the cell calibrates itself and finds the seam with the result") {
  calibrate_and_scan(1);
}

TEST_CASE("the same with other seeds", "[long]") { calibrate_and_scan(GENERATE(2, 3)); }

// What an image's stamp must be moved by to look up its position: from the devices' own clocks,
// which the simulator starts at one instant and whose rates are known. Median over all; s.
double true_time_offset(const Heard& heard, const CellSimulatorSettings& settings) {
  const auto median = [](std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  const double begin = static_cast<double>(heard.poses.front().utime);  // keeps the digits
  std::vector<double> of_poses, of_images;  // stamp less true time since the simulator's start; us
  for (const robot_pose_t& pose : heard.poses)
    of_poses.push_back(static_cast<double>(pose.utime) - begin -
                       (static_cast<double>(pose.device_clock) * pose.device_tick_us -
                        1e6 * settings.robot_clock_start_s) /
                           (1 + 1e-6 * settings.robot_clock_drift_ppm));
  for (const image_t& image : heard.images)
    of_images.push_back(
        static_cast<double>(image.utime) - begin - image.exposure_us / 2 -
        (static_cast<double>(image.device_time_ns) * 1e-3 - 1e6 * settings.camera_clock_start_s) /
            (1 + 1e-6 * settings.camera_clock_drift_ppm));
  return 1e-6 * (median(of_poses) - median(of_images));
}

// Camera's and robot's clocks, their mapping to the host and the network are in it as in a real
// cell.
TEST_CASE("the cell's time offset is found from sweeps of the real processes") {
  RunningCell cell("time_offset", {"cell_simulator.search_rise_mm: 100",
                                   "cell_simulator.further_sweeps_mm_s: [50, 120, 120]"});
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  cell.forget();
  cell.machine_kept_up();
  ARCSTART_REQUIRE_OF(cell, cell.scan(scan_t::BACKGROUND, 90));
  const bool kept_up = cell.machine_kept_up();  // else stamps come late
  SweepData record;
  for (const robot_pose_t& pose : cell.heard().poses)
    record.trajectory.insert(pose.utime, transform_from_arrays(pose.position, pose.quaternion));
  for (const stripe_t& message : cell.heard().stripes) {
    SweepProfile stripe{message.utime, message.scan_id, {}};
    for (std::size_t i = 0; i < message.u.size(); ++i) {
      if (message.rank[i] != stripe_t::CHOSEN) continue;
      if (i == 0 || message.segment[i] != message.segment[i - 1]) stripe.segments.emplace_back();
      if (stripe.segments.empty()) stripe.segments.emplace_back();
      stripe.segments.back().push_back({message.u[i], message.v[i]});
    }
    if (!stripe.segments.empty()) record.stripes.push_back(stripe);
  }
  Calibration calibration = read_calibration_file(cell.folder() + "/LASER0.calibration.yaml");
  const double truth = true_time_offset(cell.heard(), {});
  calibration.time_offset = 0;
  const TimeOffset found = find_time_offset(record, calibration);
  INFO(found.refused << " " << record.stripes.size() << " stripes");
  if (kept_up) REQUIRE(found.refused.empty());
  WARN("time offset " << 1e3 * found.offset_s << " ms, deviation " << 1e3 * found.deviation_s
                      << " ms; by the devices' clocks it is " << 1e3 * truth << " ms");
  if (!kept_up) return;
  CHECK(found.offset_s == Approx(truth).margin(0.6e-3));
  CHECK(found.deviation_s < 0.3e-3);
}
