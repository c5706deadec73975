// What comes over the network must not fill the memory.
#pragma once

#include <cstddef>

namespace arcstart::seam_finding {

// Of a scan, at most: 20 minutes at 14 Hz. A seq beyond is damage.
constexpr std::size_t kMostProfiles = 20'000;
constexpr std::size_t kMostPoints = 2'000'000;

}  // namespace arcstart::seam_finding
