// Planes in a cloud, one after the other, by RANSAC with least-squares refinement (paper 5, steps 1
// and 2).
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/planes/plane_search.hpp"

namespace arcstart::seam_finding {

// The faces of the points named by `indices`, about the largest first. Each takes its points away
// from the next; what lies in its plane and does not hang together with it is left. Points that
// only end a segment are not fitted: an end is where the stripe's centre is least certain. They are
// given to the face they lie on. The same seed gives the same faces.
std::vector<Face> find_faces(const ScanCloud& cloud, std::vector<int> indices,
                             const PlaneSearch& search, std::uint64_t seed);

}  // namespace arcstart::seam_finding
