#include "services/seam_finding/joints/parallel_joints.hpp"

#include <algorithm>
#include <numeric>

#include "common/order_statistics.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/parallel_edges.hpp"
#include "services/seam_finding/joints/parallel_joint.hpp"
#include "services/seam_finding/joints/parallel_joint_type.hpp"
#include "services/seam_finding/joints/straight_runs.hpp"
#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {
namespace {

bool parallel(const Face& a, const Face& b, double tolerance) {
  return angle_between(a.plane.normal, b.plane.normal) < 2 * tolerance;
}

// Half of a face's points are no farther from another's plane than plates side by side may be.
bool level_with(const ScanCloud& cloud, const Face& face, const Plane& plane) {
  std::vector<double> off;
  for (const int i : face.points) off.push_back(std::abs(plane.signed_distance(cloud.points[i])));
  return quantile(off, 0.5) < kJoints.one_level;
}

// Two plates side by side at one level may have been laid out as a face that holds a part of both,
// and one that holds the rest. Such faces together, for each group of two or more.
std::vector<Face> level_faces(const ScanCloud& cloud, const std::vector<Face>& faces,
                              double tolerance) {
  std::vector<int> group(faces.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a + 1; b < faces.size(); ++b)
      if (parallel(faces[a], faces[b], tolerance) && level_with(cloud, faces[a], faces[b].plane) &&
          level_with(cloud, faces[b], faces[a].plane))
        std::replace(group.begin(), group.end(), group[b], group[a]);
  std::vector<Face> together;
  for (int g = 0; g < static_cast<int>(faces.size()); ++g) {
    if (std::count(group.begin(), group.end(), g) < 2) continue;
    Face face;
    std::size_t most = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (group[f] != g) continue;
      face.points.insert(face.points.end(), faces[f].points.begin(), faces[f].points.end());
      if (faces[f].points.size() > most) most = faces[f].points.size(), face.plane = faces[f].plane;
    }
    std::sort(face.points.begin(), face.points.end());
    together.push_back(std::move(face));
  }
  return together;
}

// A groove's slant passes through the plane of the lower plate's top: a point there is not that
// plate.
std::vector<int> face_of_points(const ScanCloud& cloud, const std::vector<Face>& faces) {
  std::vector<int> face_of(cloud.points.size(), -1);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (const int i : without_fragments(cloud, faces[f].points)) face_of[i] = f;
  return face_of;
}

// Axes in the face, along the search; nothing where that leads out of it.
std::optional<PlateFrame> frame_of(const ScanCloud& cloud, const Face& face,
                                   const Eigen::Vector3d& way) {
  const Eigen::Vector3d& normal = face.plane.normal;
  const Eigen::Vector3d along = way - way.dot(normal) * normal;
  if (along.norm() < 0.5) return std::nullopt;
  PlateFrame frame;
  frame.origin = cloud.points[face.points[face.points.size() / 2]];
  frame.along = along.normalized();
  frame.normal = normal;
  frame.across = frame.normal.cross(frame.along);
  return frame;
}

// The joint that the transitions on one line make. A line along which far more than a gap is dark,
// as in a wire's shadow, is none of the plates' edges: then the next one.
std::optional<Joint> joint_through(const ScanCloud& cloud, const std::vector<Face>& faces,
                                   const std::array<int, 2>& sides, const PlateFrame& frame,
                                   const std::vector<Section>& sections,
                                   const std::vector<int>& face_of,
                                   std::vector<Transition> transitions, bool by_runs,
                                   const Scales& scales, const SeamFindingSettings& settings) {
  for (Transition& transition : transitions)
    transition.covered = is_covered(
        cloud, transition, {faces[sides[0]].plane, faces[sides[1]].plane}, scales.tolerance);
  std::optional<Joint> first;
  for (;;) {
    TransitionLine candidate;
    candidate.frame = frame;
    candidate.faces = sides;
    candidate.by_runs = by_runs;
    candidate.transitions = on_one_line(cloud, frame, transitions);
    if (std::ssize(candidate.transitions) < settings.stripes_min) return first;
    candidate.share = share_of_sections(cloud, sections, face_of, candidate);
    auto joint = joint_at(cloud, faces, candidate, scales, settings);
    const bool too_wide = joint && joint->flaw.code == Reason::Code::kGapWidth;
    if (!first || (joint && !joint->flaw)) first = std::move(joint);
    if (!too_wide) return first;
    std::erase_if(transitions, [&](const Transition& transition) {
      return std::any_of(
          candidate.transitions.begin(), candidate.transitions.end(), [&](const Transition& taken) {
            return taken.section == transition.section && taken.last == transition.last;
          });
    });
  }
}

// Than one that was found in the plainer way.
bool clearly_better(const Joint& joint, const Joint& plain) {
  if (static_cast<bool>(joint.flaw) != static_cast<bool>(plain.flaw)) return !joint.flaw;
  if (joint.score > kJoints.clearly_better * plain.score) return true;
  return kJoints.clearly_better * joint.score > plain.score &&
         joint.parallel->seam.variance < kJoints.clearly_closer * plain.parallel->seam.variance;
}

// The joints between each face and those behind it in the list, where `pairs`, and within each.
void add_joints(const ScanCloud& cloud, const std::vector<Face>& faces, bool pairs,
                const Eigen::Vector3d& way, const Scales& scales,
                const SeamFindingSettings& settings, std::vector<Joint>& joints) {
  const std::vector<int> face_of = face_of_points(cloud, faces);
  const int count = static_cast<int>(faces.size());
  for (int a = 0; a < count; ++a) {
    const auto frame = frame_of(cloud, faces[a], way);
    if (!frame) continue;
    const auto sections = sections_across(cloud, *frame, scales.spacing);
    for (int b = a; b < (pairs ? count : a + 1); ++b) {
      if (!parallel(faces[a], faces[b], settings.parallel_tolerance_deg * kDegree)) continue;
      const auto all =
          transitions_between(cloud, sections, face_of, faces, a, b, near_plate(scales));
      for (const bool rising : {true, false}) {
        if (a == b && !rising) continue;
        std::vector<Transition> transitions;
        for (const Transition& transition : all)
          if (transition.rising == rising || a == b) transitions.push_back(transition);
        const std::array<int, 2> sides =
            rising ? std::array<int, 2>{a, b} : std::array<int, 2>{b, a};
        auto joint = joint_through(cloud, faces, sides, *frame, sections, face_of,
                                   std::move(transitions), false, scales, settings);
        if (a == b && cloud.organised()) {
          auto by_runs = joint_through(
              cloud, faces, sides, *frame, sections, face_of,
              transitions_within(cloud, sections, *frame, face_of, a, b, near_plate(scales)), true,
              scales, settings);
          if (by_runs && (!joint || clearly_better(*by_runs, *joint))) joint = std::move(by_runs);
        }
        if (joint) joints.push_back(std::move(*joint));
      }
    }
  }
}

}  // namespace

std::vector<Joint> find_parallel_joints(const ScanCloud& cloud, const std::vector<Face>& faces,
                                        const Scales& scales, const SeamFindingSettings& settings) {
  std::vector<Joint> joints;
  const auto way = search_direction(cloud);
  if (!way) return joints;
  add_joints(cloud, faces, true, *way, scales, settings, joints);
  if (!cloud.organised()) return joints;
  std::vector<Joint> together;
  add_joints(cloud, level_faces(cloud, faces, settings.parallel_tolerance_deg * kDegree), false,
             *way, scales, settings, together);
  const std::size_t plain = joints.size();
  for (Joint& joint : together)
    if (std::all_of(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(plain),
                    [&](const Joint& other) { return clearly_better(joint, other); }))
      joints.push_back(std::move(joint));
  return joints;
}

}  // namespace arcstart::seam_finding
