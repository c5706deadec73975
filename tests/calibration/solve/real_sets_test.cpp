// Real robots' data: what was reached before is kept. Skipped, and said, where the data are not
// there.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "paths.hpp"
#include "services/calibration/files/calibration_set.hpp"
#include "services/calibration/files/target_file.hpp"
#include "services/calibration/files/view_detection.hpp"
#include "services/calibration/solve/calibrate.hpp"
#include "services/calibration/solve/calibration_result.hpp"
#include "services/calibration/stages/pose_slips.hpp"
#include "services/command_line/imports/calibration_source.hpp"
#include "services/extraction/files/image_file.hpp"
#include "tests/calibration/support/usual_pose_slips.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::extraction;
namespace fs = std::filesystem;

namespace {

std::string data(const std::string& name) {
  const char* folder = std::getenv("ARCSTART_DATA");
  return (folder ? std::string(folder) : ARCSTART_SOURCE "/../shared/data") + "/" + name;
}

// The set as arcstart import calibration makes it; nothing where the data are missing.
std::optional<CalibrationRun> run(const std::string& kind, const std::string& name,
                                  CalibrationSet& set, const CalibrateOptions& options = {}) {
  if (!fs::is_directory(data(name))) {
    WARN("skipped: " << data(name) << " is not there; set ARCSTART_DATA");
    return std::nullopt;
  }
  const fs::path folder = fs::temp_directory_path() / ("arcstart_real_" + name);
  fs::remove_all(folder);
  const std::string plate = folder.string() + "_plate.yaml";
  std::ofstream(plate) << (kind == "etna" ? "pattern: chessboard\ncolumns: 7\nrows: 6\n"
                                            "pitch_mm: 10\n"
                                          : "pattern: circles\ncolumns: 10\nrows: 10\n"
                                            "pitch_mm: 25.4\nradius_mm: 6.35\n"
                                            "origin_dot_radius_mm: 12.7\n");
  std::vector<std::string> notes;
  command_line::write_calibration_folder(
      command_line::read_calibration_source(data(name), plate, {"xyzw", "m"}, notes),
      folder.string());
  fs::remove(plate);
  set = read_calibration_set(folder.string());
  std::vector<View> views;
  cv::Mat grey;
  for (const CalibrationPose& pose : set.poses) {
    grey = read_luminance(pose.grid);
    views.push_back(detect_view(pose, set.plate, grey, grey));
    if (kind == "industrial") views.back().stripe.clear();
  }
  fs::remove_all(folder);
  return calibrate(set.plate, views, grey.cols, grey.rows, options);
}

// Robot's poses and where the images of etna_calib3 show the plate.
std::vector<PairedPose> etna_poses(CalibrationSet& set) {
  CalibrateOptions options;
  options.leave_one_out = false;
  const auto result = run("etna", "etna_calib3", set, options);
  if (!result) return {};
  std::vector<PairedPose> poses;
  for (const CalibrationPose& pose : set.poses) {
    poses.push_back({pose.T_base_tool, {}});
    for (std::size_t i = 0; i < result->views.size(); ++i)
      if (result->views[i].index == pose.index)
        poses.back().T_camera_plate = result->camera.T_camera_plate[i];
  }
  return poses;
}

}  // namespace

TEST_CASE("etna_calib3: what the calibration never saw lies within 0.43 mm", "[figures]") {
  CalibrationSet set;
  const auto result = run("etna", "etna_calib3", set);
  if (!result) return;
  REQUIRE(result->refused.empty());
  CHECK(result->views.size() == 13);
  CHECK(result->camera.rms <= 0.63);
  CHECK(result->adjustment.laser_rms <= 0.13);
  CHECK(result->left_one_out.laser_rms_mm <= 0.43);
  CHECK(result->left_one_out.laser_rms_mm < result->plain_left_one_out.laser_rms_mm);
}

TEST_CASE("etna_calib4: what the calibration never saw lies within 0.62 mm") {
  CalibrationSet set;
  const auto result = run("etna", "etna_calib4", set);
  if (!result) return;
  REQUIRE(result->refused.empty());
  CHECK(result->views.size() == 9);
  CHECK(result->camera.rms <= 0.21);
  CHECK(result->adjustment.laser_rms <= 0.13);
  CHECK(result->left_one_out.laser_rms_mm <= 0.62);
  CHECK(result->left_one_out.laser_rms_mm < result->plain_left_one_out.laser_rms_mm);
}

TEST_CASE("circle_grid_10x10: bad robot data are recognised and said", "[figures]") {
  CalibrationSet set;
  const auto result = run("industrial", "circle_grid_10x10", set);
  if (!result) return;
  REQUIRE(result->refused.empty());
  CHECK(result->camera.rms < 0.25);
  CHECK(result->adjustment.deviations.robot_mm > 2);
  CHECK(result->left_one_out.target_rms_mm < 7.1);
  CHECK(result->left_one_out.target_rms_mm < result->plain_left_one_out.target_rms_mm);
  const auto missed = missed_limits(*result, {});
  REQUIRE(!missed.empty());
  CHECK_THAT(missed[0], Catch::Matchers::Contains("robot data do not fit the images"));
}

TEST_CASE("slips in a real robot's poses are named") {
  CalibrationSet set;
  const std::vector<PairedPose> right = etna_poses(set);
  if (right.empty()) return;
  CHECK(pose_slip(set.plate, right).empty());
  for (const test::PoseSlip& slip : test::usual_pose_slips()) {
    std::vector<PairedPose> poses = right;
    for (PairedPose& pose : poses) slip.change(pose.T_base_tool);
    INFO(slip.named);
    CHECK_THAT(pose_slip(set.plate, poses), Catch::Matchers::Contains(slip.named));
  }
  // As others' programs wrote them.
  const std::string folder = data("cases/outside/pose_conventions");
  for (const auto& [name, words] : std::vector<std::pair<std::string, std::string>>{
           {"inverted", "base lies in the tool"},
           {"lefthanded", "mirrored"},
           {"eulerXYZ", "the three angles turned in the order Rz Ry Rx"},
           {"eulerzyx", "first and third angle exchanged"},
           {"degasrad", "degrees, which were read as radians"},
           {"wpr_as_rotvec", "W, P, R, which were read as a rotation vector"},
           {"shift1", "the pose before the one"}}) {
    const auto said = read_poses_file(folder + "/poses_" + name + ".csv");
    std::vector<PairedPose> poses;
    for (std::size_t i = 0; i < right.size(); ++i)
      if (const auto at = said.find(set.poses[i].index); at != said.end())
        poses.push_back({at->second, right[i].T_camera_plate});
    INFO(name);
    CHECK_THAT(pose_slip(set.plate, poses), Catch::Matchers::Contains(words));
  }
}
