#include "services/seam_finding/joints/groove_faces.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "common/order_statistics.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/contact.hpp"

namespace arcstart::seam_finding {
namespace {

// Between which a side's plane bends to a top: flatter is one face, steeper another plate's cut.
bool bends(const Plane& side, const Plane& top) {
  const double fold = angle_between(side.normal, top.normal);
  return fold > kJoints.least_top_fold && fold < kJoints.most_top_fold;
}

// The face is the top of the plate whose cut this side is. Both tops may be one face.
bool is_top_of(const ScanCloud& cloud, const Face& face, const Joint& joint, int side,
               const Scales& scales) {
  const JointPlate& plate = joint.plates[side];
  if (!bends(plate.plane, face.plane)) return false;
  const Eigen::Vector3d middle = joint.line.at((joint.coverage.begin + joint.coverage.end) / 2);
  const auto edge = intersect(plate.plane, face.plane, middle);
  if (!edge || std::abs(edge->direction.dot(joint.line.direction)) < std::cos(kJoints.same_course))
    return false;
  // At the seam itself lies the other side.
  const Eigen::Vector3d away = away_from_seam(plate, joint.plates[1 - side]);
  if (away.dot(edge->at(edge->along(middle)) - middle) < 2 * scales.tolerance) return false;
  // Convex: the side rises to the top, and the top goes on behind the side.
  Eigen::Vector3d outward = face.plane.normal.cross(edge->direction);
  if (outward.dot(away) < 0) outward = -outward;
  if (face.plane.normal.dot(away) <= 0 || plate.plane.normal.dot(outward) >= 0) return false;
  std::vector<double> beyond;  // the edge; mm
  for (const int i : face.points)
    if (const double off = outward.dot(cloud.points[i] - edge->point); off > 0)
      beyond.push_back(off);
  if (beyond.empty()) return false;
  const double nearest = *std::min_element(beyond.begin(), beyond.end());
  return nearest < contact_of(face, scales) && touches(cloud, plate.points, *edge, plate.contact) &&
         upper_quantile(beyond, 0.9) > kJoints.least_reach;
}

}  // namespace

bool are_sides_of_groove(const ScanCloud& cloud, const std::vector<Face>& faces, const Joint& joint,
                         double parallel, const Scales& scales) {
  std::vector<const Face*> tops[2];
  for (int side = 0; side < 2; ++side)
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
      if (f != joint.faces[0] && f != joint.faces[1] &&
          is_top_of(cloud, faces[f], joint, side, scales))
        tops[side].push_back(&faces[f]);
  return std::any_of(tops[0].begin(), tops[0].end(), [&](const Face* first) {
    return std::any_of(tops[1].begin(), tops[1].end(), [&](const Face* second) {
      return angle_between(first->plane.normal, second->plane.normal) < 2 * parallel;
    });
  });
}

}  // namespace arcstart::seam_finding
