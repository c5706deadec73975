#include "tests/seam_finding/support/wild_sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace arcstart::seam_finding::synthetic {
namespace {

using cell_simulator::WildEnd, cell_simulator::WildSeam;
using Eigen::Vector3d;

constexpr double least_shown_mm = 1.5;  // of a plate within reach, for it to count as seen
constexpr double edge_mm = 0.05;        // how near to the edge a line on the plate ends
constexpr double edge_reach_mm = 40;    // how far from the seam such a place tells of its end
constexpr double along_edge = 0.05;     // sine of the least angle at which a line crosses the edge
constexpr double same_way = 0.9;        // cosine between a triangle's and the plate's normal
constexpr double window_spacings = 4;   // of stripes inside the seam that show its end

bool on_face(const WildPiece& piece, const WildSeam& seam, int plate) {
  return !piece.ghost && piece.object == seam.objects[plate] &&
         piece.normal.dot(seam.normals[plate]) > same_way;
}

}  // namespace

WildSightings::WildSightings(const WildSeam& seam, double spacing)
    : seam_(seam),
      length_((seam.end.point - seam.start.point).norm()),
      spacing_(spacing / std::max(0.2, std::abs(seam.direction.x()))) {}

bool WildSightings::shows_both(const std::vector<WildPiece>& pieces) const {
  const Line line{seam_.start.point, seam_.direction};
  std::array<double, 2> shown{};
  for (const WildPiece& piece : pieces)
    for (int plate = 0; plate < 2; ++plate) {
      if (!on_face(piece, seam_, plate)) continue;
      // Its length within reach, between the ends of the seam, by small steps.
      constexpr int steps = 16;
      const double step = (piece.end - piece.begin).norm() / steps;
      for (int i = 0; i < steps; ++i) {
        const Vector3d p = piece.begin + (i + 0.5) / steps * (piece.end - piece.begin);
        if (line.distance(p) < seam_.reach_mm + seam_.bow_mm) shown[plate] += step;
      }
    }
  return std::min(shown[0], shown[1]) > least_shown_mm;
}

bool WildSightings::leaves_over(const std::vector<WildPiece>& pieces, const WildEnd& end) const {
  for (const WildPiece& piece : pieces)
    for (int plate = 0; plate < 2; ++plate) {
      if (end.plate != 2 && end.plate != plate) continue;
      if (!on_face(piece, seam_, plate)) continue;
      const Line edge{end.edge_points[plate], end.edge_directions[plate]};
      for (const Vector3d* p : {&piece.begin, &piece.end})
        if (edge.distance(*p) < edge_mm + end.edge_play_mm[plate] &&
            std::abs(edge.along(*p)) < edge_reach_mm &&
            (piece.end - piece.begin).normalized().cross(edge.direction).norm() > along_edge)
          return true;
    }
  return false;
}

void WildSightings::add(const std::vector<WildPiece>& pieces, const Plane& sheet) {
  const double rise = sheet.normal.dot(seam_.direction);
  if (std::abs(rise) < 1e-6) return;
  const double at = -sheet.signed_distance(seam_.start.point) / rise;
  stripes_.push_back(at);
  if (shows_both(pieces)) showing_.push_back(at);
  start_crossings_ += leaves_over(pieces, seam_.start);
  end_crossings_ += leaves_over(pieces, seam_.end);
}

WildSeamSight WildSightings::sight() const {
  WildSeamSight result;
  const auto within = [](const std::vector<double>& places, double low, double high) {
    return static_cast<int>(std::count_if(places.begin(), places.end(),
                                          [&](double at) { return at >= low && at <= high; }));
  };
  const double window = window_spacings * spacing_, far = 1e9;
  result.start.stripes = within(showing_, 0, window);
  result.end.stripes = within(showing_, length_ - window, length_);
  result.start.in_scan = within(stripes_, -far, 0) > 0 && within(stripes_, 0, far) > 0;
  result.end.in_scan = within(stripes_, -far, length_) > 0 && within(stripes_, length_, far) > 0;
  result.start.crossings = start_crossings_;
  result.end.crossings = end_crossings_;
  for (WildSight* sight : {&result.start, &result.end}) sight->in_view = sight->stripes >= 3;
  return result;
}

}  // namespace arcstart::seam_finding::synthetic
