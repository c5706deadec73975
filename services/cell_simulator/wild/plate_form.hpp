// One plate or section in its own coordinates: s along the seam, t away from it in the plate's
// face, d into the metal; mm. The seam's line is t = 0, d = 0.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "services/cell_simulator/scene/triangle_mesh.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::cell_simulator {

// The plate's edge along the seam: (depth, t), straight between; a groove's slant, a mitre. Of
// plates that go on behind the seam, (0, -behind) and (thickness, -behind).
using SeamEdge = std::vector<std::pair<double, double>>;

// Throws SceneError where the numbers leave no plate.
TriangleMesh make_plate_form(const WildPlate& plate, const SeamEdge& edge);

enum class Side { begin, end };

// Along the seam, in the face: where the plate ends at t = 0, copes and chamfers taken off; and the
// same of the straight line of its edge at any t, without its waves.
double foot_end(const WildPlate& plate, Side side);
double face_edge(const WildPlate& plate, Side side, double t);

}  // namespace arcstart::cell_simulator
