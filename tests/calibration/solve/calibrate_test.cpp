#include "services/calibration/solve/calibrate.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "services/calibration/files/view_detection.hpp"
#include "services/cell_simulator/base/random_stream.hpp"
#include "tests/calibration/support/simulated_set.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::cell_simulator;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

bool names(const CalibrationRun& run, int index, const std::string& why) {
  return std::any_of(run.left_out.begin(), run.left_out.end(), [&](const LeftOutView& view) {
    return view.index == index && view.why.find(why) != std::string::npos;
  });
}

// The well-spread set as an erring robot says it; made once.
const CalibrationRun& ordinary_run() {
  static const CalibrationRun run =
      calibrated(well_spread_set(), well_spread_set().said(0.1, 0.01));
  return run;
}

}  // namespace

TEST_CASE("with a robot that does not err the set is the simulated sensor's") {
  const SimulatedSet& set = well_spread_set();
  const CalibrationRun run = calibrated(set, set.said(0, 0));
  REQUIRE(run.refused.empty());
  CHECK(run.left_out.empty());
  const AdjustmentState& state = run.adjustment.state;
  const TrueSensor& truth = set.images.sensor();
  CHECK(set.end_to_end(run) < 0.015);
  CHECK((state.T_tool_camera.translation() - truth.T_tool_camera.translation()).norm() < 0.06);
  CHECK(state.model.fx == Approx(truth.fx).epsilon(2e-4));
  CHECK(std::abs(state.model.distortion[0] - truth.distortion[0]) < 0.01);
  CHECK(angle_between(state.model.laser_plane.normal, truth.laser_normal) < 5e-4);
  CHECK(state.model.laser_plane.offset == Approx(truth.laser_offset).margin(0.02));
  CHECK(run.crossings > 20);
  CHECK(run.crossing_rms_mm < 0.1);
}

TEST_CASE("a robot that errs is found out, and the deviation predicted fits what came",
          "[figures]") {
  const SimulatedSet& set = well_spread_set();
  double squares = 0, predicted = 0;
  constexpr int kSeeds = 5;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const CalibrationRun run = calibrated(set, set.said(0.1, 0.01, seed));
    REQUIRE(run.refused.empty());
    CHECK(run.adjustment.deviations.robot_mm == Approx(0.1).epsilon(0.35));
    CHECK(run.adjustment.deviations.robot_rad == Approx(0.01 * EIGEN_PI / 180).epsilon(0.35));
    squares += std::pow(set.end_to_end(run), 2);
    std::vector<Eigen::Vector2d> pixels;
    for (const ProbePoint& probe : probe_points(set.images.sensor())) pixels.push_back(probe.pixel);
    predicted +=
        std::pow(predicted_rms(run.adjustment.state, run.adjustment.covariance, pixels), 2);
  }
  CHECK(std::sqrt(squares / kSeeds) < 0.1);
  CHECK(std::sqrt(predicted / squares) > 0.6);
  CHECK(std::sqrt(predicted / squares) < 1.6);
}

TEST_CASE("the order of the images does not matter", "[figures]") {
  const SimulatedSet& set = well_spread_set();
  std::vector<View> views = set.said(0.1, 0.01);
  std::reverse(views.begin(), views.end());
  const CalibrationRun reversed = calibrated(set, views);
  CHECK((ordinary_run().adjustment.state.T_tool_camera.translation() -
         reversed.adjustment.state.T_tool_camera.translation())
            .norm() < 1e-3);
}

TEST_CASE("two poses exchanged are named and left out") {
  const SimulatedSet& set = well_spread_set();
  std::vector<View> views = set.said(0.1, 0.01);
  const double clean = set.end_to_end(ordinary_run());
  std::swap(views[4].T_base_tool, views[11].T_base_tool);
  const CalibrationRun run = calibrated(set, views);
  CHECK(names(run, 5, "orientation"));
  CHECK(names(run, 12, "orientation"));
  CHECK(run.left_out.size() == 2);
  CHECK(set.end_to_end(run) < 1.5 * clean + 0.01);
}

TEST_CASE("one wrong pose is named, left out and does no harm", "[figures]") {
  const SimulatedSet& set = well_spread_set();
  std::vector<View> views = set.said(0.1, 0.01);
  const std::size_t wrong = 7;
  static const double clean = [&] {  // for all sections
    std::vector<View> without = views;
    without.erase(without.begin() + wrong);
    return set.end_to_end(calibrated(set, without));
  }();

  SECTION("another pose's") { views[wrong].T_base_tool = views[wrong + 1].T_base_tool; }
  SECTION("2 mm aside") { views[wrong].T_base_tool.translation().x() += 2; }
  SECTION("the plate turned about its middle") {
    // What a plate put down the other way round shows: the same points of another robot's pose.
    RigidTransform turn = RigidTransform::Identity();
    turn.linear() = Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    turn.translation() = Eigen::Vector3d(108, 96, 0);
    views[wrong].T_base_tool =
        true_T_base_plate() * turn * true_T_base_plate().inverse() * views[wrong].T_base_tool;
  }
  const CalibrationRun run = calibrated(set, views);
  REQUIRE(run.refused.empty());
  CHECK(run.left_out.size() == 1);
  CHECK(names(run, static_cast<int>(wrong) + 1, "the robot's"));
  CHECK(set.end_to_end(run) < 1.1 * clean);
}

TEST_CASE("an image under glare is named and left out") {
  SimulatedSet set({}, 0);  // whose views are those rendered already
  set.poses = well_spread_set().poses;
  set.views = well_spread_set().views;
  const std::size_t glared = 3;
  std::vector<View> without = set.said(0.1, 0.01);
  without.erase(without.begin() + glared);
  const double clean = set.end_to_end(calibrated(set, without));
  // Over the edges of the dots about a point of the grid.
  const Eigen::Vector2d middle = set.views[glared].target[22] + Eigen::Vector2d(14, 9);
  auto grid = set.images.grid(set.poses[glared], 1, {middle, 22});
  auto laser = set.images.laser(set.poses[glared], 1);
  const int width = set.images.sensor().width, height = set.images.sensor().height;
  set.views[glared] = detect_view({set.views[glared].index, "", "", set.views[glared].T_base_tool},
                                  set.plate(), cv::Mat(height, width, CV_8U, grid.data()),
                                  cv::Mat(height, width, CV_8U, laser.data()));
  const CalibrationRun run = calibrated(set, set.said(0.1, 0.01));
  CHECK(run.left_out.size() == 1);
  CHECK(names(run, static_cast<int>(glared) + 1, "glare"));
  CHECK(set.end_to_end(run) < 1.1 * clean);
}

TEST_CASE("poses that cannot tell are refused, with what is missing") {
  const SimulatedSet& set = well_spread_set();
  SECTION("too few") {
    std::vector<View> few = set.said(0.1, 0.01);
    few.resize(4);
    CHECK_THAT(calibrated(set, few).refused, Contains("at least 5"));
  }
  SECTION("hardly tilted") {
    PoseRange flat;
    flat.least_tilt_deg = 0;
    flat.most_tilt_deg = 4;
    const SimulatedSet level({}, 12, 77, flat);
    CHECK_THAT(calibrated(level, level.said(0.1, 0.01)).refused, Contains("tilt"));
  }
  SECTION("turned about one axis") {
    SimulatedSet one_axis({}, 0, 78);
    const Eigen::Vector3d middle(54, 48, 0);
    for (const double tilt : {-35, -25, -15, -5, 5, 15, 25, 35}) {
      RigidTransform pose = RigidTransform::Identity();
      pose.linear() =
          Eigen::AngleAxisd(tilt * EIGEN_PI / 180, Eigen::Vector3d::UnitX()).toRotationMatrix();
      pose.translation() =
          Eigen::Vector3d(tilt / 10, -tilt / 15, 300 + tilt) - pose.linear() * middle;
      one_axis.poses.push_back(pose);
    }
    one_axis.views = rendered_views(one_axis.images, one_axis.printed, one_axis.poses, 78);
    CHECK_THAT(calibrated(one_axis, one_axis.said(0.1, 0.01)).refused, Contains("one axis"));
  }
}

TEST_CASE("poses poorly spread are answered, and told how they would do better", "[figures]") {
  PrintedPlate plate;
  plate.columns = 11;
  plate.rows = 9;
  plate.staggered = false;
  PoseRange narrow;
  narrow.least_tilt_deg = 0;
  narrow.most_tilt_deg = 25;
  narrow.roll_deg = 12;
  const SimulatedSet set(plate, 20, 503, narrow);
  const CalibrationRun run = calibrated(set, set.said(0.1, 0.01));
  REQUIRE(run.refused.empty());
  CHECK(set.end_to_end(run) < 0.6);
  REQUIRE(run.advice.size() >= 2);
  CHECK_THAT(run.advice[0] + run.advice[1], Contains("tilt") && Contains("roll"));
}

TEST_CASE("a grid that looks the same upside down is settled by the robot's turns") {
  PrintedPlate plate;
  plate.columns = 8;
  plate.rows = 7;
  plate.staggered = false;
  SimulatedSet set(plate, 12, 504);
  for (std::size_t i = 0; i < set.views.size(); i += 2)
    std::reverse(set.views[i].target.begin(), set.views[i].target.end());
  const CalibrationRun run = calibrated(set, set.said(0.05, 0.005));
  REQUIRE(run.refused.empty());
  CHECK(run.left_out.empty());
  CHECK(set.end_to_end(run) < 0.15);
}

TEST_CASE("a bent plate is seen, a flat one is not called bent", "[figures]") {
  PrintedPlate bent;
  bent.bend_mm = 0.3;
  const SimulatedSet set(bent, 14, 505);
  const CalibrationRun run = calibrated(set, set.said(0.1, 0.01));
  REQUIRE(run.refused.empty());
  CHECK(run.flatness.bend_mm > 0.15);
  CHECK(run.flatness.bend_mm < 0.45);
  CHECK(std::any_of(run.warnings.begin(), run.warnings.end(),
                    [](const auto& w) { return w.find("not flat") != std::string::npos; }));
  const CalibrationRun& flat = ordinary_run();
  CHECK(flat.flatness.bend_mm < 0.05);
  CHECK(flat.warnings.empty());
}

TEST_CASE("what the set never saw lies where it predicts", "[figures]") {
  const SimulatedSet& set = well_spread_set();
  const CalibrationRun run = calibrated(set, set.said(0.1, 0.01), true);
  // A left-out pose errs by itself (0.1 mm and 0.01 deg at 300 mm) beside the set's own error.
  CHECK(run.left_one_out.laser_rms_mm > 0.05);
  CHECK(run.left_one_out.laser_rms_mm < 0.3);
  CHECK(run.left_one_out.laser_rms_mm < 1.1 * run.plain_left_one_out.laser_rms_mm);
  CHECK(run.field.size() > 20);
}

TEST_CASE("a plate of another size than it is said to have is told from the robot's moves",
          "[figures]") {
  const SimulatedSet& set = well_spread_set();
  const auto views = set.said(0.1, 0.01);
  Target plate = set.plate();
  const auto scaled = [&](double factor) {
    plate.pitch_mm = factor * set.printed.pitch_mm;
    plate.radius_mm = factor * set.printed.dot_radius_mm;
    CalibrateOptions options;
    options.leave_one_out = false;
    return calibrate(plate, views, 800, 600, options);
  };
  CHECK(scaled(1).warnings.empty());
  const CalibrationRun printed_larger = scaled(1 / 1.02);
  CHECK(printed_larger.scale.factor == Approx(1.02).epsilon(1e-3));
  REQUIRE(!printed_larger.warnings.empty());
  CHECK_THAT(printed_larger.warnings[0], Contains("pitch_mm of 12 "));
  CHECK_THAT(scaled(0.1).refused, Contains("the plate's lengths in centimetres"));
}

TEST_CASE("another light taken for the stripe is named and does no harm", "[figures]") {
  const SimulatedSet& set = well_spread_set();
  std::vector<View> views = set.said(0.1, 0.01);
  const double clean = set.end_to_end(calibrated(set, views));
  for (Eigen::Vector2d& centre : views[9].stripe) centre.y() += 40;
  const CalibrationRun run = calibrated(set, views);
  REQUIRE(run.refused.empty());
  REQUIRE(run.warnings.size() == 1);
  CHECK_THAT(run.warnings[0], Contains("pose 10: its stripe"));
  CHECK(run.left_out.empty());
  CHECK(set.end_to_end(run) < 1.1 * clean + 0.002);
}
