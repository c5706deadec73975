#include "services/seam_finding/geometry/joint_candidates.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/crossing_joints.hpp"
#include "services/seam_finding/joints/edges/gap_floor.hpp"
#include "services/seam_finding/joints/parallel_joints.hpp"

namespace arcstart::seam_finding {
namespace {

// A lap's edge face and its lower plate form a tee, and so do the faces of a groove: what they
// cross at belongs to the joint around it.
bool is_part_of(const Joint& crossing, const Joint& parallel) {
  if (parallel.flaw || 2 * parallel.coverage.covered < crossing.coverage.covered) return false;
  const ParallelSeam& seam = *parallel.parallel;
  const double width = seam.edges[0].distance(seam.edges[1].point);
  return same_seam(parallel, crossing, kJoints.around_parallel + 1.5 * (width + seam.step));
}

// Best first; those with a flaw behind those without.
void sort_by_score(std::vector<Joint>& joints) {
  std::stable_sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) {
    if (static_cast<bool>(a.flaw) != static_cast<bool>(b.flaw)) return !a.flaw;
    return a.score > b.score;
  });
}

}  // namespace

std::vector<Joint> find_joints(const ScanView& scan, std::vector<Face> faces, const Scales& scales,
                               const SeamFindingSettings& settings) {
  faces = turned_to_sensor(scan.points_for(Stage::kSearch), std::move(faces));
  const auto wanted = wanted_types(settings.joint_type);
  std::vector<Joint> joints, parallel;
  for (const JointType type : wanted) {
    if (is_parallel(type)) continue;
    auto found =
        find_crossing_joints(scan.points_for(Stage::kSearch), scan.workpiece(Stage::kSearch), faces,
                             type, scales, settings);
    std::move(found.begin(), found.end(), std::back_inserter(joints));
  }
  if (std::any_of(wanted.begin(), wanted.end(), is_parallel)) {
    // They hang on where stripes pass from the one plate to the other: all points are needed.
    for (Face& face : faces)
      face.points = scan.all_on_plane(std::move(face.points), face.plane, scales.tolerance);
    parallel = find_parallel_joints(scan.points_for(Stage::kMeasure), faces, scales, settings);
    for (Joint& joint : parallel)
      joint.parallel->floor = !joint.flaw && joint.type == JointType::kButt &&
                              shows_floor_near_top(scan, joint, scales);
  }
  std::erase_if(joints, [&](const Joint& crossing) {
    return std::any_of(parallel.begin(), parallel.end(),
                       [&](const Joint& joint) { return is_part_of(crossing, joint); });
  });
  std::move(parallel.begin(), parallel.end(), std::back_inserter(joints));
  sort_by_score(joints);
  return joints;
}

}  // namespace arcstart::seam_finding
