// Between which places a plate of a joint ends, where no stripe crosses its edge.
#pragma once

#include <array>

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/seam_end.hpp"

namespace arcstart::seam_finding {

// What the stripes say of where a plate begins at the seam: along the line, mm. `outward` in these
// functions is 1 toward the line's end, -1 toward its begin.
struct EndInterval {
  double inner = 0, outer = 0;  // it is there, and is not
  bool runs_on = false;         // it is there beyond the seam's end, too
  bool seen_past = false;       // outer: else by a stripe that does not show the plate at the seam
};

// Of the stripes next to `end`.
EndInterval interval_of(const Stations& stations, int plate, double end, double outward);

// How much earlier than it crosses the seam a stripe that shows a plate there may leave it; mm.
double unsure_of(const Stations& stations, int plate);

// By what is seen on the plate and past it. A plate that is seen beyond the stripes which do not
// show it at the seam was only hidden there. unsure: of the interval's inner place, margin: of its
// outer one; mm.
void narrow(EndInterval& interval, const PlateExtent& extent, double unsure, double margin,
            double outward);

// Of two plates the one that ends the seam first, where `end` is the one's edge and the other is
// known by a interval only. Two plates are often set flush; else the one ends anywhere about the
// other's end.
void limit_by_interval(SeamEnd& end, const EndInterval& interval, double outward);

// Where no plate's edge is known. Nothing is changed where both plates run on.
void between_intervals(SeamEnd& end, const std::array<EndInterval, 2>& intervals, double outward);

}  // namespace arcstart::seam_finding
