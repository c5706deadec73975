#include "services/cell_simulator/image/sensor_camera.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace arcstart::cell_simulator {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Turns about the fixed axes x, y, z, in this order.
Eigen::Matrix3d turn(const std::array<double, 3>& degrees) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(radians(degrees[2]), Vector3d::UnitZ()) *
          AngleAxisd(radians(degrees[1]), Vector3d::UnitY()) *
          AngleAxisd(radians(degrees[0]), Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

TrueSensor make_true_sensor(const SensorSettings& settings) {
  constexpr double settings_width = 1600;  // the focal length's and the principal point's
  TrueSensor sensor;
  sensor.width = settings.image_width_px;
  sensor.height = settings.image_height_px;
  const double scale = sensor.width / settings_width;
  sensor.fx = sensor.fy = settings.focal_length_px * scale;
  // With pixel centres at integers the image's edge lies at -0.5, and it is the edge that scaling
  // keeps.
  sensor.cx = (settings.principal_point_px[0] + 0.5) * scale - 0.5;
  sensor.cy = (settings.principal_point_px[1] + 0.5) * scale - 0.5;
  sensor.distortion = settings.distortion;

  // The plane holds the point of the optical axis at the stand-off and leans to it by the laser
  // angle; the projector stands in it beside the camera, on the side to which the image's v runs.
  const double lean = radians(settings.laser_angle_deg), roll = radians(settings.laser_roll_deg);
  const Eigen::AngleAxisd rolled(roll, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d target(0, 0, settings.stand_off_mm);
  sensor.laser_normal = rolled * Eigen::Vector3d(0, std::cos(lean), std::sin(lean));
  sensor.laser_offset = -sensor.laser_normal.dot(target);
  sensor.projector = rolled * Eigen::Vector3d(0, settings.stand_off_mm * std::tan(lean), 0);
  sensor.fan_direction = (target - sensor.projector).normalized();
  sensor.fan_half_angle = radians(settings.fan_angle_deg) / 2;

  sensor.T_tool_camera.setIdentity();
  sensor.T_tool_camera.linear() = turn(settings.camera_in_tool_deg);
  sensor.T_tool_camera.translation() = Eigen::Vector3d(
      settings.camera_in_tool_mm[0], settings.camera_in_tool_mm[1], settings.camera_in_tool_mm[2]);
  return sensor;
}

std::optional<Eigen::Vector2d> see(const TrueSensor& sensor, const Eigen::Vector3d& point) {
  if (!(point.z() > 1e-3)) return {};
  const double x = point.x() / point.z(), y = point.y() / point.z();
  const double r2 = x * x + y * y;
  const double aside =
      1.5 * std::hypot(0.5 * sensor.width / sensor.fx, 0.5 * sensor.height / sensor.fy);
  if (r2 > aside * aside) return {};
  const auto& [k1, k2, p1, p2, k3] = sensor.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double xd = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double yd = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return Eigen::Vector2d(sensor.fx * xd + sensor.cx, sensor.fy * yd + sensor.cy);
}

RigidTransform taught_tool_pose(const SensorSettings& sensor, const SceneSettings& scene,
                                double along_mm) {
  const double lean = radians(sensor.lean_deg);
  const Eigen::Vector3d ahead(0, std::sin(lean),
                              -std::cos(lean));  // from over the open side (-y) down to the joint
  const Eigen::Vector3d down = Eigen::Vector3d::UnitX();  // the image's v runs along the search
  const Eigen::Vector3d target(scene.work_position_mm[0] + along_mm, scene.work_position_mm[1],
                               scene.work_position_mm[2] + scene.base_plate_mm[2]);
  RigidTransform T_base_camera = RigidTransform::Identity();
  T_base_camera.linear().col(0) = down.cross(ahead);
  T_base_camera.linear().col(1) = down;
  T_base_camera.linear().col(2) = ahead;
  T_base_camera.translation() = target - sensor.stand_off_mm * ahead;
  const double length = scene.search_end_mm - scene.search_begin_mm;
  if (length != 0)
    T_base_camera.translation().z() +=
        scene.search_rise_mm * ((along_mm - scene.search_begin_mm) / length - 0.5);
  const Eigen::Vector3d middle(scene.work_position_mm[0], scene.work_position_mm[1], 0);
  T_base_camera = Eigen::Translation3d(middle) *
                  Eigen::AngleAxisd(radians(scene.search_turn_deg), Eigen::Vector3d::UnitZ()) *
                  Eigen::Translation3d(-middle) * T_base_camera;
  return T_base_camera * make_true_sensor(sensor).T_tool_camera.inverse();
}

}  // namespace arcstart::cell_simulator
