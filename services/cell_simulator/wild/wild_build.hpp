// From the description of a scene of the wild to its triangles and its truth.
#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "services/cell_simulator/image/sensor_settings.hpp"
#include "services/cell_simulator/scene/scene.hpp"
#include "services/cell_simulator/scene/scene_settings.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"
#include "services/cell_simulator/wild/wild_truth.hpp"

namespace arcstart::cell_simulator {

// The table with what lies there in that scan. Its seam is the first of the truth. Objects are the
// same in every call. Throws SceneError where the description is impossible.
Scene build(const WildScene& wild, SceneKind kind);

WildTruth truth_of(const WildScene& wild);

// Noise and dropouts of each of the objects of build(wild, kind), in their order; behind these of
// their bands, of an object without one its own again.
std::vector<WildSurface> surfaces_of(const WildScene& wild, SceneKind kind);

// What the tool carries before the sensor, in camera: a nozzle with its wire. Nothing where it is
// out of view.
std::optional<Scene> on_tool(const WildScene& wild);

// A scene in one frame: all but the table shaken off its place, and what the tool carries (nullptr:
// nothing) before the camera.
Scene in_frame(const Scene& scene, const Scene* carried, const RigidTransform& T_base_camera,
               const Eigen::Vector3d& shaken_mm);

// The sensor and the taught work that make taught_tool_pose() run this scan.
SensorSettings sensor_of(const WildScene& wild, SensorSettings sensor = {});
SceneSettings taught_scene_of(const WildScene& wild, SceneSettings scene = {});

}  // namespace arcstart::cell_simulator
