// Where along a line both plates have points: the seam's two ends (paper 5, "first valid point
// along the seam").
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/stations.hpp"

namespace arcstart {

struct Course {
  double begin = 0, end = 0;    // along the line; mm
  double covered = 0;           // of it, where both plates were seen; mm
  int stripes = 0;              // stations with both plates, places that lie together counted once
  bool begins_outside = false;  // both plates are there from the first stripe on
  bool ends_outside = false;
  int missing_before = 0;  // stripes in a row, right before the begin, of which nothing is known
  int missing_after = 0;
  Stations stations;  // by which it was found
};

// The longest stretch of the line on which both plates have points, with what follows behind short
// interruptions, and behind any in which the plates are only hidden. Its ends lie half-way between
// the last stripe that shows both plates and the next one that does not. stripes is 0 where there
// is none.
Course find_course(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                   const Line& line, const CourseSearch& search);
Course find_course(Stations stations, const CourseSearch& search);

// The paper's way: where along the line the centroid of the first `count` points of both plates
// lies, from the course's begin on; mm.
double centroid_of_first(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                         const Line& line, const Course& course, int count);

}  // namespace arcstart
