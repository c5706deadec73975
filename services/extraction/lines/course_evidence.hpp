// What speaks for the course chosen at a scale: courses found at other scales are compared by it.
#pragma once

#include <vector>

#include "services/extraction/image/frame_arena.hpp"
#include "services/extraction/lines/linking.hpp"
#include "services/extraction/lines/stripe_path.hpp"
#include "services/extraction/ridge/ridge_point.hpp"

namespace arcstart::extraction {

// Strengths are N of Eq. 3, grey values.
struct CourseEvidence {
  // Strength summed over the course times the root of its mean segment's share of the image. The
  // strength of a stripe is greatest at its own width, and it crosses the image in few segments;
  // scratches and the marks of a mill are fainter or shorter at every scale.
  double weight = 0;
  int centres = 0;    // of the course
  double faint = 0;   // strength that three quarters of the course's centres exceed
  double usual = 0;   // of the middle one
  double others = 0;  // of the middle one of the chained points beside the course; 0: below one a
                      // line of the image
};

// factor: strength of a curvature (strength_factor). lines: columns of the image, or rows,
// whichever are more.
CourseEvidence course_evidence(const std::vector<RidgePoint>& points,
                               const std::vector<Chain>& chains, const StripePath& course,
                               double factor, int lines, Memory memory);

}  // namespace arcstart::extraction
