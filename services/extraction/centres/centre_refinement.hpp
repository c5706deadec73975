// Centres measured once more at a smaller sigma.
#pragma once

#include <vector>

#include "services/extraction/centres/centre_noise.hpp"
#include "services/extraction/lines/stripe_path.hpp"
#include "services/extraction/ridge/ridge_point.hpp"

namespace arcstart::extraction {

// Replaces the centre of each chosen point by the nearest ridge point found at sigma in its column
// (row), where one lies within reach; px. measured: those points, in any order; sorted. centres: of
// each of `points`.
void refine_centres(const std::vector<RidgePoint>& points, const StripePath& selection, int reach,
                    double sigma, double noise, std::vector<RidgePoint>& measured,
                    std::vector<MeasuredCentre>& centres);

}  // namespace arcstart::extraction
