#include "services/seam_finding/find_seam.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "services/seam_finding/answer/accuracy.hpp"
#include "services/seam_finding/answer/description.hpp"
#include "services/seam_finding/answer/seam_measurements.hpp"
#include "services/seam_finding/answer/weld_order.hpp"
#include "services/seam_finding/background/continuation.hpp"
#include "services/seam_finding/background/scan_view.hpp"
#include "services/seam_finding/cloud/sampling.hpp"
#include "services/seam_finding/cloud/scales.hpp"
#include "services/seam_finding/ends/seam_ends.hpp"
#include "services/seam_finding/geometry/joint_candidates.hpp"
#include "services/seam_finding/joints/joint_choice.hpp"
#include "services/seam_finding/paper/find_seam_as_in_the_paper.hpp"
#include "services/seam_finding/planes/planes.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

Reason unusable(const ScanCloud& cloud, const Sampling& sampling) {
  if (!(sampling.spacing > 1e-3)) return {Code::kNoCloud};
  if (cloud.organised() && !search_direction(cloud)) return {Code::kToolStoodStill};
  return {};
}

SeamResult refused(const Reason& reason) {
  SeamResult result;
  result.reason = reason;
  return result;
}

SeamResult not_found(Choice choice) {
  SeamResult result = refused(choice.reason);
  if (choice.ambiguous) result.verdict = SeamResult::Verdict::kAmbiguous;
  result.alternatives = std::move(choice.alternatives);
  return result;
}

// Joints whose middle lies outside the search box go behind the others: a flaw. What they are made
// of stays in the cloud, where it may hide a plate, or close a seam.
void set_aside_outside(std::vector<Joint>& candidates, const SeamFindingSettings& settings) {
  if (settings.search_box_mm.empty()) return;
  for (Joint& joint : candidates) {
    const double outside = outside_box(settings, (joint.start() + joint.end()) / 2);
    if (outside > 0 && !joint.flaw) joint.flaw = {Code::kOutsideBox, outside};
  }
  std::stable_partition(candidates.begin(), candidates.end(),
                        [](const Joint& joint) { return !joint.flaw; });
}

// The ends by the rule that is set.
std::array<SeamEnd, 2> find_ends(const ScanCloud& cloud, const Joint& joint, const Scales& scales,
                                 const SeamFindingSettings& settings) {
  auto ends = find_seam_ends(cloud, joint, scales, settings);
  if (settings.start_rule == StartRule::kStripe) ends[0].along = joint.coverage.begin;
  if (settings.start_rule == StartRule::kCentroid && !joint.parallel)
    ends[0].along =
        centroid_of_first(cloud, joint.plates, joint.line, joint.coverage, settings.start_points);
  return ends;
}

Findings measure(const ScanCloud& cloud, const Joint& joint, const Scales& scales,
                 const SeamFindingSettings& settings) {
  Findings findings;
  findings.ends = find_ends(cloud, joint, scales, settings);
  if (settings.start_rule == StartRule::kEdges)
    findings.accuracy = seam_accuracy(cloud, joint, findings.ends, scales, settings);
  const auto along = [&](const SeamEnd& end) { return joint.line.along(joint.line.at(end.along)); };
  findings.stations =
      measure_seam(cloud, joint, along(findings.ends[0]), along(findings.ends[1]), scales.spacing);
  findings.with_stripes = cloud.organised();
  return findings;
}

}  // namespace

SeamResult find_seam(const ScanCloud& cloud, const Background& background,
                     const SeamFindingSettings& settings, std::uint64_t seed) {
  Segmentation segmentation;
  segment(cloud, background, segmentation);
  DownsampledCloud fewer;
  downsample(cloud, fewer);
  SeamResult result = find_seam(cloud, segmentation, fewer, settings, seed);
  result.background = std::move(segmentation.background);
  return result;
}

SeamResult find_seam(const ScanCloud& cloud, const Segmentation& segmentation,
                     const DownsampledCloud& fewer, const SeamFindingSettings& settings,
                     std::uint64_t seed) {
  const bool as_in_the_paper = settings.plane_rule == PlaneRule::kLargest;  // it counts all points
  const DownsampledCloud none;
  const ScanView scan(cloud, segmentation, as_in_the_paper ? none : fewer);
  const ScanCloud& some = scan.points_for(Stage::kSearch);

  const Sampling sampling = measure_sampling(some);
  if (const Reason why = unusable(cloud, sampling)) return refused(why);
  const Scales scales = scales_of(some, sampling, settings.plane_tolerance_mm);

  const PlaneSearch search = plane_search(scales, settings);
  const std::vector<int>& workpiece = scan.workpiece(Stage::kSearch);
  std::vector<Face> faces = as_in_the_paper
                                ? two_largest_faces(some, workpiece, search, settings, seed)
                                : find_faces(some, workpiece, search, seed);
  if (faces.empty())
    return refused({Code::kNoPlane, static_cast<double>(segmentation.workpiece.size()),
                    static_cast<double>(cloud.size())});
  faces = without_background(some, scan.segmentation(Stage::kSearch), std::move(faces), scales);
  if (faces.empty()) return refused({Code::kBackgroundGoesOn});

  const auto planes = static_cast<double>(faces.size());
  auto candidates = find_joints(scan, std::move(faces), scales, settings);
  if (candidates.empty())
    return refused(planes == 1 ? Reason{Code::kOnePlane} : Reason{Code::kNoPair, planes});
  set_aside_outside(candidates, settings);
  Choice choice = choose_joint(scan, std::move(candidates), scales, settings);
  if (!choice.joint) return not_found(std::move(choice));

  Findings findings = measure(cloud, *choice.joint, scales, settings);
  SeamResult result = describe(std::move(*choice.joint), std::move(findings), settings);
  result.alternatives = std::move(choice.alternatives);
  const double length = (result.end - result.start).norm();
  if (length < settings.seam_length_min_mm) {
    SeamResult shorter = refused({Code::kSeamTooShort, length, settings.seam_length_min_mm});
    shorter.alternatives = std::move(result.alternatives);
    return shorter;
  }
  return result;
}

}  // namespace arcstart::seam_finding
