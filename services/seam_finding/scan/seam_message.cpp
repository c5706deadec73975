#include "services/seam_finding/scan/seam_message.hpp"

#include <algorithm>

#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/scan/refusal_code.hpp"

namespace arcstart::seam_finding {
namespace {

void copy(const Eigen::Vector3d& from, double to[3]) { std::copy(from.begin(), from.end(), to); }

void copy(const Eigen::Matrix3d& from, double to[3][3]) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) to[row][column] = from(row, column);
}

std::int8_t visibility_of(EndVisibility visibility) {
  switch (visibility) {
    case EndVisibility::kSeen:
      return seam_t::SEEN;
    case EndVisibility::kHidden:
      return seam_t::HIDDEN;
    case EndVisibility::kOutside:
      return seam_t::OUTSIDE;
    case EndVisibility::kNotDetermined:
      break;
  }
  return seam_t::NOT_DETERMINED;
}

bool contradicted(const SeamResult& result) {
  return std::any_of(result.remarks.begin(), result.remarks.end(), [](const Reason& remark) {
    return remark.code == Reason::Code::kStartContradicted ||
           remark.code == Reason::Code::kEndContradicted;
  });
}

// Of ends that are not known the start is named before the end; before both, that the stripes show
// an end elsewhere.
std::int16_t usable(const SeamResult& result) {
  if (contradicted(result)) return seam_t::CONTRADICTED;
  if (result.start_visibility == EndVisibility::kNotDetermined) return seam_t::START_UNSURE;
  if (result.start_visibility != EndVisibility::kSeen) return seam_t::START_NOT_SEEN;
  if (result.end_visibility == EndVisibility::kNotDetermined) return seam_t::END_UNSURE;
  if (result.end_visibility != EndVisibility::kSeen) return seam_t::END_NOT_SEEN;
  return seam_t::USABLE;
}

template <std::size_t N>
void fill(double (&matrix)[N][N], double value) {
  for (auto& row : matrix) std::fill(std::begin(row), std::end(row), value);
}

}  // namespace

seam_t empty_seam() {
  seam_t seam{};
  for (auto* covariance :
       {&seam.start_covariance, &seam.start_systematic, &seam.end_covariance, &seam.end_systematic})
    fill(*covariance, -1);
  seam.direction_deviation = seam.angle_deviation = seam.gap = seam.gap_deviation =
      seam.polyline_deviation = -1;
  seam.thickness = seam.mismatch = seam.groove_angle = -1;
  seam.stripes_checked = -1;
  seam.explained_share = seam.worst_contradiction = -1;
  std::fill(std::begin(seam.normal_deviations), std::end(seam.normal_deviations), -1);
  seam.torch_quaternion[0] = 1;
  return seam;
}

void fill_in(seam_t& seam, const SeamResult& result) {
  seam.background_points = static_cast<int>(result.background.size());
  for (const auto& other : result.alternatives) {
    seam_alternative_t alternative{};
    alternative.joint_type = other.joint_type;
    alternative.score = other.score;
    copy(other.start, alternative.start);
    copy(other.end, alternative.end);
    alternative.refusal = refusal_code(other.reason);
    alternative.reason = in_words(other.reason);
    seam.alternatives.push_back(alternative);
  }
  seam.alternative_count = static_cast<int>(seam.alternatives.size());
  seam.stripes_checked = result.checked.stripes;
  seam.explained_share = result.checked.explained;
  seam.worst_contradiction = result.checked.worst;
  seam.refusal = refusal_code(result.reason);
  seam.reason = in_words(result.reason);
  if (result.verdict == SeamResult::Verdict::kRefused) seam.verdict = seam_t::REFUSED;
  if (result.verdict == SeamResult::Verdict::kAmbiguous) seam.verdict = seam_t::AMBIGUOUS;
  if (result.verdict != SeamResult::Verdict::kFound) return;
  seam.verdict = seam_t::FOUND;
  seam.remark += in_words(result.remarks);
  seam.joint_type = result.joint_type;
  seam.seam_points = static_cast<int>(result.plates[0].size() + result.plates[1].size());
  copy(result.start, seam.start);
  copy(result.end, seam.end);
  copy(result.direction, seam.direction);
  copy(result.normals[0], seam.normals[0]);
  copy(result.normals[1], seam.normals[1]);
  seam.angle = result.angle;
  seam.gap = result.gap;
  seam.gap_deviation = result.gap_deviation;
  seam.thickness = result.thickness;
  seam.groove_angle = result.groove_angle;
  seam.mismatch = result.mismatch;
  seam.start_visibility = visibility_of(result.start_visibility);
  seam.end_visibility = visibility_of(result.end_visibility);
  seam.usable = usable(result);
  copy(result.start_second.place, seam.start_second);
  copy(result.end_second.place, seam.end_second);
  seam.start_second_weight = result.start_second.weight;
  seam.end_second_weight = result.end_second.weight;
  for (const Eigen::Vector3d& point : result.polyline.points)
    seam.polyline.push_back({point.x(), point.y(), point.z()});
  seam.polyline_count = static_cast<int>(seam.polyline.size());
  seam.polyline_deviation = result.polyline.deviation;
  for (const SeamMeasurement& place : result.stations) {
    seam_station_t station{};
    station.distance = place.along;
    copy(place.position, station.position);
    station.gap = place.gap;
    station.gap_deviation = place.gap_deviation;
    station.residual = place.residual;
    station.tack = place.tack;
    seam.stations.push_back(station);
  }
  seam.station_count = static_cast<int>(seam.stations.size());
  if (result.torch) {
    seam.torch_determined = true;
    copy(result.torch->position, seam.torch_position);
    copy(result.torch->approach, seam.approach_position);
    const Eigen::Quaterniond& q = result.torch->orientation;
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(std::begin(wxyz), std::end(wxyz), seam.torch_quaternion);
  }
  if (result.accuracy) {
    copy(result.accuracy->start, seam.start_covariance);
    copy(result.accuracy->end, seam.end_covariance);
    seam.direction_deviation = result.accuracy->direction;
    seam.angle_deviation = result.accuracy->angle;
    std::copy(result.accuracy->normals.begin(), result.accuracy->normals.end(),
              seam.normal_deviations);
  }
}

}  // namespace arcstart::seam_finding
