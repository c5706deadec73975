#include "services/seam_finding/seam_answer.hpp"

#include <fmt/format.h>

#include <cmath>

namespace arcstart {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kStraight = 0.5;  // mm

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

}  // namespace

CourseSearch course_search(const Scales& scales) {
  CourseSearch search;
  search.spacing = scales.spacing;
  search.tolerance = scales.tolerance;
  return search;
}

void answer(SeamResult& result, const ScanCloud& scan, const Joint& joint, const Scales& scales,
            const SeamFindingSettings& settings) {
  result.verdict = SeamResult::Verdict::kFound;
  result.joint_type = name_of(joint.type);
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

}  // namespace arcstart
