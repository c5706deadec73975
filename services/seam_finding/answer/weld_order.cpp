#include "services/seam_finding/answer/weld_order.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry.hpp"
#include "services/seam_finding/answer/constants.hpp"
#include "services/seam_finding/answer/torch.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

// Remarks that name an end of the seam. kStartOutside and kEndOutside are not among them: they name
// an end of the scan.
constexpr std::pair<Code, Code> kOfEnds[] = {
    {Code::kMissingBeforeStart, Code::kMissingAfterEnd},
    {Code::kStartHidden, Code::kEndHidden},
    {Code::kStartUncertain, Code::kEndUncertain},
    {Code::kStartBetweenStripes, Code::kEndBetweenStripes},
    {Code::kStartContradicted, Code::kEndContradicted},
    {Code::kStartNotShown, Code::kEndNotShown},
    {Code::kStartLooselyBounded, Code::kEndLooselyBounded},
    {Code::kStartBounded, Code::kEndBounded},
};

Code of_other_end(Code code) {
  for (const auto& [start, end] : kOfEnds) {
    if (code == start) return end;
    if (code == end) return start;
  }
  return code;
}

void refuse(SeamResult& seam, const Reason& reason) {
  SeamResult refused;
  refused.reason = reason;
  refused.alternatives = std::move(seam.alternatives);
  refused.checked = seam.checked;
  refused.background = std::move(seam.background);
  seam = std::move(refused);
}

// Along the covariance's longest axis; mm.
double worst_deviation(const Eigen::Matrix3d& covariance) {
  return std::sqrt(std::max(
      0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly)
               .eigenvalues()
               .maxCoeff()));
}

void limit_deviations(double most, SeamResult& seam) {
  if (most <= 0) return;
  const auto limit = [&](EndVisibility& visibility, const Eigen::Matrix3d& covariance, Code code) {
    const double deviation = worst_deviation(covariance);
    if (deviation <= most) return;
    visibility = EndVisibility::kNotDetermined;
    seam.remarks.push_back({code, deviation, most});
  };
  if (!seam.accuracy) {
    seam.start_visibility = seam.end_visibility = EndVisibility::kNotDetermined;
    seam.remarks.push_back({Code::kStartUncertain});
    return;
  }
  limit(seam.start_visibility, seam.accuracy->start, Code::kStartDeviationLarge);
  limit(seam.end_visibility, seam.accuracy->end, Code::kEndDeviationLarge);
}

}  // namespace

double outside_box(const SeamFindingSettings& settings, const Eigen::Vector3d& place) {
  double outside = 0;
  if (settings.search_box_mm.size() != 6) return outside;
  for (int axis = 0; axis < 3; ++axis)
    outside = std::max({outside, settings.search_box_mm[axis] - place[axis],
                        place[axis] - settings.search_box_mm[axis + 3]});
  return outside;
}

void exchange_ends(const SeamFindingSettings& settings, SeamResult& seam) {
  std::swap(seam.start, seam.end);
  std::swap(seam.start_visibility, seam.end_visibility);
  std::swap(seam.start_second, seam.end_second);
  if (seam.accuracy) std::swap(seam.accuracy->start, seam.accuracy->end);
  seam.direction = -seam.direction;
  for (Reason& remark : seam.remarks) remark.code = of_other_end(remark.code);
  std::reverse(seam.polyline.points.begin(), seam.polyline.points.end());
  std::reverse(seam.stations.begin(), seam.stations.end());
  const double length = (seam.end - seam.start).norm();
  for (SeamMeasurement& place : seam.stations) place.along = length - place.along;
  for (SeamResult::Alternative& other : seam.alternatives) std::swap(other.start, other.end);
  std::erase_if(seam.remarks,
                [](const Reason& remark) { return remark.code == Code::kTorchThroughPlate; });
  set_torch(settings, seam);
}

void set_weld_order(const SeamFindingSettings& settings, SeamResult& seam) {
  if (seam.verdict != SeamResult::Verdict::kFound) return;
  const double outside =
      std::max(outside_box(settings, seam.start), outside_box(settings, seam.end));
  if (outside > 0) return refuse(seam, {Code::kNoJoint, outside, 0, 0, Code::kOutsideBox});
  bool exchange = settings.weld_start == WeldStart::kFar;
  if (settings.search_direction.size() == 3) {
    const double angle =
        angle_between(seam.direction, Eigen::Vector3d(settings.search_direction.data()));
    const double off = std::min(angle, M_PI - angle);
    if (off > kAnswer.across_search) return refuse(seam, {Code::kAcrossSearch, off});
    exchange ^= angle > M_PI / 2;
  }
  if (exchange) exchange_ends(settings, seam);
  limit_deviations(settings.end_deviation_max_mm, seam);
}

}  // namespace arcstart::seam_finding
