#include "services/seam_finding/joints/crossing_joints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/geometry.hpp"
#include "common/order_statistics.hpp"
#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/coverage/round_edge.hpp"
#include "services/seam_finding/joints/block_edge.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/contact.hpp"
#include "services/seam_finding/joints/edges/corner_opening.hpp"
#include "services/seam_finding/joints/edges/seen_under.hpp"
#include "services/seam_finding/joints/groove_faces.hpp"

namespace arcstart::seam_finding {
namespace {

Eigen::Vector3d middle(const ScanCloud& cloud, const std::vector<int>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int i : points) sum += cloud.points[i];
  return sum / static_cast<double>(points.size());
}

// A plate may show as several faces in one plane, parted by a shadow or by lost stripes.
std::vector<int> with_pieces_of_the_plane(const ScanCloud& cloud, const std::vector<Face>& faces,
                                          int face, const Line& line, double round,
                                          const Scales& scales) {
  std::vector<int> points = faces[face].points;
  for (int k = 0; k < static_cast<int>(faces.size()); ++k) {
    if (k == face ||
        faces[k].plane.normal.dot(faces[face].plane.normal) < std::cos(kJoints.same_plane))
      continue;
    if (std::abs(faces[face].plane.signed_distance(middle(cloud, faces[k].points))) >
        2 * scales.tolerance)
      continue;
    if (!touches(cloud, faces[k].points, line, round + contact_of(faces[k], scales))) continue;
    const auto own = static_cast<std::ptrdiff_t>(points.size());
    points.insert(points.end(), faces[k].points.begin(), faces[k].points.end());
    std::inplace_merge(points.begin(), points.begin() + own, points.end());
  }
  return without_fragments(cloud, points);
}

// Of a plate's points beside the seam: the share on the right side of the other plate, and how far
// they reach from the line.
struct Beside {
  double before = 0;  // of what touches the line; 0..1
  double reach = 0;   // three quarters of the points are nearer; mm
  double whole = 0;   // nine tenths of all the plate's points there are nearer; mm
};

Beside look_beside(const ScanCloud& cloud, const Joint& joint, int plate, double tolerance) {
  const bool outside = joint.type == JointType::kOutsideCorner;
  const double in_under = kJoints.in_under + joint.plates[1 - plate].round;
  const double begin =
      outside ? 0 : begins_at(cloud, joint.plates[1 - plate], joint.line) + tolerance;
  int before = 0, behind = 0;
  std::vector<double> distances, all;
  for (const int i : joint.plates[plate].points) {
    const Eigen::Vector3d& point = cloud.points[i];
    const double t = joint.line.along(point), r = joint.line.distance(point);
    if (t < joint.coverage.begin || t > joint.coverage.end) continue;
    all.push_back(r);
    if (r > kModel.beside_seam) continue;
    distances.push_back(r);
    // What lies farther behind may be the plate going on beyond the other's thickness.
    if (r > joint.plates[plate].contact) continue;
    const double side = (outside ? -1 : 1) * joint.plates[1 - plate].plane.signed_distance(point);
    before += side > tolerance;
    behind += side < -(outside ? tolerance : std::max(tolerance, in_under)) &&
              !seen_under(cloud, i, joint.plates[1 - plate].plane, joint.line, begin);
  }
  Beside beside;
  if (before > 0) beside.before = static_cast<double>(before) / (before + behind);
  beside.reach = upper_quantile(distances, 0.75);
  beside.whole = upper_quantile(all, 0.9);
  return beside;
}

// Of an outside corner's notch, from the line in which the faces' planes cross.
double notch_reach(const Joint& joint) {
  return joint.type == JointType::kOutsideCorner
             ? std::hypot(joint.plates[0].round, joint.plates[1].round)
             : 0;
}

// Behind both faces, where the plates of an outside corner leave a notch between their edges.
bool in_notch(const Joint& joint, const Eigen::Vector3d& point) {
  return joint.line.distance(point) < notch_reach(joint) &&
         std::all_of(joint.plates.begin(), joint.plates.end(), [&](const JointPlate& plate) {
           return plate.plane.signed_distance(point) < 0;
         });
}

// In clutter planes can be laid through much; at a joint they account for what is there.
double explained_share(const ScanCloud& cloud, const std::vector<int>& left, const Joint& joint,
                       double tolerance) {
  int all = 0, explained = 0;
  for (const int i : left) {
    const Eigen::Vector3d& point = cloud.points[i];
    const double t = joint.line.along(point);
    if (t < joint.coverage.begin || t > joint.coverage.end ||
        joint.line.distance(point) > kModel.beside_seam)
      continue;
    if (in_notch(joint, point)) continue;
    ++all;
    explained += std::abs(joint.plates[0].plane.signed_distance(point)) <= tolerance ||
                 std::abs(joint.plates[1].plane.signed_distance(point)) <= tolerance;
  }
  return all > 0 ? static_cast<double>(explained) / all : 0;
}

// Why the plates are no joint, none where they may be one.
Reason flaw_of(const ScanCloud& cloud, const Joint& joint, double narrower_plate, double off,
               const Scales& scales, const SeamFindingSettings& settings) {
  using Code = Reason::Code;
  const bool outside = joint.type == JointType::kOutsideCorner;
  const double length_min = cloud.organised() ? kJoints.shortest_seam
                                              : std::max(kJoints.shortest_doubtful,
                                                         settings.stripes_min * scales.spacing);
  if (std::abs(off) > 1) return {Code::kAngle, plates_angle(joint)};
  if (joint.concavity < kJoints.least_concave)
    return {outside ? Code::kNotConvex : Code::kNotConcave};
  if (outside && narrower_plate < kModel.widest_cut) return {Code::kEdgeOfOnePlate};
  if (joint.explained < kJoints.least_explained) return {Code::kTooMuchElse};
  if (cloud.organised() && joint.coverage.stripes < settings.stripes_min)
    return {Code::kFewStripesCross, static_cast<double>(joint.coverage.stripes)};
  if (joint.coverage.covered < length_min) return {Code::kShortlySeen, joint.coverage.covered};
  return {};
}

void judge(const ScanCloud& cloud, const std::vector<int>& left, Joint& joint, const Scales& scales,
           const SeamFindingSettings& settings) {
  joint.coverage = find_coverage(cloud, joint.plates, joint.line, scales);
  const Coverage& course = joint.coverage;
  if (course.stripes == 0) {
    joint.flaw = {Reason::Code::kPlatesDoNotTouch};
    return;
  }
  const Beside first = look_beside(cloud, joint, 0, scales.tolerance);
  const Beside second = look_beside(cloud, joint, 1, scales.tolerance);
  joint.concavity = std::min(first.before, second.before);
  joint.explained = explained_share(cloud, left, joint, scales.tolerance);
  const WantedAngle wanted = wanted_angle(joint.type, settings);
  const double off = (plates_angle(joint) - wanted.angle) / wanted.tolerance;
  joint.score = course.covered * joint.explained * joint.explained * joint.concavity *
                joint.concavity * std::min(1.0, first.reach / kJoints.full_reach) *
                std::min(1.0, second.reach / kJoints.full_reach) * std::max(0.0, 1 - off * off / 2);
  joint.flaw = flaw_of(cloud, joint, std::min(first.whole, second.whole), off, scales, settings);
}

// Along the search direction; without one toward increasing x, then y, then z.
Eigen::Vector3d along_search(const ScanCloud& cloud, const Eigen::Vector3d& direction) {
  if (const auto search = search_direction(cloud);
      search && std::abs(search->dot(direction)) > 1e-6)
    return search->dot(direction) < 0 ? Eigen::Vector3d(-direction) : direction;
  for (const double component : direction)
    if (std::abs(component) > kJoints.no_component)
      return component < 0 ? Eigen::Vector3d(-direction) : direction;
  return direction;
}

std::optional<Joint> pair_up(const ScanCloud& cloud, const std::vector<int>& left,
                             const std::vector<Face>& faces, int a, int b, JointType type,
                             const Scales& scales, const SeamFindingSettings& settings) {
  const WantedAngle wanted = wanted_angle(type, settings);
  const double fold =
      std::acos(std::min(1.0, std::abs(faces[a].plane.normal.dot(faces[b].plane.normal))));
  // Eq. 6 with the sign of the normals left open; near misses are listed with their flaw.
  const double least =
      std::min(std::abs(fold - wanted.angle), std::abs(M_PI - fold - wanted.angle));
  if (least > wanted.tolerance + kJoints.near_miss) return std::nullopt;
  const auto line = intersect(faces[a].plane, faces[b].plane, middle(cloud, faces[a].points));
  if (!line) return std::nullopt;
  Joint joint;
  joint.type = type;
  joint.faces = {a, b};
  joint.line = *line;
  joint.line.direction = along_search(cloud, line->direction);
  std::array<double, 2> opening{};
  if (type == JointType::kOutsideCorner)
    opening = corner_opening(cloud, {&faces[a], &faces[b]}, *line, scales);
  for (int j = 0; j < 2; ++j) {
    const Face& face = faces[joint.faces[j]];
    JointPlate& plate = joint.plates[j];
    plate.plane = face.plane;
    plate.round = opening[j];
    if (type != JointType::kOutsideCorner)
      plate.round = round_edge(cloud, face.points, face.plane, faces[joint.faces[1 - j]].plane,
                               *line, scales);
    plate.contact = plate.round + contact_of(face, scales);
    if (!touches(cloud, face.points, *line, plate.contact)) return std::nullopt;
  }
  for (int j = 0; j < 2; ++j)
    joint.plates[j].points = with_pieces_of_the_plane(cloud, faces, joint.faces[j], *line,
                                                      joint.plates[j].round, scales);
  const auto measure = [&](Joint& j) {
    j.angle = open_angle(j);
    if (j.type == JointType::kOutsideCorner)
      for (int k = 0; k < 2; ++k) j.plates[k].away = -j.plates[1 - k].plane.normal;
    judge(cloud, left, j, scales, settings);
  };
  const bool first_known = faces[a].side_known, second_known = faces[b].side_known;
  const int doubtful = first_known == second_known ? -1 : first_known ? 1 : 0;
  Joint turned = joint;
  measure(joint);
  if (doubtful >= 0) {
    // The side of one face was not seen for certain, that of the other was: the reading that makes
    // a joint holds.
    turned.plates[doubtful].plane = turned.plates[doubtful].plane.flipped();
    measure(turned);
    if (turned.score > joint.score) return turned;
  }
  return joint;
}

// What else than a joint the faces around the two show it to be; none where they do not.
Reason other_thing(const ScanCloud& cloud, const std::vector<Face>& faces, const Joint& joint,
                   const Scales& scales, const SeamFindingSettings& settings) {
  if (joint.type == JointType::kOutsideCorner)
    return is_edge_of_block(cloud, faces, joint, scales) ? Reason{Reason::Code::kEdgeOfBlock}
                                                         : Reason{};
  const double parallel = settings.parallel_tolerance_deg * kDegree;
  return are_sides_of_groove(cloud, faces, joint, parallel, scales)
             ? Reason{Reason::Code::kGrooveNotWanted}
             : Reason{};
}

// What lies on a corner's plate, beside it, seems to leave a notch over the corner itself.
bool lies_over_another(const std::vector<Joint>& joints, const Joint& joint) {
  return std::any_of(joints.begin(), joints.end(), [&](const Joint& other) {
    return !other.flaw && notch_reach(other) < notch_reach(joint) &&
           same_seam(joint, other, notch_reach(joint));
  });
}

}  // namespace

std::vector<Face> turned_to_sensor(const ScanCloud& cloud, std::vector<Face> faces) {
  for (Face& face : faces) {
    double sum = 0;
    for (const int i : face.points)
      sum += face.plane.normal.dot((cloud.seen_from(i) - cloud.points[i]).normalized());
    if (sum < 0) face.plane = face.plane.flipped();
    const double slant =
        std::asin(std::min(1.0, std::abs(sum) / static_cast<double>(face.points.size())));
    face.side_known =
        cloud.organised() ||
        slant > (cloud.viewpoint_known ? kJoints.given_view_slant : kJoints.assumed_view_slant);
  }
  return faces;
}

WantedAngle wanted_angle(JointType type, const SeamFindingSettings& settings) {
  if (type == JointType::kOutsideCorner)
    return {settings.outside_corner_angle_deg * kDegree,
            settings.outside_corner_tolerance_deg * kDegree};
  return {settings.angle_deg * kDegree, settings.angle_tolerance_deg * kDegree};
}

std::vector<Joint> find_crossing_joints(const ScanCloud& cloud, const std::vector<int>& left,
                                        const std::vector<Face>& faces, JointType type,
                                        const Scales& scales, const SeamFindingSettings& settings) {
  std::vector<Joint> joints;
  for (int a = 0; a < static_cast<int>(faces.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(faces.size()); ++b)
      if (auto joint = pair_up(cloud, left, faces, a, b, type, scales, settings)) {
        if (!joint->flaw) joint->flaw = other_thing(cloud, faces, *joint, scales, settings);
        joints.push_back(std::move(*joint));
      }
  for (Joint& joint : joints)
    if (!joint.flaw && lies_over_another(joints, joint)) joint.flaw = {Reason::Code::kTooMuchElse};
  return joints;
}

bool same_seam(const Joint& a, const Joint& b, double tolerance_mm) {
  return std::abs(a.line.direction.dot(b.line.direction)) > std::cos(kJoints.same_direction) &&
         a.line.distance(b.line.at((b.coverage.begin + b.coverage.end) / 2)) < tolerance_mm;
}

}  // namespace arcstart::seam_finding
