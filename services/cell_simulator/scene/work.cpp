#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/scene/scene_parts.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint64_t purpose = 2;  // of the random stream

// What the seed made of the settings' plates.
struct Sizes {
  Eigen::Vector3d base_mm, second_mm;  // along the seam, across it, thickness; for the second plate
                                       // along the seam, thickness, height
};

// Both plates in the work frame.
struct PlatePair {
  std::string first_name, second_name;
  TriangleMesh first, second;
  std::array<Eigen::Vector3d, 2> normals;
  double angle_deg;  // between the faces on the open side
};

// An outline (y, z) drawn along x. Convex, counter-clockwise seen from +x.
TriangleMesh make_bar(const std::vector<Eigen::Vector2d>& outline, double half_length) {
  TriangleMesh mesh = make_plate(outline, -half_length, half_length);
  for (auto& corner : mesh.corners)
    corner = Eigen::Vector3d(corner.z(), corner.x(), corner.y());  // z to x
  return mesh;
}

// The upright stands on the base plate's middle; where the joint is not square it leans about the
// root line.
PlatePair make_tee(const SceneSettings& settings, const Sizes& sizes) {
  const double base_half = sizes.base_mm.x() / 2, upright_half = sizes.second_mm.x() / 2;
  const double thickness = sizes.second_mm.y(), gap = settings.root_gap_mm;
  const double angle = settings.joint_angle_deg * std::numbers::pi / 180;
  RigidTransform lean = RigidTransform::Identity();
  lean.linear() = turn(90 - settings.joint_angle_deg, Eigen::Vector3d::UnitX());
  return {"base plate",
          "upright plate",
          make_box({-base_half, (thickness - sizes.base_mm.y()) / 2, -sizes.base_mm.z()},
                   {base_half, (thickness + sizes.base_mm.y()) / 2, 0}),
          transformed(make_box({-upright_half, 0, gap},
                               {upright_half, thickness, gap + sizes.second_mm.z()}),
                      lean),
          {Eigen::Vector3d::UnitZ(), {0, -std::sin(angle), -std::cos(angle)}},
          settings.joint_angle_deg};
}

// The second plate stands under the edge of the first; where they meet both are cut at 45 deg.
PlatePair make_outside_corner(const SceneSettings& settings, const Sizes& sizes) {
  const double width = sizes.base_mm.y() / 2, thickness = sizes.base_mm.z();
  const double gap = settings.root_gap_mm, wall = sizes.second_mm.y(),
               foot = -gap - sizes.second_mm.z();
  return {
      "top plate",
      "upright plate",
      make_bar({{0, 0}, {thickness, -thickness}, {width, -thickness}, {width, 0}},
               sizes.base_mm.x() / 2),
      make_bar({{0, -gap}, {0, foot}, {wall, foot}, {wall, -gap - wall}}, sizes.second_mm.x() / 2),
      {Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()},
      270};
}

// The second plate lies on the first.
PlatePair make_lap(const SceneSettings& settings, const Sizes& sizes) {
  const double gap = settings.root_gap_mm;
  return {"lower plate",
          "upper plate",
          make_box({-sizes.base_mm.x() / 2, -sizes.base_mm.y() / 2, -sizes.base_mm.z()},
                   {sizes.base_mm.x() / 2, sizes.base_mm.y() / 2, 0}),
          make_box({-sizes.second_mm.x() / 2, 0, gap},
                   {sizes.second_mm.x() / 2, sizes.second_mm.z(), gap + sizes.second_mm.y()}),
          {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ()},
          180};
}

// Two plates as thick as the first, side by side, their edges cut square or, for a V, slanting so
// that they part by the root gap below.
PlatePair make_butt(const SceneSettings& settings, const Sizes& sizes) {
  const double slant = settings.joint == "v" ? settings.groove_angle_deg / 2 : 0;
  const double thickness = sizes.base_mm.z(), root = settings.root_gap_mm / 2;
  const double top = root + thickness * std::tan(slant * std::numbers::pi / 180);
  return {"near plate",
          "far plate",
          make_bar({{-sizes.base_mm.y() / 2, -thickness},
                    {-root, -thickness},
                    {-top, 0},
                    {-sizes.base_mm.y() / 2, 0}},
                   sizes.base_mm.x() / 2),
          make_bar({{root, -thickness},
                    {sizes.second_mm.z(), -thickness},
                    {sizes.second_mm.z(), 0},
                    {top, 0}},
                   sizes.second_mm.x() / 2),
          {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ()},
          settings.joint == "v" ? settings.groove_angle_deg : 180};
}

PlatePair make_pair_of_plates(const SceneSettings& settings, const Sizes& sizes) {
  if (settings.joint == "outside_corner") return make_outside_corner(settings, sizes);
  if (settings.joint == "lap") return make_lap(settings, sizes);
  if (settings.joint == "butt" || settings.joint == "v") return make_butt(settings, sizes);
  return make_tee(settings, sizes);
}

// Turned and tilted about its taught place, its lowest corner on the table.
RigidTransform place_work(const SceneSettings& settings, const PlatePair& joint,
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
  for (const TriangleMesh* plate : {&joint.first, &joint.second})
    for (const auto& corner : plate->corners) lowest = std::min(lowest, (T_base_work * corner).z());
  T_base_work.translation().z() = settings.work_position_mm[2] - lowest;
  return T_base_work;
}

}  // namespace

Work make_work(const SceneSettings& settings, std::uint64_t seed) {
  RandomStream random(seed, purpose);
  const auto sized = [&](double length) {
    return length * random.uniform(1 - settings.size_range_share, 1 + settings.size_range_share);
  };
  Sizes sizes;
  for (int i = 0; i < 3; ++i) sizes.base_mm[i] = sized(settings.base_plate_mm[i]);
  for (int i = 0; i < 3; ++i) sizes.second_mm[i] = sized(settings.upright_plate_mm[i]);
  const PlatePair joint = make_pair_of_plates(settings, sizes);

  Work work;
  work.T_base_work = place_work(settings, joint, random);
  const Surface steel{settings.plate_albedo, 0.08, 1, settings.plate_specular_share, 0.006};
  work.first_plate = {joint.first_name, transformed(joint.first, work.T_base_work), steel};
  work.second_plate = {joint.second_name, transformed(joint.second, work.T_base_work), steel};
  work.length_mm = sizes.base_mm.x();
  work.open_mm = work.behind_mm = 0;
  for (const TriangleMesh* plate : {&joint.first, &joint.second})
    for (const auto& corner : plate->corners) {
      work.open_mm = std::max(work.open_mm, -corner.y());
      work.behind_mm = std::max(work.behind_mm, corner.y());
    }

  const double half = std::min(sizes.base_mm.x(), sizes.second_mm.x()) / 2;
  const Eigen::Matrix3d& axes = work.T_base_work.linear();
  work.seam.joint_type = settings.joint;
  work.seam.start = work.T_base_work * Eigen::Vector3d(-half, 0, 0);
  work.seam.end = work.T_base_work * Eigen::Vector3d(half, 0, 0);
  work.seam.direction = axes.col(0);
  work.seam.normals = {axes * joint.normals[0], axes * joint.normals[1]};
  work.seam.angle = joint.angle_deg * std::numbers::pi / 180;
  return work;
}

}  // namespace arcstart::cell_simulator
