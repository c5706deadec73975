// Two plates side by side as stripes show them, drawn point by point: where an edge lies is what
// was drawn.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {

constexpr int drawn_stripes = 15;
constexpr double drawn_reach = 30;  // mm; of a plate from the seam

struct DrawnPlates {
  using Piece = std::vector<Eigen::Vector2d>;  // across the search, out of the metal; mm

  double pitch = 3, step = 0.5;         // of stripes, and of points in a stripe; mm
  double turn = 0;                      // of the plates' edges: mm across for each mm along
  Eigen::Vector3d camera{0, 0, 300};    // mm; the same for all stripes
  std::array<double, 2> heights{0, 0};  // of the plates' tops; mm

  ScanCloud cloud;
  std::vector<int> face_of;
  std::vector<Face> faces;
  PlateFrame frame{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                   Eigen::Vector3d::UnitZ()};
  std::vector<Section> sections;

  // A straight run between two places, both included.
  Piece run(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    Piece piece;
    const int count = std::max(1, static_cast<int>(std::lround((to - from).norm() / step)));
    for (int i = 0; i <= count; ++i)
      piece.push_back(from + (to - from) * (static_cast<double>(i) / count));
    return piece;
  }

  // A stripe square to the search; each piece is a segment of it. What lies on a top, to a
  // hundredth, and on its side of the seam is that plate's.
  void draw_stripe(const std::vector<Piece>& pieces) {
    const int stripe = static_cast<int>(cloud.stripes.size());
    const double along = pitch * stripe;
    faces.resize(2);
    Section section;
    for (std::size_t s = 0; s < pieces.size(); ++s)
      for (std::size_t i = 0; i < pieces[s].size(); ++i) {
        const Eigen::Vector2d& at = pieces[s][i];
        const int plate = at.x() > 0;
        const bool on = std::abs(at.y() - heights[plate]) < 0.01;
        if (on) faces[plate].points.push_back(cloud.size());
        section.push_back(cloud.size());
        face_of.push_back(on ? plate : -1);
        cloud.points.emplace_back(along, at.x() + turn * along, at.y());
        cloud.origins.push_back(
            {stripe, static_cast<int>(s), i == 0 || i + 1 == pieces[s].size(), 0, 0});
      }
    for (int plate = 0; plate < 2; ++plate)
      faces[plate].plane = {Eigen::Vector3d::UnitZ(), -heights[plate]};
    sections.push_back(section);
    end_stripe(cloud, ScanStripe::Seen::kSeen, camera, {along, 0, 300});
  }

  void draw_stripes(int count, const std::vector<Piece>& pieces) {
    for (int k = 0; k < count; ++k) draw_stripe(pieces);
  }

  std::array<Plane, 2> planes() const { return {faces[0].plane, faces[1].plane}; }
  // mm; how far a point of a plate may lie from its plane.
  static constexpr double near = 0.15;
  std::vector<Transition> transitions() const {
    return transitions_between(cloud, sections, face_of, faces, 0, 1, near);
  }
};

inline DrawnPlates::Piece joined(DrawnPlates::Piece first, const DrawnPlates::Piece& second) {
  // Where one run begins at the end of the other, that place is one point.
  first.insert(first.end(), second.begin() + (first.back() == second.front()), second.end());
  return first;
}

}  // namespace arcstart::seam_finding
