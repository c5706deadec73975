// What is measured along a seam, stripe by stripe: how straight it is, and where tack welds lie.
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/stations.hpp"

namespace arcstart {

struct SurveyPlace {
  double along = 0;          // on the seam's line; mm
  int stripe = -1;           // index, -1 in a cloud without stripes
  Eigen::Vector3d position;  // of the seam there, in base; mm
  double residual = -1;      // from the line; mm, -1 where a plate was not seen beside the seam
  bool tack = false;         // metal stands before both plates there
  double gap = -1, gap_deviation = -1;  // between the plates; mm, -1 where not measured
};

// A place for every stripe that crosses the seam between begin and end, in their order; without
// stripes for every `spacing` of it. Where the residual was not measured the position is the
// line's.
std::vector<SurveyPlace> survey_seam(const ScanCloud& cloud,
                                     const std::array<JointPlate, 2>& plates, const Line& line,
                                     double begin, double end, double spacing_mm);

// The line from begin to end where no place is farther from it than `straight_mm`; else through the
// places, averaged over three so that no single one bends it.
struct Polyline {
  std::vector<Eigen::Vector3d> points;
  double deviation = -1;  // largest residual from it, averaged likewise; mm, -1 where not measured
};
Polyline polyline_through(const std::vector<SurveyPlace>& places, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& end, double straight_mm);

}  // namespace arcstart
