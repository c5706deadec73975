// What one plate of a work is like: how thick, how its ends are cut, what is cut out of it.
#pragma once

#include "services/cell_simulator/wild/drawing.hpp"

namespace arcstart::cell_simulator {

// Sheet or plate; mm.
double draw_thickness(Draw& draw);

// Of a plate whose length, width and thickness stand: its ends' cuts, none so turned that the plate
// is no longer wide enough.
void draw_ends(WildPlate& plate, Draw& draw);

// Begins before the other plate, flush with it, or after it; likewise at the end.
void draw_overhangs(WildPlate& plate, const WildPlate& other, Draw& draw);

// Holes and notches, where there is room for them off the seam and the cuts.
void draw_openings(WildPlate& plate, Draw& draw);

void make_hollow(WildPlate& plate, Draw& draw);

}  // namespace arcstart::cell_simulator
