// Centres in the last pixels of a stripe's branches, where the Hessian no longer tells the line's
// direction.
#pragma once

#include <vector>

#include "services/extraction/image/gaussian_kernels.hpp"
#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/lines/stripe_path.hpp"
#include "services/extraction/ridge/ridge_point.hpp"

namespace arcstart::extraction {

// Where a stripe with a white top ends, grey values bend as much along it as across: the
// eigenvectors turn, ridge points leave the middle sideways, and soon there is none. So the
// last 1.5 sigma of such a branch are looked for anew, and as much beyond them, in the direction
// that the branch had before: the greatest grey value across it, as long as the bend there is half
// of what it was, as it is at the edge of a surface. Nothing is put nearer than border to the
// image's border or than sigma to another chosen branch.
//
// Adds to points, and for each point added, its standard deviation by that of the direction to
// deviations; px.
void follow_blunt_ends(const GreyImage& image, const GaussianKernels& kernels, int border,
                       StripePath& selection, std::vector<RidgePoint>& points,
                       std::vector<float>& deviations);

}  // namespace arcstart::extraction
