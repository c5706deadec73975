// Every pair of faces that cross and may be a joint, ranked: angle (Eq. 6), concavity or, outside
// a corner, convexity, and contact along the line.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "services/seam_finding/border_fit.hpp"
#include "services/seam_finding/course.hpp"
#include "services/seam_finding/joint_type.hpp"
#include "services/seam_finding/planes.hpp"

namespace arcstart {

struct JointSearch {
  JointType type = JointType::kTee;  // that or a corner
  double angle = 1.5708;             // theta of Eq. 6, between the plates; rad
  double angle_tolerance = 0.35;     // epsilon of Eq. 6; rad
  double contact = 6;                // a plate is at the seam where its points come so near; mm
  double tolerance = 0.5;            // of a point's distance from its plane; mm
  int stripes_min = 5;
  double length_min = 15;  // of the seam where both plates were seen; mm
  CourseSearch course;
};

// Of a joint whose plates lie in one plane or in parallel ones.
struct FlatSeam {
  // Where each plate ends toward the other, along the seam's direction: of a lap the lower plate as
  // far as it was seen, and the upper one's lower edge.
  std::array<Line, 2> borders;
  BorderFit seam;            // how well the seam is known across, along its line; mm
  int lower = 0;             // of a lap: which plate
  double step = 0;           // and the upper plate's top over the lower one's; mm
  bool foot_hidden = false;  // of the step: nothing of the upper plate's cut was seen
  double half_angle = 0;     // of a groove's slant from the plates' normal; rad
  struct Gap {
    double along = 0, width = 0;  // on the seam's line; mm
  };
  std::vector<Gap> gaps;     // of a butt joint the gap, of a groove its width at the top
  double gap_deviation = 0;  // standard, of each; mm
  bool narrow = false;       // the gap: all stripes together tell its width, none alone
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
  Course course;
  double explained = 0;  // share of all points beside the line that lie on the two plates' planes
  std::optional<FlatSeam> flat;
  std::string flaw;  // why it is no joint, empty where it may be one

  Eigen::Vector3d start() const { return line.at(course.begin); }
  Eigen::Vector3d end() const { return line.at(course.end); }
};

// From the planes' normals, of a joint whose plates cross; rad.
double open_angle(const Joint& joint);

// Between the plates, on the side of the joint's open angle or, outside a corner, of the metal;
// rad.
inline double plates_angle(const Joint& joint) {
  return joint.type == JointType::kOutsideCorner ? 2 * M_PI - joint.angle : joint.angle;
}

// Turns the planes' normals to the side they were seen from. Returns for each whether that is
// certain: it is not where a viewpoint that is only assumed, or is the same for all of a cloud,
// lies nearly in the plane.
std::vector<bool> turn_to_sensor(const ScanCloud& cloud, std::vector<Face>& faces);

// All pairs whose planes meet under the angle and touch, best first; those with a flaw behind those
// without. `left`: the points that are not background.
std::vector<Joint> rank_joints(const ScanCloud& cloud, const std::vector<int>& left,
                               const std::vector<Face>& faces, const std::vector<bool>& certain,
                               const JointSearch& search);

// Best first; those with a flaw behind those without.
void sort_by_score(std::vector<Joint>& joints);

// The same seam, found on two pieces of a plate.
bool same_seam(const Joint& a, const Joint& b, double tolerance_mm);

}  // namespace arcstart
