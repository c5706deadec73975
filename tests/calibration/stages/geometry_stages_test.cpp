// The stages by themselves, against closed forms and the simulator's own camera.
#include <catch2/catch.hpp>

#include "services/calibration/target/projection.hpp"
#include "services/calibration/target/target_detection.hpp"
#include "tests/calibration/support/simulated_set.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::test;

namespace {

// The middle of a circle's image by the simulator's camera: rings and spokes, each patch with the
// area that it has in the image.
Eigen::Vector2d middle_of_image(const TrueSensor& sensor, const RigidTransform& pose,
                                const Eigen::Vector3d& centre, double radius) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double area = 0;
  constexpr int kRings = 40, kSpokes = 60;
  const auto at = [&](double r, double angle) {
    return see(sensor, pose * (centre + r * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)))
        .value();
  };
  for (int ring = 0; ring < kRings; ++ring)
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double inner = radius * ring / kRings, outer = radius * (ring + 1) / kRings;
      const double begin = 2 * EIGEN_PI * spoke / kSpokes,
                   end = 2 * EIGEN_PI * (spoke + 1) / kSpokes;
      const Eigen::Vector2d corners[] = {at(inner, begin), at(outer, begin), at(outer, end),
                                         at(inner, end)};
      const Eigen::Vector2d a = corners[2] - corners[0], b = corners[3] - corners[1];
      const double patch = std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
      sum += patch * at((inner + outer) / 2, (begin + end) / 2);
      area += patch;
    }
  return sum / area;
}

SensorModel true_model(const TrueSensor& sensor) {
  SensorModel model;
  model.width = sensor.width;
  model.height = sensor.height;
  model.fx = sensor.fx;
  model.fy = sensor.fy;
  model.cx = sensor.cx;
  model.cy = sensor.cy;
  model.distortion = sensor.distortion;
  model.laser_plane = {sensor.laser_normal, sensor.laser_offset};
  return model;
}

}  // namespace

TEST_CASE("a circle's image has its middle where perspective and lens put it") {
  const TrueSensor sensor = make_true_sensor({});
  const double camera[] = {sensor.fx, sensor.fy, sensor.cx, sensor.cy};
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 0.5, 0).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(-50, -40, 250);
  for (const double radius : {0.0, 2.0, 4.0, 6.0})
    for (const auto& centre :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(60, 30, 0), Eigen::Vector3d(100, 80, 0)}) {
      const Eigen::Vector2d expected = radius > 0 ? middle_of_image(sensor, pose, centre, radius)
                                                  : see(sensor, pose * centre).value();
      const Eigen::Vector2d found = seen_centre<double>(
          camera, sensor.distortion.data(), {pose.linear(), pose.translation()}, centre, radius);
      CHECK((found - expected).norm() < 1e-3);
    }
}

TEST_CASE("dots are found in rendered images to a fiftieth of a pixel") {
  const SimulatedSet& set = well_spread_set();
  const std::vector<Eigen::Vector3d> centres = dots(set.printed);
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    REQUIRE(set.views[i].target.size() == centres.size());
    for (std::size_t k = 0; k < centres.size(); ++k) {
      squares += (set.views[i].target[k] - middle_of_image(set.images.sensor(), set.poses[i],
                                                           centres[k], set.printed.dot_radius_mm))
                     .squaredNorm();
      ++count;
    }
  }
  CHECK(std::sqrt(squares / count) < 0.03);
}

TEST_CASE("another plate than the one described is not found") {
  SimulatedSet set({}, 1, 502);
  auto grid = set.images.grid(set.poses[0], 1);
  const cv::Mat grey(set.images.sensor().height, set.images.sensor().width, CV_8U, grid.data());
  Target other = set.plate();
  other.columns = 7;
  CHECK(detect_target(grey, other).empty());
  CHECK(detect_target(cv::Mat::zeros(600, 800, CV_8U), set.plate()).empty());
}

TEST_CASE("with the camera known the laser plane is the simulator's") {
  const SimulatedSet& set = well_spread_set();
  const SensorModel model = true_model(set.images.sensor());
  std::vector<Eigen::Vector3d> points;
  for (const View& view : set.views) {
    const auto on_plate = stripe_on_plate(model, locate_plate(model, set.plate(), view),
                                          straight_stripe(model, view.stripe, 1000));
    points.insert(points.end(), on_plate.begin(), on_plate.end());
  }
  const LaserPlaneFit fit = fit_laser_plane(points);
  CHECK(angle_between(fit.plane.normal, set.images.sensor().laser_normal) < 1e-4);
  CHECK(fit.plane.signed_distance({0, 0, 300}) == Approx(0).margin(0.01));
}

TEST_CASE("a plane fit bears points that lie elsewhere") {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100; ++i)
    points.push_back({double(i % 10), double(i / 10), i % 9 == 0 ? 8.0 : 5.0});
  const LaserPlaneFit fit = fit_laser_plane(points);
  CHECK(std::abs(fit.plane.signed_distance({3, 3, 5})) < 0.05);
  CHECK(fit.spread == Approx(1).epsilon(0.1));
}

TEST_CASE("closed forms give back the hand-eye of exact poses") {
  const SimulatedSet& set = well_spread_set();
  std::vector<RigidTransform> tools;
  for (const View& view : set.views) tools.push_back(view.T_base_tool);
  for (const HandEyeMethod& method : closed_form_hand_eye(tools, set.poses, set.plate().points())) {
    // OpenCV's others fail where views turn by nearly 180 deg.
    if (method.name != "Park" && method.name != "Horaud") continue;
    CHECK((method.T_tool_camera.translation() - set.images.sensor().T_tool_camera.translation())
              .norm() < 1e-6);
    CHECK(method.consistency_mm < 1e-5);
    CHECK(method.T_base_plate.isApprox(true_T_base_plate(), 1e-6));
  }
  for (const double angle : angle_disagreement(tools, set.poses)) CHECK(angle < 1e-6);
  tools[3].linear() = tools[3].linear() * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX());
  const auto angles = angle_disagreement(tools, set.poses);
  CHECK(std::max_element(angles.begin(), angles.end()) - angles.begin() == 3);
}

TEST_CASE("a plate's labels after a turn are those of the turned points") {
  for (const auto& [columns, rows] : {std::pair{4, 4}, std::pair{5, 3}}) {
    Target plate;
    plate.columns = columns;
    plate.rows = rows;
    plate.pitch_mm = 10;
    plate.radius_mm = 2;
    const auto points = plate.points();
    for (int turns = 0; turns < plate.symmetry(); ++turns) {
      const auto labels = turned_points(plate, turns);
      const Eigen::AngleAxisd turn(2 * EIGEN_PI * turns / plate.symmetry(),
                                   Eigen::Vector3d::UnitZ());
      const Eigen::Vector3d shift = points[static_cast<std::size_t>(labels[0])] - turn * points[0];
      for (std::size_t i = 0; i < points.size(); ++i)
        CHECK((turn * points[i] + shift - points[static_cast<std::size_t>(labels[i])]).norm() <
              1e-9);
    }
  }
}

TEST_CASE("only a pattern that a turn leaves as it is counts as symmetric") {
  Target plate{TargetPattern::asymmetric_circles, 5, 9, 12, 4, 0};
  CHECK(plate.symmetry() == 1);
  plate.rows = 8;
  CHECK(plate.symmetry() == 2);
  plate = {TargetPattern::chessboard, 7, 6, 10, 0, 0};
  CHECK(plate.symmetry() == 1);
  plate.columns = 8;
  CHECK(plate.symmetry() == 2);
  plate = {TargetPattern::circles, 10, 10, 25.4, 6, 12};
  CHECK(plate.symmetry() == 1);
}
