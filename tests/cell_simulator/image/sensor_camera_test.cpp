#include "services/cell_simulator/image/sensor_camera.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "services/cell_simulator/base/random_stream.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

constexpr double kOneDegree = std::numbers::pi / 180;

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

TEST_CASE("points are seen where OpenCV projects them, every distortion coefficient in use") {
  SensorSettings settings;
  settings.distortion = {-0.11, 0.07, 0.0013, -0.0021, 0.03};
  const TrueSensor sensor = make_true_sensor(settings);
  const cv::Matx33d camera_matrix(2400, 0, 807.3, 0, 2400, 594.6, 0, 0, 1);
  RandomStream random(5);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 500; ++i) {
    const double z = random.uniform(150, 500);
    points.emplace_back(random.uniform(-0.33, 0.33) * z, random.uniform(-0.25, 0.25) * z, z);
  }
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), camera_matrix, settings.distortion, pixels);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = see(sensor, {points[i].x, points[i].y, points[i].z});
    REQUIRE(pixel);
    CHECK(std::hypot(pixel->x() - pixels[i].x, pixel->y() - pixels[i].y) < 1e-9);
  }
  CHECK_FALSE(see(sensor, {0, 0, -300}));
  CHECK_FALSE(see(sensor, {0, 0, 0}));
  CHECK_FALSE(see(sensor, {900, 0, 300}));
}

TEST_CASE("a smaller image shows the same field with larger pixels") {
  SensorSettings settings, small_settings;
  small_settings.image_width_px = 400;
  small_settings.image_height_px = 300;
  const TrueSensor sensor = make_true_sensor(settings), small = make_true_sensor(small_settings);
  const Eigen::Vector3d point(70, -50, 310);
  const Eigen::Vector2d pixel = *see(sensor, point), small_pixel = *see(small, point);
  // Measured from the image's left upper corner, which lies at -0.5.
  CHECK((pixel.array() + 0.5).isApprox(4 * (small_pixel.array() + 0.5), 1e-12));
}

TEST_CASE("the laser plane leans by its angle and meets the optical axis at the stand-off") {
  for (const double roll : {0.0, 0.6, -5.0}) {
    SensorSettings settings;
    settings.laser_roll_deg = roll;
    const TrueSensor sensor = make_true_sensor(settings);
    const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
    CHECK(sensor.laser_normal.norm() == Approx(1).epsilon(1e-12));
    CHECK(std::asin(sensor.laser_normal.dot(axis)) == Approx(22 * kOneDegree).epsilon(1e-12));
    CHECK(sensor.laser_normal.dot(300 * axis) + sensor.laser_offset == Approx(0).margin(1e-12));
    CHECK(sensor.laser_normal.dot(sensor.projector) + sensor.laser_offset ==
          Approx(0).margin(1e-12));
    CHECK(sensor.laser_normal.dot(sensor.fan_direction) == Approx(0).margin(1e-12));
    CHECK(sensor.fan_half_angle == Approx(23 * kOneDegree));
  }
  // Without roll the normal makes that angle with the search direction, the image's v.
  SensorSettings settings;
  settings.laser_roll_deg = 0;
  CHECK(angle(make_true_sensor(settings).laser_normal, Eigen::Vector3d::UnitY()) ==
        Approx(22 * kOneDegree));
}

TEST_CASE("the hand-eye is a rotation with no zero in it") {
  const RigidTransform T = make_true_sensor({}).T_tool_camera;
  CHECK((T.linear() * T.linear().transpose()).isIdentity(1e-12));
  CHECK(T.linear().determinant() == Approx(1));
  CHECK(T.linear().cwiseAbs().minCoeff() > 0.01);
  CHECK(T.translation().cwiseAbs().minCoeff() > 10);
  // About fixed axes x, y, z in this order, against quaternions multiplied by hand.
  SensorSettings settings;
  settings.camera_in_tool_deg = {90, 0, 90};
  const RigidTransform turned = make_true_sensor(settings).T_tool_camera;
  CHECK((turned.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  CHECK((turned.linear() * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST_CASE("taught poses look at the work as they should") {
  const SensorSettings settings;
  const SceneSettings scene;
  const TrueSensor sensor = make_true_sensor(settings);
  for (const double along : {-80.0, 0.0, 70.0}) {
    const RigidTransform T_base_camera =
        taught_tool_pose(settings, scene, along) * sensor.T_tool_camera;
    const Eigen::Vector3d target(950 + along, 0, 10);
    const Eigen::Vector3d axis = target - T_base_camera.translation();
    CHECK(axis.norm() == Approx(300));
    CHECK((T_base_camera.inverse() * target - Eigen::Vector3d(0, 0, 300)).norm() < 1e-9);
    CHECK(axis.x() == Approx(0).margin(1e-9));
    CHECK(angle(-axis, Eigen::Vector3d::UnitZ()) == Approx(38 * kOneDegree));
    CHECK(T_base_camera.translation().y() < -100);  // over the open side
    // The image's v runs along the search, and the projector stands ahead.
    CHECK((T_base_camera.linear() * Eigen::Vector3d::UnitY())
              .isApprox(Eigen::Vector3d::UnitX(), 1e-12));
    CHECK((T_base_camera * sensor.projector).x() > target.x() + 100);
  }
}

TEST_CASE("a search can rise on its way and run another way over the same work") {
  const SensorSettings sensor;
  SceneSettings scene;
  const RigidTransform begin = taught_tool_pose(sensor, scene, -80),
                       end = taught_tool_pose(sensor, scene, 70);
  scene.search_rise_mm = 60;
  CHECK((taught_tool_pose(sensor, scene, -80).translation() - begin.translation())
            .isApprox(Eigen::Vector3d(0, 0, -30), 1e-9));
  CHECK((taught_tool_pose(sensor, scene, 70).translation() - end.translation())
            .isApprox(Eigen::Vector3d(0, 0, 30), 1e-9));
  scene.search_rise_mm = 0;
  scene.search_turn_deg = 90;
  const Eigen::Vector3d way = taught_tool_pose(sensor, scene, 70).translation() -
                              taught_tool_pose(sensor, scene, -80).translation();
  CHECK(way.isApprox(Eigen::Vector3d(0, 150, 0), 1e-9));
  // The same point of the work stands in the same place of the image.
  const Eigen::Vector3d middle(scene.work_position_mm[0], scene.work_position_mm[1], 10);
  const RigidTransform T_tool_camera = make_true_sensor(sensor).T_tool_camera;
  const Eigen::Vector3d turned =
      (taught_tool_pose(sensor, scene, 0) * T_tool_camera).inverse() * middle;
  scene.search_turn_deg = 0;
  CHECK(turned.isApprox((taught_tool_pose(sensor, scene, 0) * T_tool_camera).inverse() * middle,
                        1e-9));
}
