// What make_scene() puts together: the table, the joint and what lies about. Each part draws from a
// stream of its own, so that what lies about does not move the work.
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry.hpp"
#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/scene/scene_settings.hpp"

namespace arcstart::cell_simulator {

// Turns by an angle in degrees.
Eigen::Matrix3d turn(double degrees, const Eigen::Vector3d& axis);

// A coarse plate: long waves and a roughness from corner to corner, together within the settings'
// unevenness.
SceneObject make_table(const SceneSettings& settings, std::uint64_t seed);

// A ball that lies on the table in the taught place, of facets no farther from it than 0.005 mm at
// a radius of 20 mm. Dull, as a ball for measuring is.
SceneObject make_ball(const SceneSettings& settings);

// Two plates. Work frame: x along the seam, which runs through the origin; the first plate's top is
// in z = 0, and the joint's open side looks to -y or, where it has none, up.
struct Work {
  RigidTransform T_base_work;
  SceneObject first_plate, second_plate;
  double length_mm;           // of the first plate along the seam
  double open_mm, behind_mm;  // how far they reach to -y and to +y of the seam
  SeamTruth seam;
};
Work make_work(const SceneSettings& settings, std::uint64_t seed);

// The boxes and the tool that the settings ask for, where they touch neither the plates nor each
// other. Throws SceneError where there is no room.
std::vector<SceneObject> make_clutter(const SceneSettings& settings, const Work& work,
                                      std::uint64_t seed);

}  // namespace arcstart::cell_simulator
