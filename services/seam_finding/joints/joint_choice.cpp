#include "services/seam_finding/joints/joint_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/crossing_joints.hpp"
#include "services/seam_finding/joints/joint_refinement.hpp"

namespace arcstart::seam_finding {
namespace {

SeamResult::Alternative as_alternative(const Joint& joint, const Reason& reason) {
  return {name_of(joint.type), joint.score, joint.start(), joint.end(), reason};
}

// One entry a seam, best first; crossing plates that may be one are measured again beside it.
std::vector<Joint> distinct_seams(const ScanCloud& cloud, std::vector<Joint> joints,
                                  const RefinementPasses& passes, const Scales& scales,
                                  const SeamFindingSettings& settings) {
  std::vector<Joint> seams;
  for (Joint& candidate : joints) {
    if (candidate.coverage.stripes == 0 && !seams.empty())
      continue;  // planes that only point at each other
    if (std::any_of(seams.begin(), seams.end(),
                    [&](const Joint& seam) { return same_seam(seam, candidate, scales.contact); }))
      continue;
    const bool again = !candidate.flaw && !candidate.parallel;
    seams.push_back(again ? refined(cloud, std::move(candidate), passes, scales, settings)
                          : std::move(candidate));
    if (seams.size() == kJoints.alternatives) break;
  }
  return seams;
}

// Where fewer points serve, the first of two passes is by them; the second, of the best one alone,
// by all. The fits are robust: among so many points strays need not be sought.
std::vector<Joint> distinct_seams(const ScanView& scan, std::vector<Joint> joints,
                                  const Scales& scales, const SeamFindingSettings& settings) {
  const RefinementPasses passes =
      scan.has_fewer() ? RefinementPasses{1, false} : RefinementPasses();
  auto seams =
      distinct_seams(scan.points_for(Stage::kSearch), std::move(joints), passes, scales, settings);
  Joint& best = seams.front();
  if (!scan.has_fewer() || best.flaw || best.parallel) return seams;
  for (JointPlate& plate : best.plates)
    plate.points = scan.all_on_plane(std::move(plate.points), plate.plane, scales.tolerance);
  best = refined(scan.points_for(Stage::kMeasure), std::move(best), passes, scales, settings);
  return seams;
}

// What speaks against the best one, none where nothing does.
Reason doubt_about(const Joint& best, const SeamFindingSettings& settings) {
  using Code = Reason::Code;
  const Coverage& course = best.coverage;
  if (best.flaw) return {Code::kNoJoint, best.flaw.number, 0, 0, best.flaw.code};
  if (course.stripes < settings.stripes_min)
    return {Code::kFewStripesAtSeam, static_cast<double>(course.stripes)};
  if (!best.parallel) {
    const WantedAngle wanted = wanted_angle(best.type, settings);
    if (std::abs(plates_angle(best) - wanted.angle) > wanted.tolerance)
      return {Code::kAngleBesideSeam, plates_angle(best)};
  }
  if (course.begins_outside) return {Code::kStartBeforeScan};
  if (course.missing_before >= kModel.stripes_in_a_row)
    return {Code::kStartMissing, static_cast<double>(course.missing_before)};
  return {};
}

}  // namespace

Choice choose_joint(const ScanView& scan, std::vector<Joint> candidates, const Scales& scales,
                    const SeamFindingSettings& settings) {
  using Code = Reason::Code;
  std::vector<Joint> seams = distinct_seams(scan, std::move(candidates), scales, settings);
  Joint& best = seams.front();
  Choice choice;
  int rivals = 0;
  for (std::size_t i = 1; i < seams.size(); ++i) {
    const bool rival =
        !best.flaw && !seams[i].flaw && seams[i].score * settings.ambiguity_ratio >= best.score;
    rivals += rival;
    const Reason lower{rival ? Code::kScoreTooNear : Code::kScoreLower};
    choice.alternatives.push_back(as_alternative(seams[i], seams[i].flaw ? seams[i].flaw : lower));
  }
  choice.reason = doubt_about(best, settings);
  choice.ambiguous = !choice.reason && rivals > 0;
  if (choice.reason || choice.ambiguous)
    choice.alternatives.insert(
        choice.alternatives.begin(),
        as_alternative(best, choice.reason ? choice.reason : Reason{Code::kAnotherScoreTooNear}));
  if (choice.ambiguous)
    choice.reason = {Code::kSimilarScores, static_cast<double>(rivals + 1),
                     settings.ambiguity_ratio};
  if (!choice.reason) choice.joint = std::move(best);
  return choice;
}

}  // namespace arcstart::seam_finding
