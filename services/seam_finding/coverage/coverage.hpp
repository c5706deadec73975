// Where along a line both plates have points: the seam's two ends (paper 5, "first valid point
// along the seam").
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

CourseSearch course_search(const Scales& scales);

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

}  // namespace arcstart::seam_finding
