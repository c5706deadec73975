// The background as a surface: a plane in every cell of space.
#pragma once

#include <span>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/cloud/neighbour_grid.hpp"
#include "services/seam_finding/cloud/sampling.hpp"

namespace arcstart::seam_finding {

// Near the background's local surface. In every cell of a grid a plane is laid through what lies in
// it and around it, a window of three cells or about four stripes, so that neither the stripes'
// distance nor their phase matters, however dense the points along them are: the nearest dozen of
// points may all lie on one stripe, and a line has no plane. Where the window is no plane (a step,
// a corner, a lone stripe) the distance to the nearest point decides. A point farther than two
// cells from all that the background scan saw is not background: nothing is known there.
class SurfaceBackground : public Background {
 public:
  // The cloud must outlive it. distance: from the surface, mm; raised to 3.5 times the background's
  // own noise.
  SurfaceBackground(const ScanCloud& cloud, double distance_mm);
  SurfaceBackground(const SurfaceBackground&) = delete;  // its parts refer to each other
  bool contains(const Eigen::Vector3d& point) const override;
  void classify(std::span<const Eigen::Vector3d> points,
                std::vector<Belonging>& belonging) const override;

 private:
  struct Surface {
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    Plane plane;
    bool is_plane = false;
    Eigen::Vector3d low, high;  // of the cell's points
  };
  // Of a cell of space. Where all surfaces in and around it are planes, in the cell none is farther
  // from the common one than `apart`.
  struct Surroundings {
    std::span<const int> cells;  // in and around it, that have a surface
    Plane common;
    double apart = 0;  // mm; infinite where not all are planes
  };
  Surroundings look_around(const NeighbourGrid::Cell& middle, std::span<const int> cells) const;
  Belonging by_nearest(const Eigen::Vector3d& point, std::span<const int> cells) const;

  Sampling sampling_;
  double distance_;
  NeighbourGrid grid_;
  NeighbourGrid::Adjacency adjacency_;
  std::vector<Surface> surfaces_;           // one a cell of the grid
  std::vector<Surroundings> surroundings_;  // of each
};

}  // namespace arcstart::seam_finding
