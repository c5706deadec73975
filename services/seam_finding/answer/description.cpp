#include "services/seam_finding/answer/description.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/seam_finding/answer/constants.hpp"
#include "services/seam_finding/answer/seam_measurements.hpp"
#include "services/seam_finding/answer/torch.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

Reason remark_on(const SeamEnd& end, SeamSide side) {
  const bool start = side == SeamSide::kBegin;
  switch (end.visibility) {
    case EndVisibility::kHidden:
      return {start ? Code::kStartHidden : Code::kEndHidden};
    case EndVisibility::kOutside:
      return {start ? Code::kStartOutside : Code::kEndOutside};
    case EndVisibility::kNotDetermined:
      return {start ? Code::kStartUncertain : Code::kEndUncertain};
    case EndVisibility::kSeen:
      break;
  }
  if (end.by_edges) return {};
  return {start ? Code::kStartBetweenStripes : Code::kEndBetweenStripes};
}

Reason remark_on_gap(const SeamResult& result) {
  if (result.gap < 0) return {Code::kNoGap};
  if (result.gap < 2 * result.gap_deviation) return {Code::kGapLikeNone};
  return {};
}

// Mean over the stations, and its deviation: of the mean, not of a single station.
void set_gap(SeamResult& result) {
  double sum = 0, count = 0, deviation = 0;
  for (const SeamMeasurement& place : result.stations)
    if (place.gap >= 0) sum += place.gap, deviation += place.gap_deviation, ++count;
  if (count == 0) return;
  result.gap = sum / count;
  result.gap_deviation = deviation / count;
}

bool in_one_plane(const Joint& joint) {
  return joint.type == JointType::kButt || joint.type == JointType::kV;
}

// Between the plates' tops, each carried to the seam's line, out of the first one; mm.
double height_between(const SeamResult& result) {
  const Eigen::Vector3d middle = (result.start + result.end) / 2;
  const Eigen::Vector3d& out = result.normals[0];
  const auto height = [&](const Plane& top) {
    return -top.signed_distance(middle) / top.normal.dot(out);
  };
  return std::abs(height(result.faces[1].plane) - height(result.faces[0].plane));
}

// Normals of the two faces between which the torch stands. For parallel plates the second face is
// virtual: for a lap the upper plate's edge face, for the others both, a right angle about their
// normal.
std::array<Eigen::Vector3d, 2> torch_faces(const Joint& joint) {
  const Eigen::Vector3d& normal = joint.plates[0].plane.normal;
  if (joint.type == JointType::kLap) return {normal, joint.plates[joint.parallel->lower].away};
  if (!in_one_plane(joint)) return {normal, joint.plates[1].plane.normal};
  const Eigen::Vector3d across = normal.cross(joint.line.direction).normalized();
  return {(normal + across).normalized(), (normal - across).normalized()};
}

SeamPlate face_of(const Joint& joint, int j) {
  SeamPlate face;
  face.plane = joint.plates[j].plane;
  face.away = away_from_seam(joint.plates[j], joint.plates[1 - j]);
  if (joint.parallel)
    face.inset = std::max(0.0, face.away.dot(joint.parallel->edges[j].point - joint.line.point));
  return face;
}

}  // namespace

SeamResult describe(Joint joint, Findings findings, const SeamFindingSettings& settings) {
  SeamResult result;
  const auto remark = [&](const Reason& reason) {
    if (reason) result.remarks.push_back(reason);
  };
  result.verdict = SeamResult::Verdict::kFound;
  result.joint_type = name_of(joint.type);
  result.direction = joint.line.direction;
  result.angle = joint.angle;
  if (joint.type == JointType::kLap) result.thickness = joint.parallel->step;
  if (joint.type == JointType::kV) result.groove_angle = joint.angle;
  for (int j = 0; j < 2; ++j) {
    result.normals[j] = joint.plates[j].plane.normal;
    result.faces[j] = face_of(joint, j);
    result.plates[j] = std::move(joint.plates[j].points);
  }
  const Coverage& course = joint.coverage;
  if (course.missing_before > 0)
    remark({Code::kMissingBeforeStart, static_cast<double>(course.missing_before)});
  if (course.missing_after > 0)
    remark({Code::kMissingAfterEnd, static_cast<double>(course.missing_after)});

  const auto& [start, end] = findings.ends;
  result.start = joint.line.at(start.along);
  result.end = joint.line.at(end.along);
  if (in_one_plane(joint)) result.mismatch = height_between(result);
  result.start_visibility = start.visibility;
  result.end_visibility = end.visibility;
  const auto second = [&joint](const SeamEnd& place) {
    return SecondPlace{joint.line.at(place.second), place.second_weight};
  };
  if (start.second_weight > 0) result.start_second = second(start);
  if (end.second_weight > 0) result.end_second = second(end);
  result.accuracy = findings.accuracy;
  if (findings.with_stripes) {
    remark(remark_on(start, SeamSide::kBegin));
    remark(remark_on(end, SeamSide::kEnd));
  }

  result.stations = std::move(findings.stations);
  set_gap(result);
  result.polyline = polyline_through(result.stations, result.start, result.end, kAnswer.straight);
  const double origin = joint.line.along(result.start);
  for (SeamMeasurement& place : result.stations) place.along -= origin;
  result.torch_faces = torch_faces(joint);
  set_torch(settings, result);
  if (result.thickness >= 0) remark({Code::kThickness, result.thickness});
  if (result.groove_angle >= 0) remark({Code::kGroove, result.groove_angle});
  remark(remark_on_gap(result));
  if (joint.parallel && joint.parallel->floor) remark({Code::kFloorNearTop});
  return result;
}

}  // namespace arcstart::seam_finding
