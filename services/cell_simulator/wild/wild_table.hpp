// The table of a scene of the wild: a coarse plate, or one with slots.
#pragma once

#include "services/cell_simulator/scene/triangle_mesh.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::cell_simulator {

// Its top lies at z = 0 on the whole, its middle under the taught work. Slots are open channels
// with a floor: what of a T-slot light can reach.
TriangleMesh make_wild_table(const WildScene& wild);

}  // namespace arcstart::cell_simulator
