#include "services/seam_finding/joints/joint_candidates.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/crossing_joints.hpp"
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

}  // namespace

std::vector<Joint> find_joints(const ScanView& scan, std::vector<Face> faces, const Scales& scales,
                               const SeamFindingSettings& settings) {
  const ScanCloud& some = scan.points_for(Stage::kSearch);
  faces = turned_to_sensor(some, std::move(faces));
  std::vector<Joint> joints;
  bool parallel_wanted = false;
  for (const JointType type : wanted_types(settings.joint_type)) {
    parallel_wanted |= is_parallel(type);
    if (is_parallel(type)) continue;
    auto found =
        find_crossing_joints(some, scan.workpiece(Stage::kSearch), faces, type, scales, settings);
    std::move(found.begin(), found.end(), std::back_inserter(joints));
  }
  if (!parallel_wanted) return joints;
  // Joints between parallel faces hang on where stripes pass from the one to the other: they need
  // all points.
  for (Face& face : faces)
    face.points = scan.all_on_plane(std::move(face.points), face.plane, scales.tolerance);
  auto parallel = find_parallel_joints(scan.points_for(Stage::kMeasure), faces, scales, settings);
  std::erase_if(joints, [&](const Joint& crossing) {
    return std::any_of(parallel.begin(), parallel.end(),
                       [&](const Joint& joint) { return is_part_of(crossing, joint); });
  });
  std::move(parallel.begin(), parallel.end(), std::back_inserter(joints));
  sort_by_score(joints);
  return joints;
}

}  // namespace arcstart::seam_finding
