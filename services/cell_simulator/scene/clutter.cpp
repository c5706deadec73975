#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/scene/scene_parts.hpp"
#include "services/cell_simulator/scene/tool_shapes.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint64_t kClutterStream = 3;  // of the random stream
const Surface painted{0.5, 0.1, 1, 0.03, 0.02}, worn_steel{0.4, 0.1, 1, 0.15, 0.01};

// On the table, near the work and in the sensor's view, touching nothing.
SceneObject place_tool(const SceneSettings& settings, const std::vector<Footprint>& taken,
                       RandomStream& random) {
  const bool hammer = random.uniform() < 0.5;
  const TriangleMesh mesh = hammer ? make_hammer() : make_pliers();
  for (int attempt = 0; attempt < 1000; ++attempt) {
    RigidTransform pose = RigidTransform::Identity();
    pose.linear() = turn(random.uniform(0, 360), Eigen::Vector3d::UnitZ());
    pose.translation() = Eigen::Vector3d(settings.work_position_mm[0] + random.uniform(-100, 90),
                                         settings.work_position_mm[1] + random.uniform(-105, 125),
                                         settings.work_position_mm[2]);
    const Footprint place = footprint(mesh, pose, 4);
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const Footprint& other) { return overlap(place, other); }))
      continue;
    return {hammer ? "hammer" : "pliers", transformed(mesh, pose), worn_steel};
  }
  throw SceneError(
      "tool_lying_about: no room for it beside the work; make the plates smaller or leave it out");
}

}  // namespace

std::vector<SceneObject> make_clutter(const SceneSettings& settings, const Work& work,
                                      std::uint64_t seed) {
  // All is drawn whether it is used or not, so that one setting does not change what another puts
  // there.
  RandomStream random(seed, kClutterStream);
  const double box_along = random.uniform(-20, 20), box_turn = random.uniform(-8, 8),
               box_gap = random.uniform(14, 24);
  const double on_base_along = random.uniform(0.05, 0.3), on_base_across = random.uniform(0.4, 0.6);

  std::vector<SceneObject> objects;
  const RigidTransform T_work_base = work.T_base_work.inverse();
  std::vector<Footprint> taken{
      footprint(transformed(work.first_plate.mesh, T_work_base), work.T_base_work, 0),
      footprint(transformed(work.second_plate.mesh, T_work_base), work.T_base_work, 0)};
  if (settings.box_beside) {
    const TriangleMesh box = make_box({-70, -35, 0}, {70, 35, 60});
    const double yaw =
        std::atan2(work.seam.direction.y(), work.seam.direction.x()) * 180 / EIGEN_PI;
    RigidTransform pose = RigidTransform::Identity();
    pose.linear() = turn(yaw + box_turn, Eigen::Vector3d::UnitZ());
    pose.translation() =
        work.T_base_work * Eigen::Vector3d(box_along, work.behind_mm + box_gap + 35, 0);
    pose.translation().z() = settings.work_position_mm[2];
    objects.push_back({"box beside", transformed(box, pose), painted});
    taken.push_back(footprint(box, pose, 0));
  }
  if (settings.box_on_base) {
    RigidTransform pose = work.T_base_work;
    pose.translate(
        Eigen::Vector3d(on_base_along * work.length_mm, -on_base_across * work.open_mm, 0));
    objects.push_back(
        {"box on base", transformed(make_box({-12, -9, 0}, {12, 9, 15}), pose), painted});
  }
  if (settings.tool_lying_about) objects.push_back(place_tool(settings, taken, random));
  return objects;
}

}  // namespace arcstart::cell_simulator
