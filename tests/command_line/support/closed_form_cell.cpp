#include "tests/command_line/support/closed_form_cell.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace arcstart::test {

using namespace command_line;
namespace {

const Eigen::Vector3d kNear(20, -60, 0), kFar(120, 60, 10);  // corners of the base plate; mm
constexpr double kFace = -4, kTop = 55;  // of the standing plate: y of its face, its upper edge; mm

}  // namespace

Calibration calibration_of_cell(const std::string& sensor, const std::string& robot) {
  Calibration made;
  made.id = "closed form";
  made.sensor = sensor;
  made.robot = robot;
  made.tool = "torch";
  made.made = kBegin - 1'000'000;
  made.origin = "test";
  SensorModel& model = made.sensor_model;
  model.width = 640;
  model.height = 480;
  model.fx = model.fy = 600;
  model.cx = 322.5;
  model.cy = 238.25;
  model.distortion = {-0.1, 0.02, 0.0005, -0.0003, 0};
  // 22 deg from the optical axis, through the point 300 mm ahead.
  const double lean = 22 * M_PI / 180;
  model.laser_plane = {{0, std::cos(lean), -std::sin(lean)}, 300 * std::sin(lean)};
  made.T_tool_camera = make_transform(
      {31, -47, 82},
      Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 0.5).normalized())));
  made.time_offset = kTimeOffset;
  return made;
}

RigidTransform T_base_camera(double seconds) {
  double x = -10;
  for (const std::int64_t scan : {kBackgroundScan, kWorkpieceScan}) {
    const double begin = static_cast<double>(scan - kBegin) * 1e-6 + 0.1;
    if (seconds >= begin - 0.5) x = -10 + 50 * std::clamp(seconds - begin, 0.0, 3.2);
  }
  const double lean = 38 * M_PI / 180;
  const Eigen::Vector3d ahead(0, std::sin(lean), -std::cos(lean));
  Eigen::Matrix3d rotation;
  rotation << Eigen::Vector3d(0, std::cos(lean), std::sin(lean)), Eigen::Vector3d::UnitX(), ahead;
  return make_transform(Eigen::Vector3d(x, kFace, 10) - 300 * ahead, Eigen::Quaterniond(rotation));
}

std::vector<SurfacePoint> lit_points(const Plane& laser, bool with_workpiece) {
  std::vector<SurfacePoint> points;
  const auto x_at = [&](double y, double z) {
    return -(laser.offset + laser.normal.y() * y + laser.normal.z() * z) / laser.normal.x();
  };
  const auto over_plate = [](double x) { return x >= kNear.x() && x <= kFar.x(); };
  for (double y = -100; y <= 80; y += 0.5) {
    const bool hidden = with_workpiece && y > kFace && over_plate(x_at(kFace, 10));
    const bool on_plate =
        with_workpiece && y >= kNear.y() && y <= kFar.y() && over_plate(x_at(y, kFar.z()));
    if (hidden) continue;
    if (on_plate)
      points.push_back({{x_at(y, kFar.z()), y, kFar.z()}, 1});
    else if (!(with_workpiece && y >= kNear.y() && y <= kFar.y() && over_plate(x_at(y, 0))))
      points.push_back({{x_at(y, 0), y, 0}, static_cast<std::int16_t>(y > kFar.y() ? 3 : 0)});
  }
  for (double z = kFar.z(); with_workpiece && z <= kTop; z += 0.5)
    if (over_plate(x_at(kFace, z))) points.push_back({{x_at(kFace, z), kFace, z}, 2});
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.segment < b.segment; });
  return points;
}

}  // namespace arcstart::test
