#include "services/seam_finding/joints/edges/lap_root.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/edges/plate_end_place.hpp"

namespace arcstart::seam_finding {
namespace {

// The points of a stripe on a cut lie above each other, but for its lean and the noise.
bool is_steep(const std::vector<LinePlace>& cut, double near_mm) {
  const auto [left, right] = std::minmax_element(
      cut.begin(), cut.end(),
      [](const LinePlace& a, const LinePlace& b) { return a.across < b.across; });
  const auto [low, high] = std::minmax_element(
      cut.begin(), cut.end(),
      [](const LinePlace& a, const LinePlace& b) { return a.height < b.height; });
  const double noise = std::hypot(kJoints.cut_deviation, near_mm / kFit.on_plane);
  return right->across - left->across <
         kFit.outlier *
             (kJoints.square_cut * (high->height - low->height) + std::sqrt(2.0) * noise);
}

}  // namespace

std::optional<LapRoot> lap_root(const ScanCloud& cloud, const std::vector<Transition>& transitions,
                                const PlateFrame& frame, const std::array<Plane, 2>& planes,
                                int upper, double step_mm, double near_mm, double pitch_mm) {
  std::vector<LinePlace> places;
  std::size_t on_cut = 0;
  const Plane& lower = planes[1 - upper];
  const double outward = upper == 0 ? 1 : -1;  // of the cut, across
  const auto faces_away = [&](int i) {
    return outward * frame.across.dot(cloud.seen_from(i) - cloud.points[i]) < 0;
  };
  const bool away = 2 * std::count_if(transitions.begin(), transitions.end(),
                                      [&](const auto& t) { return faces_away(t.last); }) >
                    std::ssize(transitions);
  for (const Transition& transition : transitions) {
    std::vector<LinePlace> cut;
    for (const int i : transition.between) {
      const double height = lower.signed_distance(cloud.points[i]);
      // A cut that faces away from the camera is not seen: what lies between is the step's
      // rounding.
      if (faces_away(i)) continue;
      if (height < kJoints.off_plate * near_mm || height > step_mm - kJoints.off_plate * near_mm ||
          cloud.origins[i].segment_end)
        continue;
      const Eigen::Vector3d p = frame.of(cloud.points[i]);
      cut.push_back({p.x(), p.y(), height, kJoints.cut_deviation});
    }
    if (!cut.empty()) {
      // A fillet's bead slants, and hides the edge.
      if (!is_steep(cut, near_mm)) continue;
      places.insert(places.end(), cut.begin(), cut.end()), on_cut += cut.size();
      continue;
    }
    // What follows on the upper plate's last point belongs to its cut or, in a thin plate's scan,
    // to the lower plate.
    places.push_back(
        end_place(cloud, transition, frame, upper, follower(cloud, transition, upper), pitch_mm));
    places.back().height = step_mm;
  }
  const auto fit = fit_line(places, kJoints.square_cut);
  if (!fit) return std::nullopt;
  return LapRoot{*fit, on_cut >= kJoints.cut_points, away};
}

}  // namespace arcstart::seam_finding
