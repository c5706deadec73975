#include "services/seam_finding/answer/seam_answer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "services/seam_finding/answer/parallel_measurements.hpp"
#include "services/seam_finding/answer/seam_measurements.hpp"
#include "services/seam_finding/answer/torch.hpp"
#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/ends/crossing_ends.hpp"
#include "services/seam_finding/ends/parallel_ends.hpp"
#include "services/seam_finding/gaps/root_gap.hpp"
#include "services/seam_finding/joints/parallel_joints.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {
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
      return fmt::format("the {} was not seen well and may lie elsewhere; ", which);
    case EndVisibility::kSeen:
      break;
  }
  if (end.by_edges) return "";
  return fmt::format("the {} is known to half a stripe spacing, no stripe crosses an edge there; ",
                     which);
}

std::array<PlaneAccuracy, 2> plane_accuracies(const ScanCloud& scan, const Joint& joint,
                                              const Scales& scales,
                                              const SeamFindingSettings& settings) {
  std::array<PlaneAccuracy, 2> accuracies;
  for (int j = 0; j < 2; ++j)
    accuracies[j] = plane_accuracy(scan, joint.plates[j], joint.plates[1 - j], joint.line,
                                   settings.refit_distance_mm, scales.spacing);
  return accuracies;
}

std::array<SeamEnd, 2> ends_of(const ScanCloud& scan, const Joint& joint, const Scales& scales,
                               const SeamFindingSettings& settings) {
  const EndSearch search{scales.tolerance, scales.noise, settings.edge_shortening_px,
                         settings.edge_squareness_mm / (2 * 100)};
  std::array<SeamEnd, 2> ends;
  if (joint.flat) {
    const auto stations = stations_by_border(scan, joint, course_search(scales));
    for (const SeamSide side : {SeamSide::kBegin, SeamSide::kEnd})
      ends[side == SeamSide::kEnd] = find_flat_end(scan, joint, stations, side, search);
    return ends;
  }
  const auto stripes =
      plate_stripes(scan, joint.plates, joint.line, scales.tolerance, scales.noise);
  for (const SeamSide side : {SeamSide::kBegin, SeamSide::kEnd})
    ends[side == SeamSide::kEnd] =
        find_end(scan, joint.plates, joint.course, stripes, side, search);
  return ends;
}

// Of a tee, an inside corner and a lap; those of butt joints and grooves come with their stations.
void set_root_gaps(const ScanCloud& scan, const Joint& joint, std::vector<SurveyPlace>& stations) {
  std::array<JointPlate, 2> plates = joint.plates;
  int standing = -1;
  if (joint.type == JointType::kLap) {
    // The upper plate's cut, square to the lower plate.
    const JointPlate& lower = plates[joint.flat->lower];
    standing = 1 - joint.flat->lower;
    plates[standing] = JointPlate{};
    plates[standing].plane = {lower.away, -lower.away.dot(joint.line.point)};
  } else if (joint.type != JointType::kTee && joint.type != JointType::kCorner) {
    return;
  }
  const auto gaps = root_gaps(scan, plates, joint.line, standing);
  for (SurveyPlace& place : stations)
    if (place.stripe >= 0 && !place.tack && gaps[place.stripe])
      place.gap = gaps[place.stripe]->width, place.gap_deviation = gaps[place.stripe]->deviation;
}

std::vector<SurveyPlace> survey_of(const ScanCloud& scan, const Joint& joint, double start,
                                   double end, const Scales& scales) {
  auto stations = joint.flat
                      ? survey_flat(scan, joint, joint.course.stations, start, end, scales.spacing)
                      : survey_seam(scan, joint.plates, joint.line, start, end, scales.spacing);
  set_root_gaps(scan, joint, stations);
  return stations;
}

// Where it starts and ends, and how sure that is.
void set_ends(SeamResult& result, const ScanCloud& scan, const Joint& joint, const Scales& scales,
              const SeamFindingSettings& settings) {
  auto [start, end] = ends_of(scan, joint, scales, settings);
  if (settings.start_rule == "stripe") start.along = joint.course.begin;
  if (settings.start_rule == "centroid" && !joint.flat)
    start.along =
        centroid_of_first(scan, joint.plates, joint.line, joint.course, settings.start_points);
  result.start = joint.line.at(start.along);
  result.end = joint.line.at(end.along);
  result.start_visibility = start.visibility;
  result.end_visibility = end.visibility;
  const auto accuracies = plane_accuracies(scan, joint, scales, settings);
  if (settings.start_rule == "edges")
    result.accuracy = joint.flat ? flat_accuracy(joint, accuracies, start, end)
                                 : seam_accuracy(joint.plates, joint.line, accuracies, start, end);
  if (scan.organised()) result.remark += in_words(start, "start") + in_words(end, "end");
}

// Mean over the stations, and its deviation: of the mean, not of a single station.
void set_gap(SeamResult& result) {
  double sum = 0, count = 0, deviation = 0;
  for (const SurveyPlace& place : result.stations)
    if (place.gap >= 0) sum += place.gap, deviation += place.gap_deviation, ++count;
  if (count == 0) return;
  result.gap = sum / count;
  result.gap_deviation = deviation / count;
}

// The faces between which the torch stands. Between parallel plates they are thought: of a lap the
// upper one's cut, of the others a right angle about their normal.
std::array<Eigen::Vector3d, 2> torch_faces(const Joint& joint) {
  const Eigen::Vector3d& normal = joint.plates[0].plane.normal;
  if (!joint.flat) return {normal, joint.plates[1].plane.normal};
  const Eigen::Vector3d across = normal.cross(joint.line.direction).normalized();
  if (joint.type == JointType::kLap) return {normal, joint.plates[joint.flat->lower].away};
  return {(normal + across).normalized(), (normal - across).normalized()};
}

std::string flat_in_words(const Joint& joint) {
  if (joint.type == JointType::kLap)
    return fmt::format("the upper plate is {:.1f} mm thick; ", joint.flat->step);
  if (joint.type == JointType::kV)
    return fmt::format("the groove opens by {:.0f} deg, its gap is given at the top; ",
                       joint.angle / kDegree);
  return "";
}

}  // namespace

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
  const double start = joint.line.along(result.start), end = joint.line.along(result.end);
  result.stations = survey_of(scan, joint, start, end, scales);
  set_gap(result);
  result.course = polyline_through(result.stations, result.start, result.end, kStraight);
  for (SurveyPlace& place : result.stations) place.along -= start;
  const bool one_plane = joint.type == JointType::kButt || joint.type == JointType::kV;
  result.torch = torch_at(result.start, result.direction, torch_faces(joint),
                          {one_plane ? 0 : settings.torch_work_angle_deg * kDegree,
                           settings.torch_travel_angle_deg * kDegree, settings.approach_mm});
  if (joint.flat) result.remark += flat_in_words(joint);
  if (result.gap < 0)
    result.remark += "gap not determined; ";
  else if (result.gap < 2 * result.gap_deviation)
    result.remark += "the gap cannot be told from none; ";
}

}  // namespace arcstart::seam_finding
