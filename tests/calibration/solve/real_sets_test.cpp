// Real robots' data: what was reached before is kept. Skipped, and said, where the data are not
// there.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "paths.hpp"
#include "services/calibration/files/calibration_set.hpp"
#include "services/calibration/files/view_detection.hpp"
#include "services/calibration/solve/calibrate.hpp"
#include "services/calibration/solve/calibration_result.hpp"
#include "services/extraction/files/image_file.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::extraction;
namespace fs = std::filesystem;

namespace {

std::string data(const std::string& name) {
  const char* folder = std::getenv("ARCSTART_DATA");
  return (folder ? std::string(folder) : ARCSTART_SOURCE "/../shared/data") + "/" + name;
}

// The set as scripts/import-calibration-images makes it; nothing where the data are missing.
std::optional<CalibrationRun> run(const std::string& kind, const std::string& name,
                                  const std::string& channel, CalibrationSet& set) {
  if (!fs::is_directory(data(name))) {
    WARN("skipped: " << data(name) << " is not there; set ARCSTART_DATA");
    return std::nullopt;
  }
  const fs::path folder = fs::temp_directory_path() / ("arcstart_real_" + name);
  fs::remove_all(folder);
  REQUIRE(std::system((ARCSTART_SOURCE "/scripts/import-calibration-images " + kind + " " +
                       data(name) + " " + folder.string() + " >/dev/null")
                          .c_str()) == 0);
  set = read_calibration_set(folder.string());
  std::vector<View> views;
  cv::Mat grey;
  for (const CalibrationPose& pose : set.poses) {
    grey = read_grey_image(pose.grid, channel);
    views.push_back(detect_view(pose, set.plate, grey, grey));
    if (kind == "industrial") views.back().stripe.clear();
  }
  fs::remove_all(folder);
  return calibrate(set.plate, views, grey.cols, grey.rows);
}

}  // namespace

TEST_CASE("etna_calib3: what the calibration never saw lies within 0.43 mm", "[figures]") {
  CalibrationSet set;
  const auto result = run("etna", "etna_calib3", "", set);
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
  const auto result = run("etna", "etna_calib4", "", set);
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
  const auto result = run("industrial", "circle_grid_10x10", "g", set);
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
