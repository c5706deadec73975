#include "services/seam_finding/find_seam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "services/seam_finding/answer/seam_answer.hpp"
#include "services/seam_finding/cloud/scales.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"
#include "services/seam_finding/joints/joint_choice.hpp"
#include "services/seam_finding/planes/plane_search.hpp"
#include "services/seam_finding/planes/planes.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr std::size_t kMostBackground = 2048;  // points; of more so many are looked at
constexpr double kContinues = 0.25;  // share of a face's points that lie in its plane as background

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
                                    PlaneSearch search, const SeamFindingSettings& settings,
                                    std::uint64_t seed) {
  const double theta = settings.angle_deg * kDegree,
               epsilon = settings.angle_tolerance_deg * kDegree;
  search.most_faces = 1;
  auto faces = find_faces(scan, left, search, seed);
  if (faces.empty()) return faces;
  std::vector<int> rest;
  std::set_difference(left.begin(), left.end(), faces[0].points.begin(), faces[0].points.end(),
                      std::back_inserter(rest));
  const Eigen::Vector3d n1 = faces[0].plane.normal;
  search.accept = [&](const Plane& plane) {
    const double angle = std::acos(std::min(1.0, std::abs(n1.dot(plane.normal))));
    return std::min(std::abs(angle - theta), std::abs(M_PI - angle - theta)) < epsilon;
  };
  for (Face& face : find_faces(scan, rest, search, seed)) faces.push_back(std::move(face));
  return faces;
}

SeamResult& refuse(SeamResult& result, std::string reason) {
  result.verdict = SeamResult::Verdict::kRefused;
  result.reason = std::move(reason);
  return result;
}

}  // namespace

SeamResult find_seam(const ScanCloud& scan, const Background& background,
                     const SeamFindingSettings& settings, std::uint64_t seed) {
  Division division;
  divide(scan, background, division);
  ThinnedCloud thinned;
  thin(scan, thinned);
  SeamResult result = find_seam(scan, division, thinned, settings, seed);
  result.background = std::move(division.background);
  return result;
}

SeamResult find_seam(const ScanCloud& scan, const Division& division, const ThinnedCloud& fewer,
                     const SeamFindingSettings& settings, std::uint64_t seed) {
  SeamResult result;
  // The paper's way counts all points.
  const bool is_thinned = settings.plane_rule == "ranked" && fewer.is_less_than(scan);
  const ThinnedCloud none, &thinned = is_thinned ? fewer : none;
  const ScanCloud& some = is_thinned ? thinned.cloud : scan;
  const Sampling sampling = measure_sampling(some);
  if (!(sampling.spacing > 1e-3))
    return refuse(result, "no cloud: the points, or the tool's positions, coincide");
  if (scan.organised() && !search_direction(scan))
    return refuse(result, "the tool did not move in the scan");
  const Scales scales = scales_of(some, sampling, settings.plane_tolerance_mm);
  const Division thinned_division = is_thinned ? division_of(thinned, division) : Division();
  const Division& searched = is_thinned ? thinned_division : division;

  const PlaneSearch plane = plane_search(scales, settings);
  auto faces = settings.plane_rule == "largest"
                   ? two_largest_faces(some, searched.left, plane, settings, seed)
                   : find_faces(some, searched.left, plane, seed);
  if (faces.empty())
    refuse(result,
           fmt::format("no workpiece: no plane among the {} of {} points that are not background",
                       division.left.size(), scan.size()));
  std::erase_if(faces, [&](const Face& face) {
    return continues_background(some, searched.background, face, scales);
  });
  if (!faces.empty()) {
    if (const auto joint =
            choose_seam(result, scan, thinned, searched.left, std::move(faces), scales, settings))
      answer(result, scan, *joint, scales, settings);
  } else if (result.reason.empty()) {
    refuse(result, "no workpiece: what is left only continues the background");
  }
  return result;
}

}  // namespace arcstart::seam_finding
