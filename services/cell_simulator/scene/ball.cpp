#include "services/cell_simulator/scene/scene_parts.hpp"

namespace arcstart::cell_simulator {

SceneObject make_ball(const SceneSettings& settings) {
  const auto& [x, y, z] = settings.work_position_mm;
  RigidTransform pose = RigidTransform::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z + settings.ball_radius_mm);
  return {"ball",
          transformed(make_sphere(settings.ball_radius_mm, 5), pose),
          {settings.plate_albedo, 0, 1, 0, 0}};
}

}  // namespace arcstart::cell_simulator
