// Centres measured once more at a smaller sigma.
#pragma once

#include <vector>

#include "services/extraction/ridge_point.hpp"
#include "services/extraction/scatter.hpp"
#include "services/extraction/selection.hpp"

namespace arcstart {

// Replaces the centre of each chosen point by the nearest ridge point found at sigma in its column
// (row), where one lies within reach; px. measured: those points, in any order; sorted. centres: of
// each of `points`.
void take_finer(const std::vector<RidgePoint>& points, const Selection& selection, int reach,
                double sigma, double noise, std::vector<RidgePoint>& measured,
                std::vector<MeasuredCentre>& centres);

}  // namespace arcstart
