// What make_scene() puts together: the table, the joint and what lies about. Each part draws from a
// stream of its own, so that what lies about does not move the work.
#pragma once

#include <cstdint>
#include <vector>

#include "services/cell_simulator/scene.hpp"

namespace arcstart {

// Turns by an angle in degrees.
Eigen::Matrix3d turn(double degrees, const Eigen::Vector3d& axis);

// A coarse plate: long waves and a roughness from corner to corner, together within the settings'
// unevenness.
SceneObject make_table(const SceneSettings& settings, std::uint64_t seed);

// Two plates. Work frame: x along the seam, the root line through the origin on the base plate's
// top, open side to -y.
struct Tee {
  Eigen::Vector3d base_mm, upright_mm;  // as in the settings, as the seed made them
  RigidTransform T_base_work;
  SceneObject base_plate, upright_plate;
  SeamTruth seam;
};
Tee make_tee(const SceneSettings& settings, std::uint64_t seed);

// The boxes and the tool that the settings ask for, where they touch neither the plates nor each
// other. Throws SceneError where there is no room.
std::vector<SceneObject> make_clutter(const SceneSettings& settings, const Tee& tee,
                                      std::uint64_t seed);

}  // namespace arcstart
