#include "tests/seam_finding/support/wild_told.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "services/cell_simulator/base/random_stream.hpp"

namespace arcstart::seam_finding::synthetic {

using namespace cell_simulator;
using Eigen::Vector3d;
namespace {

constexpr std::uint64_t calibration_purpose = 31, wave_purpose = 32;  // of the random streams

}  // namespace

TrueSensor told_sensor(const WildScene& wild, const TrueSensor& sensor) {
  const double factor = wild.scan.calibration_error;
  if (factor == 0) return sensor;
  // Of a calibration from 20 poses of a robot that errs by 0.1 mm and 0.01 deg: figures of
  // services/calibration/BENCHMARK.md.
  constexpr double focal_share = 1e-4, sheet_mm = 0.05, hand_eye_mm = 0.05;
  constexpr double sheet_rad = 0.01 * kDegree, hand_eye_rad = 0.005 * kDegree;
  RandomStream random(wild.seed, calibration_purpose);
  const auto vector = [&](double deviation) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return Vector3d(factor * deviation * Vector3d(x, y, z));
  };
  const auto turned = [&](double deviation) {
    const Vector3d turn = vector(deviation);
    return Eigen::AngleAxisd(turn.norm(), turn.normalized());
  };
  TrueSensor told = sensor;
  told.fx *= 1 + factor * focal_share * random.normal();
  told.fy = told.fx;
  // The plane turns about the point of the optical axis that it holds.
  const Vector3d middle(0, 0, -sensor.laser_offset / sensor.laser_normal.z());
  told.laser_normal = turned(sheet_rad) * sensor.laser_normal;
  told.laser_offset = -told.laser_normal.dot(middle) + factor * sheet_mm * random.normal();
  told.T_tool_camera.linear() = turned(hand_eye_rad) * sensor.T_tool_camera.linear();
  told.T_tool_camera.translation() += vector(hand_eye_mm);
  return told;
}

RigidTransform told_pose(const WildScene& wild, const RigidTransform& T_base_tool) {
  RigidTransform told = T_base_tool;
  if (wild.scan.robot_wave_mm == 0) return told;
  constexpr double wave_mm = 400;  // a long axis' error goes to and fro within its gear's turn
  RandomStream random(wild.seed, wave_purpose);
  for (int axis = 0; axis < 3; ++axis) {
    const double phase = random.uniform(0, 2 * std::numbers::pi);
    told.translation()[axis] +=
        wild.scan.robot_wave_mm *
        std::sin(2 * std::numbers::pi * T_base_tool.translation().x() / wave_mm + phase);
  }
  return told;
}

std::optional<Vector3d> on_sheet(const TrueSensor& sensor, const Eigen::Vector2d& pixel) {
  // The distortion taken off by going back and forth (each time nearer by the distortion's own
  // share).
  const double xd = (pixel.x() - sensor.cx) / sensor.fx, yd = (pixel.y() - sensor.cy) / sensor.fy;
  const auto& [k1, k2, p1, p2, k3] = sensor.distortion;
  double x = xd, y = yd;
  for (int i = 0; i < 12; ++i) {
    const double r2 = x * x + y * y, radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double dx = 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                 dy = p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
    x = (xd - dx) / radial;
    y = (yd - dy) / radial;
  }
  const Vector3d ray(x, y, 1);
  const double rise = sensor.laser_normal.dot(ray);
  if (std::abs(rise) < 1e-9) return {};
  const double depth = -sensor.laser_offset / rise;
  if (!(depth > 0)) return {};
  return Vector3d(depth * ray);
}

}  // namespace arcstart::seam_finding::synthetic
