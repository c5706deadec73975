#include "services/seam_finding/find_seam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "services/seam_finding/joints.hpp"
#include "services/seam_finding/plane_fit.hpp"
#include "services/seam_finding/refit.hpp"
#include "services/seam_finding/scales.hpp"

namespace arcstart {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kShortestSeam = 10;    // mm: less of it seen on both plates is no seam
constexpr double kStationSpacings = 3;  // between stations of a cloud without stripes
constexpr double kStraight = 0.5;       // mm
constexpr int kAlternatives = 6;
constexpr int kMissingInARow = 3;              // stripes before the start
constexpr std::size_t kMostBackground = 8192;  // points; of more so many are looked at
constexpr double kContinues = 0.25;  // share of a face's points that lie in its plane as background

CourseSearch course_search(const Scales& scales) {
  CourseSearch search;
  search.spacing = scales.spacing;
  search.tolerance = scales.tolerance;
  return search;
}

JointSearch joint_search(const ScanCloud& cloud, const Scales& scales,
                         const SeamFindingSettings& settings) {
  JointSearch search;
  search.angle = settings.angle_deg * kDegree;
  search.angle_tolerance = settings.angle_tolerance_deg * kDegree;
  search.tolerance = scales.tolerance;
  search.stripes_min = settings.stripes_min;
  search.length_min =
      cloud.organised() ? kShortestSeam : std::max(20.0, settings.stripes_min * scales.spacing);
  search.contact = scales.contact;
  search.course = course_search(scales);
  return search;
}

// A face in whose plane the background goes on is background that its scan did not reach, or let
// through.
bool continues_background(const ScanCloud& scan, const std::vector<int>& background,
                          const Face& face, const Scales& scales) {
  Eigen::Vector3d low = scan.points[face.points.front()], high = low;
  for (const int i : face.points)
    low = low.cwiseMin(scan.points[i]), high = high.cwiseMax(scan.points[i]);
  const double around = 4 * scales.connection;
  PlaneSums in_plane(low);
  const std::size_t every = 1 + background.size() / kMostBackground;
  for (std::size_t i = 0; i < background.size(); i += every) {
    const Eigen::Vector3d& p = scan.points[background[i]];
    if (std::abs(face.plane.signed_distance(p)) <= scales.tolerance &&
        (p - low).minCoeff() > -around && (high - p).minCoeff() > -around)
      in_plane.add(p);
  }
  // Where the plane only cuts through the background they lie on a narrow strip.
  return in_plane.weight() * static_cast<double>(every) >=
             std::max(10.0, kContinues * static_cast<double>(face.points.size())) &&
         in_plane.fit().spread[0] > 3 * scales.tolerance;
}

// The paper's own way: the largest plane, then the largest that satisfies Eq. 6 with it.
std::vector<Face> two_largest_faces(const ScanCloud& scan, const std::vector<int>& left,
                                    PlaneSearch search, const JointSearch& joint,
                                    std::uint64_t seed) {
  search.most_faces = 1;
  auto faces = find_faces(scan, left, search, seed);
  if (faces.empty()) return faces;
  std::vector<int> rest;
  std::set_difference(left.begin(), left.end(), faces[0].points.begin(), faces[0].points.end(),
                      std::back_inserter(rest));
  const Eigen::Vector3d n1 = faces[0].plane.normal;
  search.accept = [&](const Plane& plane) {
    const double angle = std::acos(std::min(1.0, std::abs(n1.dot(plane.normal))));
    return std::min(std::abs(angle - joint.angle), std::abs(M_PI - angle - joint.angle)) <
           joint.angle_tolerance;
  };
  for (Face& face : find_faces(scan, rest, search, seed)) faces.push_back(std::move(face));
  return faces;
}

SeamResult& refuse(SeamResult& result, std::string reason) {
  result.verdict = SeamResult::Verdict::kRefused;
  result.reason = std::move(reason);
  return result;
}

SeamResult::Alternative as_alternative(const Joint& joint, std::string reason) {
  return {"tee", joint.score, joint.start(), joint.end(), std::move(reason)};
}

std::string in_words(const SeamEnd& end, const std::string& which) {
  switch (end.visibility) {
    case EndVisibility::kHidden:
      return fmt::format("the {} is hidden, the seam reaches at least so far; ", which);
    case EndVisibility::kOutside:
      return fmt::format("the seam runs on where the scan {}; ",
                         which == "end" ? "ends" : "begins");
    case EndVisibility::kNotDetermined:
      return fmt::format("the {} was not seen well, the seam reaches at least so far; ", which);
    case EndVisibility::kSeen:
      break;
  }
  if (end.by_edges) return "";
  return fmt::format("the {} is known to half a stripe spacing, no stripe crosses an edge there; ",
                     which);
}

// Where it starts and ends, and how sure that is.
void set_ends(SeamResult& result, const ScanCloud& scan, const Joint& joint, const Scales& scales,
              const SeamFindingSettings& settings) {
  const EndSearch search{scales.tolerance, settings.edge_shortening_px};
  const Stations stations = stations_along(scan, joint.plates, joint.line, course_search(scales));
  SeamEnd start =
      find_end(scan, joint.plates, joint.line, joint.course, stations, SeamSide::kBegin, search);
  const SeamEnd end =
      find_end(scan, joint.plates, joint.line, joint.course, stations, SeamSide::kEnd, search);
  if (settings.start_rule == "stripe") start.along = joint.course.begin;
  if (settings.start_rule == "centroid")
    start.along =
        centroid_of_first(scan, joint.plates, joint.line, joint.course, settings.start_points);
  result.start = joint.line.at(start.along);
  result.end = joint.line.at(end.along);
  result.start_visibility = start.visibility;
  result.end_visibility = end.visibility;
  std::array<PlaneAccuracy, 2> accuracies;
  for (int j = 0; j < 2; ++j)
    accuracies[j] = plane_accuracy(scan, joint.plates[j], joint.plates[1 - j], joint.line,
                                   settings.refit_distance_mm, scales.spacing);
  if (settings.start_rule == "edges")
    result.accuracy = seam_accuracy(joint.plates, joint.line, accuracies, start, end);
  if (scan.organised()) result.remark += in_words(start, "start") + in_words(end, "end");
}

void answer(SeamResult& result, const ScanCloud& scan, const Joint& joint, const Scales& scales,
            const SeamFindingSettings& settings) {
  result.verdict = SeamResult::Verdict::kFound;
  result.joint_type = "tee";
  result.direction = joint.line.direction;
  result.angle = joint.angle;
  for (int j = 0; j < 2; ++j) {
    result.normals[j] = joint.plates[j].plane.normal;
    result.plates[j] = joint.plates[j].points;
  }
  if (joint.course.missing_before > 0)
    result.remark +=
        fmt::format("{} stripes right before the start are missing; ", joint.course.missing_before);
  if (joint.course.missing_after > 0)
    result.remark +=
        fmt::format("{} stripes right behind the end are missing; ", joint.course.missing_after);
  set_ends(result, scan, joint, scales, settings);
  const double start = joint.line.along(result.start);
  result.stations = survey_seam(scan, joint.plates, joint.line, start, joint.line.along(result.end),
                                scales.spacing);
  result.course = polyline_through(result.stations, result.start, result.end, kStraight);
  for (SurveyPlace& place : result.stations) place.along -= start;
  result.torch = torch_at(result.start, result.direction, result.normals,
                          {settings.torch_work_angle_deg * kDegree,
                           settings.torch_travel_angle_deg * kDegree, settings.approach_mm});
  result.remark += "not determined: systematic deviations, gap";
}

}  // namespace

void divide(const ScanCloud& scan, const Background& background, Division& division) {
  const int first = division.size();
  const auto rest = std::span(scan.points).subspan(static_cast<std::size_t>(first));
  std::vector<char> inside;
  inside.reserve(rest.size());
  background.classify(rest, inside);
  for (std::size_t i = 0; i < inside.size(); ++i)
    (inside[i] ? division.background : division.left).push_back(first + static_cast<int>(i));
}

SeamResult find_seam(const ScanCloud& scan, const Background& background,
                     const SeamFindingSettings& settings, std::uint64_t seed) {
  Division division;
  divide(scan, background, division);
  return find_seam(scan, std::move(division), settings, seed);
}

SeamResult find_seam(const ScanCloud& scan, Division division, const SeamFindingSettings& settings,
                     std::uint64_t seed) {
  SeamResult result;
  const Sampling sampling = measure_sampling(scan);
  if (!(sampling.spacing > 1e-3))
    return refuse(result, "no cloud: the points, or the tool's positions, coincide");
  if (scan.organised() && !search_direction(scan))
    return refuse(result, "the tool did not move in the scan");
  const Scales scales = scales_of(scan, sampling, settings.plane_tolerance_mm);
  result.background = std::move(division.background);
  const std::vector<int>& left = division.left;

  const PlaneSearch plane = plane_search(scales, settings);
  const JointSearch joint = joint_search(scan, scales, settings);
  auto faces = settings.plane_rule == "largest" ? two_largest_faces(scan, left, plane, joint, seed)
                                                : find_faces(scan, left, plane, seed);
  if (faces.empty())
    return refuse(
        result,
        fmt::format("no workpiece: no plane among the {} of {} points that are not background",
                    left.size(), scan.size()));
  std::erase_if(faces, [&](const Face& face) {
    return continues_background(scan, result.background, face, scales);
  });
  if (faces.empty())
    return refuse(result, "no workpiece: what is left only continues the background");
  if (faces.size() == 1) return refuse(result, "one plane only: a joint needs two");

  const auto certain = turn_to_sensor(scan, faces);
  auto joints = rank_joints(scan, left, faces, certain, joint);
  if (joints.empty())
    return refuse(result, fmt::format("no joint: of {} planes no two meet under the angle wanted",
                                      faces.size()));

  // One entry a seam; those that may be one are measured again beside it.
  std::vector<Joint> seams;
  for (Joint& candidate : joints) {
    if (candidate.course.stripes == 0 && !seams.empty())
      continue;  // planes that only point at each other
    if (std::any_of(seams.begin(), seams.end(),
                    [&](const Joint& seam) { return same_seam(seam, candidate, scales.contact); }))
      continue;
    if (candidate.flaw.empty())
      refit_joint(scan, candidate,
                  {settings.refit_distance_mm, settings.outlier_neighbours,
                   settings.outlier_deviations, scales.noise, scales.tolerance},
                  joint.course);
    seams.push_back(std::move(candidate));
    if (static_cast<int>(seams.size()) == kAlternatives) break;
  }

  const Joint& best = seams.front();
  const Course& course = best.course;
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
  std::string doubt;
  if (!best.flaw.empty())
    doubt = "no joint: of the best pair of planes " + best.flaw;
  else if (course.stripes < settings.stripes_min)
    doubt = fmt::format("only {} stripes show both plates at the seam", course.stripes);
  else if (std::abs(best.angle - joint.angle) > joint.angle_tolerance)
    doubt = fmt::format("no joint: beside the seam the plates' angle is {:.1f} deg",
                        best.angle / kDegree);
  else if (course.begins_outside)
    doubt = "the seam's start was not seen: both plates are there where the scan begins";
  else if (course.missing_before >= kMissingInARow)
    doubt = fmt::format("the seam's start was not seen: {} stripes before it are missing",
                        course.missing_before);
  if (!doubt.empty() || rivals > 0)
    result.alternatives.insert(
        result.alternatives.begin(),
        as_alternative(best, !doubt.empty() ? doubt : "another's score is too near"));
  if (!doubt.empty()) return refuse(result, doubt);
  if (rivals > 0) {
    result.verdict = SeamResult::Verdict::kAmbiguous;
    result.reason = fmt::format("{} seams with scores within a factor of {}", rivals + 1,
                                settings.ambiguity_ratio);
    return result;
  }
  answer(result, scan, best, scales, settings);
  return result;
}

}  // namespace arcstart
