#include "services/seam_finding/flat_borders.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart {
namespace {

constexpr double kSquareCut = 0.1;  // standard deviation of a lap's cut, mm across for each mm up
constexpr double kFreeCut = 3;      // of a cut of which nothing is known
constexpr double kJumpDeviation = 0.3;  // of a segment's last centre from the edge it leaves; mm
constexpr double kCutDeviation = 0.1;   // of a point on a cut across; mm
constexpr double kLeastDepth = 1.5;     // of a cut by which its slant is known; mm
constexpr std::size_t kLeastCut = 6;    // points on a cut

int neighbour(const Passage& passage, int plate) {
  return plate == 0 ? passage.last : passage.first;
}

// The points that follow on a plate's last one in the same segment, outward, as long as they fall.
std::vector<int> falling(const ScanCloud& cloud, const Passage& passage, const Plane& plane,
                         int plate) {
  std::vector<int> run;
  int before = neighbour(passage, plate);
  double height = plane.signed_distance(cloud.points[before]);
  const auto take = [&](int i) {
    const double h = plane.signed_distance(cloud.points[i]);
    if (cloud.organised() && cloud.origins[i].segment != cloud.origins[before].segment)
      return false;
    if (h > height) return false;
    run.push_back(i), before = i, height = h;
    return true;
  };
  if (plate == 0) {
    for (auto i = passage.between.begin(); i != passage.between.end() && take(*i); ++i) {
    }
  } else {
    for (auto i = passage.between.rbegin(); i != passage.between.rend() && take(*i); ++i) {
    }
  }
  return run;
}

// Where the plate ends by its last point alone: at a segment's end, or before what follows on it.
BorderPlace end_place(const ScanCloud& cloud, const Passage& passage, const PlateFrame& frame,
                      int plate, int next, double pitch_mm) {
  const int own = neighbour(passage, plate);
  const Eigen::Vector3d p = frame.of(cloud.points[own]);
  const double outward = plate == 0 ? 1 : -1;
  BorderPlace place{p.x(), p.y(), 0, kJumpDeviation};
  if (cloud.origins[own].segment_end) return place;
  double step = pitch_mm;
  if (next >= 0) step = std::abs(frame.of(cloud.points[next]).y() - p.y());
  place.across += outward * step / 2;
  place.deviation = std::max(kCutDeviation, step / std::sqrt(12.0));
  return place;
}

}  // namespace

FlatBorders borders_of(const ScanCloud& cloud, const std::vector<Passage>& passages,
                       const PlateFrame& frame, const std::array<Plane, 2>& planes, double near_mm,
                       double pitch_mm) {
  FlatBorders borders;
  for (int plate = 0; plate < 2; ++plate) {
    std::vector<BorderPlace> ends, cut;
    double deepest = 0;
    for (const Passage& passage : passages) {
      const auto run = falling(cloud, passage, planes[plate], plate);
      ends.push_back(
          end_place(cloud, passage, frame, plate, run.empty() ? -1 : run.front(), pitch_mm));
      for (const int i : run) {
        const double height = planes[plate].signed_distance(cloud.points[i]);
        if (height > -2 * near_mm) continue;
        const Eigen::Vector3d p = frame.of(cloud.points[i]);
        cut.push_back({p.x(), p.y(), height, kCutDeviation});
        deepest = std::min(deepest, height);
      }
    }
    if (cut.size() >= kLeastCut && -deepest > kLeastDepth) {
      if (const auto fit = fit_border(cut, kFreeCut)) {
        borders.plates[plate] = fit;
        // Falling away from plate 0 is toward larger across.
        borders.slants[plate] = std::atan((plate == 0 ? -1 : 1) * fit->lean);
        continue;
      }
    }
    borders.plates[plate] = fit_border(ends, kSquareCut);
  }
  return borders;
}

std::optional<LapFoot> lap_foot(const ScanCloud& cloud, const std::vector<Passage>& passages,
                                const PlateFrame& frame, const std::array<Plane, 2>& planes,
                                int upper, double step_mm, double near_mm, double pitch_mm) {
  std::vector<BorderPlace> cut, ends;
  const Plane& lower = planes[1 - upper];
  for (const Passage& passage : passages) {
    for (const int i : passage.between) {
      const double height = lower.signed_distance(cloud.points[i]);
      if (height < 2 * near_mm || height > step_mm - 2 * near_mm || cloud.origins[i].segment_end)
        continue;
      const Eigen::Vector3d p = frame.of(cloud.points[i]);
      cut.push_back({p.x(), p.y(), height, kCutDeviation});
    }
    // What follows on the upper plate's last point belongs to its cut or, in a thin plate's scan,
    // to the lower plate.
    const int own = neighbour(passage, upper);
    const int next = !passage.between.empty()
                         ? (upper == 0 ? passage.between.front() : passage.between.back())
                         : neighbour(passage, 1 - upper);
    const bool joined =
        cloud.organised() && cloud.origins[next].segment == cloud.origins[own].segment;
    ends.push_back(end_place(cloud, passage, frame, upper, joined ? next : -1, pitch_mm));
  }
  if (cut.size() >= kLeastCut)
    if (const auto fit = fit_border(cut, kSquareCut)) return LapFoot{*fit, true};
  if (const auto fit = fit_border(ends, kSquareCut)) return LapFoot{*fit, false};
  return std::nullopt;
}

}  // namespace arcstart
