#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "services/cell_simulator/random_stream.hpp"
#include "services/cell_simulator/scene_parts.hpp"

namespace arcstart {
namespace {

constexpr std::uint64_t purpose = 2;  // of the random stream

// Turned and tilted about its taught place, its lowest corner on the table.
RigidTransform place_work(const SceneSettings& settings, const TriangleMesh& base_plate,
                          RandomStream& random) {
  const auto within = [&](double range) { return random.uniform(-range, range); };
  const double x = settings.work_position_mm[0] + within(settings.place_range_mm);
  const double y = settings.work_position_mm[1] + within(settings.place_range_mm);
  const double yaw = within(settings.yaw_range_deg), tilt = within(settings.tilt_range_deg);
  const double tilt_axis = random.uniform(0, 2 * std::numbers::pi);
  RigidTransform T_base_work = RigidTransform::Identity();
  T_base_work.linear() = turn(tilt, {std::cos(tilt_axis), std::sin(tilt_axis), 0}) *
                         turn(yaw, Eigen::Vector3d::UnitZ());
  T_base_work.translation() = Eigen::Vector3d(x, y, 0);
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& corner : base_plate.corners)
    lowest = std::min(lowest, (T_base_work * corner).z());
  T_base_work.translation().z() = settings.work_position_mm[2] - lowest;
  return T_base_work;
}

}  // namespace

Tee make_tee(const SceneSettings& settings, std::uint64_t seed) {
  RandomStream random(seed, purpose);
  Tee tee;
  const auto sized = [&](double length) {
    return length * random.uniform(1 - settings.size_range_share, 1 + settings.size_range_share);
  };
  for (int i = 0; i < 3; ++i) tee.base_mm[i] = sized(settings.base_plate_mm[i]);
  for (int i = 0; i < 3; ++i) tee.upright_mm[i] = sized(settings.upright_plate_mm[i]);

  // The upright stands on the base plate's middle; where the joint is not square it leans about the
  // root line.
  const double base_half = tee.base_mm.x() / 2, upright_half = tee.upright_mm.x() / 2;
  const double thickness = tee.upright_mm.y(), gap = settings.root_gap_mm;
  const TriangleMesh base_plate =
      make_box({-base_half, (thickness - tee.base_mm.y()) / 2, -tee.base_mm.z()},
               {base_half, (thickness + tee.base_mm.y()) / 2, 0});
  RigidTransform lean = RigidTransform::Identity();
  lean.linear() = turn(90 - settings.joint_angle_deg, Eigen::Vector3d::UnitX());
  const TriangleMesh upright = transformed(
      make_box({-upright_half, 0, gap}, {upright_half, thickness, gap + tee.upright_mm.z()}), lean);
  tee.T_base_work = place_work(settings, base_plate, random);

  const Surface steel{settings.plate_albedo, 0.08, 1, settings.plate_specular_share, 0.006};
  tee.base_plate = {"base plate", transformed(base_plate, tee.T_base_work), steel};
  tee.upright_plate = {"upright plate", transformed(upright, tee.T_base_work), steel};

  const double half = std::min(base_half, upright_half);
  const double angle = settings.joint_angle_deg * std::numbers::pi / 180;
  const Eigen::Matrix3d& axes = tee.T_base_work.linear();
  tee.seam.joint_type = "tee";
  tee.seam.start = tee.T_base_work * Eigen::Vector3d(-half, 0, 0);
  tee.seam.end = tee.T_base_work * Eigen::Vector3d(half, 0, 0);
  tee.seam.direction = axes.col(0);
  tee.seam.normals = {axes.col(2), axes * Eigen::Vector3d(0, -std::sin(angle), -std::cos(angle))};
  tee.seam.angle = angle;
  return tee;
}

}  // namespace arcstart
