#include "services/seam_finding/joints/joint_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/joints/crossing_joints.hpp"
#include "services/seam_finding/joints/joint_refinement.hpp"
#include "services/seam_finding/joints/parallel_joints.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kShortestSeam = 10;  // mm: less of it seen on both plates is no seam
constexpr double kShortestFlat = 20;  // of plates that only lie side by side
constexpr int kAlternatives = 6;
constexpr double kAround = 3;      // of a joint between parallel plates; mm
constexpr int kMissingInARow = 3;  // stripes before the start

SeamResult::Alternative as_alternative(const Joint& joint, std::string reason) {
  return {name_of(joint.type), joint.score, joint.start(), joint.end(), std::move(reason)};
}

// theta and epsilon of Eq. 6; rad.
std::pair<double, double> angle_wanted(JointType type, const SeamFindingSettings& settings) {
  if (type == JointType::kOutsideCorner)
    return {settings.outside_corner_angle_deg * kDegree,
            settings.outside_corner_tolerance_deg * kDegree};
  return {settings.angle_deg * kDegree, settings.angle_tolerance_deg * kDegree};
}

JointSearch joint_search(const ScanCloud& cloud, const Scales& scales,
                         const SeamFindingSettings& settings, JointType type) {
  JointSearch search;
  search.type = type;
  std::tie(search.angle, search.angle_tolerance) = angle_wanted(type, settings);
  search.tolerance = scales.tolerance;
  search.stripes_min = settings.stripes_min;
  search.length_min =
      cloud.organised() ? kShortestSeam : std::max(20.0, settings.stripes_min * scales.spacing);
  search.contact = scales.contact;
  search.course = course_search(scales);
  return search;
}

FlatSearch flat_search(const SeamFindingSettings& settings) {
  FlatSearch search;
  search.parallel = settings.parallel_tolerance_deg * kDegree;
  search.step_min = settings.lap_thickness_min_mm;
  search.step_max = settings.lap_thickness_max_mm;
  search.gap_max = settings.butt_gap_max_mm;
  search.half_angle_min = (settings.v_angle_deg - settings.v_angle_tolerance_deg) / 2 * kDegree;
  search.half_angle_max = (settings.v_angle_deg + settings.v_angle_tolerance_deg) / 2 * kDegree;
  search.width_max = settings.v_width_max_mm;
  search.stripes_min = settings.stripes_min;
  search.length_min = kShortestFlat;
  return search;
}

// A lap's cut and its lower plate form a tee, and so do the slants of a groove: what they cross at
// belongs to the joint around it.
bool is_part_of(const Joint& crossing, const Joint& flat) {
  if (!flat.flaw.empty() || 2 * flat.course.covered < crossing.course.covered) return false;
  const FlatSeam& seam = *flat.flat;
  const double width = seam.borders[0].distance(seam.borders[1].point);
  return same_seam(flat, crossing, kAround + 1.5 * (width + seam.step));
}

// Best first; those with a flaw behind those without.
void join_flat_ones(std::vector<Joint>& joints, std::vector<Joint> flat) {
  std::erase_if(joints, [&](const Joint& crossing) {
    return std::any_of(flat.begin(), flat.end(),
                       [&](const Joint& joint) { return is_part_of(crossing, joint); });
  });
  std::move(flat.begin(), flat.end(), std::back_inserter(joints));
  sort_by_score(joints);
}

// Joints between faces that lie in one plane, or in parallel ones, hang on where stripes pass from
// the one to the other: they need all points.
std::vector<Joint> joints_between(const ScanCloud& scan, const ThinnedCloud& thinned,
                                  const std::vector<int>& left, std::vector<Face> faces,
                                  const Scales& scales, const SeamFindingSettings& settings) {
  const bool is_thinned = thinned.is_less_than(scan);
  const ScanCloud& some = is_thinned ? thinned.cloud : scan;
  const auto certain = turn_to_sensor(some, faces);
  std::vector<Joint> joints;
  FlatSearch flat = flat_search(settings);
  for (const JointType type : wanted_types(settings.joint_type)) {
    flat.lap |= type == JointType::kLap;
    flat.butt |= type == JointType::kButt;
    flat.v |= type == JointType::kV;
    if (is_flat(type)) continue;
    auto found =
        rank_joints(some, left, faces, certain, joint_search(some, scales, settings, type));
    std::move(found.begin(), found.end(), std::back_inserter(joints));
  }
  if (!flat.lap && !flat.butt && !flat.v) return joints;
  if (is_thinned)
    for (Face& face : faces)
      face.points = in_whole(scan, thinned, face.points, face.plane, scales.tolerance);
  join_flat_ones(joints, find_flat_joints(scan, faces, flat, scales));
  return joints;
}

Refit refit_of(const Scales& scales, const SeamFindingSettings& settings) {
  Refit refit;
  refit.distance = settings.refit_distance_mm;
  refit.neighbours = settings.outlier_neighbours;
  refit.deviations = settings.outlier_deviations;
  refit.noise = scales.noise;
  refit.tolerance = scales.tolerance;
  return refit;
}

// One entry a seam, best first; those that may be one are measured again beside it.
std::vector<Joint> distinct_seams(const ScanCloud& scan, std::vector<Joint> joints,
                                  const Refit& refit, const Scales& scales) {
  std::vector<Joint> seams;
  for (Joint& candidate : joints) {
    if (candidate.course.stripes == 0 && !seams.empty())
      continue;  // planes that only point at each other
    if (std::any_of(seams.begin(), seams.end(),
                    [&](const Joint& seam) { return same_seam(seam, candidate, scales.contact); }))
      continue;
    if (candidate.flaw.empty() && !is_flat(candidate.type))
      refit_joint(scan, candidate, refit, course_search(scales));
    seams.push_back(std::move(candidate));
    if (static_cast<int>(seams.size()) == kAlternatives) break;
  }
  return seams;
}

// The first of two passes is by the thinned points; the second, of the best one alone, by all. The
// fits are robust: among so many points strays need not be sought.
std::vector<Joint> distinct_seams(const ScanCloud& scan, const ThinnedCloud& thinned,
                                  std::vector<Joint> joints, const Scales& scales,
                                  const SeamFindingSettings& settings) {
  Refit refit = refit_of(scales, settings);
  if (!thinned.is_less_than(scan)) return distinct_seams(scan, std::move(joints), refit, scales);
  refit.passes = 1, refit.neighbours = 0;
  auto seams = distinct_seams(thinned.cloud, std::move(joints), refit, scales);
  Joint& best = seams.front();
  if (!best.flaw.empty() || is_flat(best.type)) return seams;
  for (JointPlate& plate : best.plates)
    plate.points = in_whole(scan, thinned, plate.points, plate.plane, scales.tolerance);
  refit_joint(scan, best, refit, course_search(scales));
  return seams;
}

// What speaks against the best one, empty where nothing does.
std::string doubt_about(const Joint& best, const SeamFindingSettings& settings) {
  const Course& course = best.course;
  if (!best.flaw.empty()) return "no joint: of the best pair of planes " + best.flaw;
  if (course.stripes < settings.stripes_min)
    return fmt::format("only {} stripes show both plates at the seam", course.stripes);
  const double angle = plates_angle(best);
  const auto [wanted, tolerance] = angle_wanted(best.type, settings);
  if (!is_flat(best.type) && std::abs(angle - wanted) > tolerance)
    return fmt::format("no joint: beside the seam the plates' angle is {:.1f} deg",
                       angle / kDegree);
  if (course.begins_outside)
    return "the seam's start was not seen: both plates are there where the scan begins";
  if (course.missing_before >= kMissingInARow)
    return fmt::format("the seam's start was not seen: {} stripes before it are missing",
                       course.missing_before);
  return "";
}

void refuse(SeamResult& result, std::string reason) {
  result.verdict = SeamResult::Verdict::kRefused;
  result.reason = std::move(reason);
}

}  // namespace

std::optional<Joint> choose_seam(SeamResult& result, const ScanCloud& scan,
                                 const ThinnedCloud& thinned, const std::vector<int>& left,
                                 std::vector<Face> faces, const Scales& scales,
                                 const SeamFindingSettings& settings) {
  const std::size_t planes = faces.size();
  auto joints = joints_between(scan, thinned, left, std::move(faces), scales, settings);
  if (joints.empty()) {
    refuse(result, planes == 1 ? std::string("one plane only: a joint needs two")
                               : fmt::format("no joint: of {} planes no two meet under the angle "
                                             "wanted",
                                             planes));
    return std::nullopt;
  }
  const std::vector<Joint> seams =
      distinct_seams(scan, thinned, std::move(joints), scales, settings);
  const Joint& best = seams.front();
  int rivals = 0;
  for (std::size_t i = 1; i < seams.size(); ++i) {
    const bool rival = best.flaw.empty() && seams[i].flaw.empty() &&
                       seams[i].score * settings.ambiguity_ratio >= best.score;
    rivals += rival;
    result.alternatives.push_back(as_alternative(seams[i], !seams[i].flaw.empty() ? seams[i].flaw
                                                           : rival
                                                               ? "its score is too near the best"
                                                               : "its score is lower"));
  }
  const std::string doubt = doubt_about(best, settings);
  if (!doubt.empty() || rivals > 0)
    result.alternatives.insert(
        result.alternatives.begin(),
        as_alternative(best, !doubt.empty() ? doubt : "another's score is too near"));
  if (!doubt.empty()) {
    refuse(result, doubt);
  } else if (rivals > 0) {
    result.verdict = SeamResult::Verdict::kAmbiguous;
    result.reason = fmt::format("{} seams with scores within a factor of {}", rivals + 1,
                                settings.ambiguity_ratio);
  } else {
    return best;
  }
  return std::nullopt;
}

}  // namespace arcstart::seam_finding
