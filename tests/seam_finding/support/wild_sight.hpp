// What the stripes of a scan show of the ends of a seam, by the exact geometry.
#pragma once

#include <vector>

#include "services/cell_simulator/wild/wild_truth.hpp"
#include "tests/seam_finding/support/wild_scan.hpp"
#include "tests/seam_finding/support/wild_view.hpp"

namespace arcstart::seam_finding::synthetic {

class WildSightings {
 public:
  // spacing: of the stripes along the search; mm. The seam must outlive this.
  WildSightings(const cell_simulator::WildSeam& seam, double spacing);

  // One stripe: what the camera sees of it, and the sheet's plane in base.
  void add(const std::vector<WildPiece>& pieces, const Plane& sheet);

  WildSeamSight sight() const;

 private:
  bool shows_both(const std::vector<WildPiece>& pieces) const;
  bool leaves_over(const std::vector<WildPiece>& pieces, const cell_simulator::WildEnd& end) const;

  const cell_simulator::WildSeam& seam_;
  double length_, spacing_;                // along the seam; mm
  std::vector<double> stripes_, showing_;  // where they cross the seam's line, from its start
  int start_crossings_ = 0, end_crossings_ = 0;
};

}  // namespace arcstart::seam_finding::synthetic
