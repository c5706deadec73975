// Right answers made wrong on purpose: the referee is to catch each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"

namespace arcstart {

enum class ClaimedEnd { kNone, kStart, kEnd };

struct Falsified {
  std::string kind;                    // moved, neighbour, turned, swapped
  std::string text;                    // what was done
  ClaimedEnd end = ClaimedEnd::kNone;  // that is false
  double off_mm = 0;                   // along the seam, by so much
  seam_finding::SeamResult seam;
};

// Of a right answer whose start is seen. moved: an end by one and a half spacings and three
// deviations; neighbour: by 2 to 8 spacings, as where another plate's edge is taken for it; both
// both ways, outward as far as the scan goes on beside the seam. turned: a plate by a degree about
// the seam. swapped: the plates' faces, where they are not one. Ends that are not seen are left
// alone. spacing: of the stripes along the seam; mm. seed: of the drawn lengths.
std::vector<Falsified> falsified(const seam_finding::SeamResult& seam,
                                 const seam_finding::ScanCloud& cloud, double spacing,
                                 std::uint64_t seed);

}  // namespace arcstart
