// Where along a seam's line a scan looked at both plates, and where both are there.
#pragma once

#include <array>
#include <vector>

namespace arcstart::seam_finding {

// A stripe that crosses the line, or without stripes a piece of the line.
struct Station {
  double along = 0;  // where it crosses; mm
  std::array<double, 2>
      nearest{};      // distance of each plate's nearest point from the line, infinite for none; mm
  bool known = true;  // false: the stripe is missing, or spoilt
  int stripe = -1;    // index, -1 in a cloud without stripes
};

struct Stations {
  std::vector<Station> list;  // in order of their places
  // A plate is at a station where its nearest point is no farther from the line than a stripe's
  // points are from each other; else the stripe leaves the plate before it crosses the seam. mm
  std::array<double, 2> near{};
  // At which stripes cross each plate: mm along the line for each mm away from it.
  std::array<double, 2> slant{};

  bool both(const Station& station) const {
    return station.nearest[0] <= near[0] && station.nearest[1] <= near[1];
  }
};

struct Coverage {
  double begin = 0, end = 0;    // along the line; mm
  double covered = 0;           // of it, where both plates were seen; mm
  int stripes = 0;              // stations with both plates, places that lie together counted once
  bool begins_outside = false;  // both plates are there from the first stripe on
  bool ends_outside = false;
  int missing_before = 0;  // stripes in a row, right before the begin, of which nothing is known
  int missing_after = 0;
  Stations stations;  // by which it was found
};

}  // namespace arcstart::seam_finding
