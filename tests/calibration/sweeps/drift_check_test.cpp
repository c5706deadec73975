// The check without a plate, on scans of the simulated cell from several sides.
#include "services/calibration/sweeps/drift_check.hpp"

#include <catch2/catch.hpp>

#include "services/calibration/sweeps/ball_fit.hpp"
#include "services/cell_simulator/base/random_stream.hpp"
#include "tests/bench/calibration/simulated_sweeps.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::cell_simulator;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kLimit = 0.3;  // mm

// One sweep from each of these sides.
SweepData scans(SimulatedSweepsSettings settings, const std::vector<double>& sides_deg) {
  settings.kind = SceneKind::workpiece;
  settings.scene.tool_lying_about = false;
  settings.scene.search_begin_mm = -50;
  settings.scene.search_end_mm = 50;
  settings.speeds_mm_s = {30};
  SweepData record;
  for (const double side : sides_deg) {
    settings.scene.search_turn_deg = side;
    append_sweeps(record, settings, 801);
  }
  return record;
}

SimulatedSweepsSettings ball_settings() {
  SimulatedSweepsSettings settings;
  settings.sensor.image_width_px = 800;
  settings.sensor.image_height_px = 600;
  settings.scene.ball_radius_mm = 20;
  return settings;
}

SimulatedSweepsSettings joint_settings() {
  SimulatedSweepsSettings settings = ball_settings();
  settings.scene.ball_radius_mm = 0;
  return settings;
}

// What may go wrong with a sensor that was knocked.
std::vector<std::pair<const char*, Calibration>> knocked(const Calibration& right) {
  std::vector<std::pair<const char*, Calibration>> all;
  Calibration shifted = right;
  shifted.T_tool_camera.pretranslate(Eigen::Vector3d(0.6, 0.6, 0.5));  // 1 mm
  all.emplace_back("shifted", shifted);
  Calibration turned = right;
  turned.T_tool_camera.linear() =
      turned.T_tool_camera.linear() *
      Eigen::AngleAxisd(0.5 * EIGEN_PI / 180, Eigen::Vector3d(1, 1, 0).normalized());
  all.emplace_back("turned", turned);
  Calibration tilted = right;
  Plane& laser = tilted.sensor_model.laser_plane;
  const Eigen::Vector3d hinge(0, 0, 300);  // it stays where it is at the stand-off
  laser.normal = Eigen::AngleAxisd(1 * EIGEN_PI / 180, Eigen::Vector3d::UnitX()) * laser.normal;
  laser.offset = -laser.normal.dot(hinge);
  all.emplace_back("laser tilted", tilted);
  return all;
}

}  // namespace

TEST_CASE("a ball is found among other points, its centre and radius without bias") {
  RandomStream random(5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 4000; ++i)
    points.push_back({random.uniform(-80, 80), random.uniform(-80, 80), 0.1 * random.normal()});
  const Eigen::Vector3d centre(12, -7, 20);
  for (int i = 0; i < 500; ++i) {
    Eigen::Vector3d way(random.normal(), random.normal(), random.normal());
    way.z() = std::abs(way.z());
    points.push_back(centre + (20 + 0.05 * random.normal()) * way.normalized());
  }
  const auto ball = find_ball(points, 20, 0.5);
  REQUIRE(ball);
  CHECK((ball->centre - centre).norm() < 0.02);
  CHECK(ball->radius_mm == Approx(20).margin(0.02));
  CHECK(ball->rms_mm == Approx(0.05).margin(0.02));
  points.resize(4000);
  CHECK_FALSE(find_ball(points, 20, 0.5));
}

TEST_CASE("a ball scanned from two sides passes the true calibration and tells a knocked one",
          "[figures]") {
  const SimulatedSweepsSettings settings = ball_settings();
  const SweepData record = scans(settings, {0, 180});
  const Calibration right = true_calibration(settings);
  const DriftCheck good = check_on_ball(record, right, 20);
  REQUIRE(good.refused.empty());
  CHECK(good.warnings.empty());
  CHECK(good.views.size() == 2);
  CHECK(good.turn_deg == Approx(180).margin(0.1));
  CHECK(good.shift_shown(1) == Approx(1).margin(1e-3));
  CHECK(good.shift_shown(2) == Approx(0).margin(1e-3));
  CAPTURE(good.place_mm, good.radius_mm, good.shape_mm);
  CHECK(good.error_mm < 0.1);
  CHECK((good.views[0].centre - Eigen::Vector3d(950, 0, 20)).norm() < 0.1);
  CHECK(drift(good, kLimit).empty());
  for (const auto& [what, wrong] : knocked(right)) {
    const DriftCheck found = check_on_ball(record, wrong, 20);
    CAPTURE(what, found.place_mm, found.radius_mm, found.shape_mm, found.refused);
    CHECK_THAT(drift(found, kLimit), Contains("limit"));
  }
}

TEST_CASE("a ball seen from one side alone says what it cannot tell, another ball is not found") {
  const SimulatedSweepsSettings settings = ball_settings();
  const SweepData record = scans(settings, {0});
  const Calibration right = true_calibration(settings);
  const DriftCheck one_side = check_on_ball(record, right, 20);
  REQUIRE(one_side.refused.empty());
  REQUIRE(one_side.warnings.size() == 1);
  CHECK_THAT(one_side.warnings[0], Contains("second side"));
  CHECK_THAT(check_on_ball(record, right, 9).refused, Contains("no scan shows a ball"));
  CHECK_THAT(check_on_faces(record, right).refused, Contains("one side"));
  CHECK_FALSE(check_on_ball({}, right, 20).refused.empty());
}

TEST_CASE("a joint's faces from two sides pass the true calibration and tell a knocked one") {
  const SimulatedSweepsSettings settings = joint_settings();
  const SweepData record = scans(settings, {-40, 40});
  const Calibration right = true_calibration(settings);
  const DriftCheck good = check_on_faces(record, right);
  INFO(good.refused);
  REQUIRE(good.refused.empty());
  CHECK(good.faces >= 3);
  CHECK(good.shift_shown(0) > 0.5);
  // Level faces and one upright one turned about the vertical show one direction alone, and say so.
  REQUIRE(good.warnings.size() == 1);
  CHECK_THAT(good.warnings[0], Contains("awkward direction"));
  CHECK(good.error_mm < 0.1);
  CHECK(drift(good, kLimit).empty());
  for (auto [what, wrong] : knocked(right)) {
    // Along the upright face's search, the direction that shows.
    if (what == std::string("shifted"))
      wrong.T_tool_camera = right.T_tool_camera * Eigen::Translation3d(0, 1, 0);
    const DriftCheck found = check_on_faces(record, wrong);
    CAPTURE(what, found.faces, found.refused);
    CHECK_THAT(drift(found, kLimit), Contains("limit"));
  }
}

TEST_CASE("an error within the limit is still a drift where the calibration expects far less") {
  DriftCheck agreement;
  agreement.error_mm = 0.25;
  CHECK(drift(agreement, 0.3).empty());
  agreement.predicted_mm = 0.08;
  CHECK(drift(agreement, 0.3).empty());
  agreement.predicted_mm = 0.03;
  CHECK_THAT(drift(agreement, 0.3), Contains("expects"));
  agreement.error_mm = 0.14;  // a robot may differ so much from scan to scan
  CHECK(drift(agreement, 0.3).empty());
}
