// Two plates that may be welded, and the line between them.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/fit/line_fit.hpp"
#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/joint_type.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/reason.hpp"

namespace arcstart::seam_finding {

// Of a joint whose plates lie in one plane or in parallel ones.
struct ParallelSeam {
  // Where each plate ends toward the other, along the seam's direction: of a lap the lower plate as
  // far as it was seen, and the upper one's lower edge.
  std::array<Line, 2> edges;
  LineFit seam;              // how well the seam is known across, along its line; mm
  int lower = 0;             // of a lap: which plate
  double step = 0;           // and the upper plate's top over the lower one's; mm
  bool root_hidden = false;  // of the step: nothing of the upper plate's cut was seen
  double half_angle = 0;     // of a groove's slant from the plates' normal; rad
  struct Gap {
    double along = 0, width = 0;  // on the seam's line; mm
  };
  std::vector<Gap> gaps;     // of a butt joint the gap, of a groove its width at the top
  double gap_deviation = 0;  // standard, of each; mm
  bool narrow = false;       // the gap: all stripes together tell its width, none alone
  bool floor = false;        // of a butt joint: something is seen in the gap, near the plates' tops
};

struct Joint {
  JointType type = JointType::kTee;
  std::array<int, 2> faces{};  // indices
  std::array<JointPlate, 2> plates;
  Line line;             // along the search direction
  double angle = 0;      // between the open sides; rad
  double concavity = 0;  // share of each plate's points beside the line that lie before the other
                         // plate, outside a corner behind it, the smaller
  double score = 0;      // mm of seam, less for what is not as it should be
  Coverage coverage;
  double explained = 0;  // share of all points beside the line that lie on the two plates' planes
  std::optional<ParallelSeam> parallel;
  Reason flaw;  // why it is no joint, none where it may be one

  Eigen::Vector3d start() const { return line.at(coverage.begin); }
  Eigen::Vector3d end() const { return line.at(coverage.end); }
};

// From the planes' normals, of a joint whose plates cross; rad.
double open_angle(const Joint& joint);

// Between the plates, on the side of the joint's open angle or, outside a corner, of the metal;
// rad.
inline double plates_angle(const Joint& joint) {
  return joint.type == JointType::kOutsideCorner ? 2 * M_PI - joint.angle : joint.angle;
}

}  // namespace arcstart::seam_finding
