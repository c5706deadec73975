#include "services/seam_finding/joints/block_edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/contact.hpp"

namespace arcstart::seam_finding {
namespace {

// The face looks away from the seam where the seam ends, as the cut of both plates would.
bool closes_end(const ScanCloud& cloud, const Face& face, const Joint& joint,
                const Scales& scales) {
  const double facing = face.plane.normal.dot(joint.line.direction);
  if (std::abs(facing) < std::cos(kJoints.most_cut_turn)) return false;
  const double contact = contact_of(face, scales) + scales.spacing;
  const Eigen::Vector3d end = facing > 0 ? joint.end() : joint.start();
  if (std::abs(face.plane.signed_distance(end)) > contact) return false;
  // It is at both plates.
  return std::all_of(joint.plates.begin(), joint.plates.end(), [&](const JointPlate& plate) {
    const auto edge = intersect(face.plane, plate.plane, end);
    return edge && touches(cloud, face.points, *edge, contact);
  });
}

double depth(const JointPlate& plate, const Eigen::Vector3d& point) {
  return -plate.plane.signed_distance(point);
}

// How thick each plate may be. One that is thicker than half its width is a bar.
std::array<double, 2> most_thickness(const ScanCloud& cloud, const Joint& joint) {
  std::array<double, 2> most;
  for (int j = 0; j < 2; ++j) {
    double width = 0;
    for (const int i : joint.plates[j].points)
      width = std::max(width, depth(joint.plates[1 - j], cloud.points[i]));
    most[j] = std::min(kModel.widest_cut, width / 2);
  }
  return most;
}

double share_deep_behind(const ScanCloud& cloud, const Face& face, const Joint& joint) {
  const auto most = most_thickness(cloud, joint);
  const auto deep = std::count_if(face.points.begin(), face.points.end(), [&](int i) {
    return depth(joint.plates[0], cloud.points[i]) > most[0] &&
           depth(joint.plates[1], cloud.points[i]) > most[1];
  });
  return static_cast<double>(deep) / static_cast<double>(face.points.size());
}

}  // namespace

bool is_edge_of_block(const ScanCloud& cloud, const std::vector<Face>& faces, const Joint& joint,
                      const Scales& scales) {
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    if (f != joint.faces[0] && f != joint.faces[1] && closes_end(cloud, faces[f], joint, scales) &&
        share_deep_behind(cloud, faces[f], joint) > kJoints.least_solid)
      return true;
  return false;
}

}  // namespace arcstart::seam_finding
