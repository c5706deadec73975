// A cable that lies about.
#pragma once

#include <vector>

#include "services/cell_simulator/wild/clutter/clutter_ground.hpp"

namespace arcstart::cell_simulator {

// Over whatever lies on its way, as a taut cable does.
void add_cable(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids);

}  // namespace arcstart::cell_simulator
