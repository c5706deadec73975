// Planes that are known beforehand, the best of them first.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "services/seam_finding/cloud/connected_components.hpp"
#include "services/seam_finding/cloud/plane_points.hpp"
#include "services/seam_finding/planes/plane_search.hpp"

namespace arcstart::seam_finding {

// A plane is judged by 4096 points at the most: every how manieth of so many that is.
std::size_t jury_step(std::size_t points);

// Each step-th point from place `first` on.
std::vector<Eigen::Vector3d> every(std::size_t step, std::size_t first,
                                   const std::vector<Eigen::Vector3d>& points);

// Judged by an even sample of the points: the plane with the largest connected piece comes first.
// Faces taken away only ever lessen what a plane is worth, so that most need not be judged again.
class PlaneHypotheses {
 public:
  // pieces: of the points, connected within search.connection.
  PlaneHypotheses(std::vector<Plane> planes, const std::vector<Eigen::Vector3d>& points,
                  const Pieces& pieces, const PlaneSearch& search);

  // Nothing where no one is worth a face any more.
  std::optional<Plane> best();
  void remove(const std::vector<int>& places);  // of a face's points, rising

 private:
  void offer(int worth, std::size_t plane);

  const PlaneSearch& search_;
  std::vector<Plane> planes_;
  std::size_t step_;
  std::vector<Eigen::Vector3d> sample_;
  PlanePoints left_;
  Pieces pieces_;
  int least_ = 0;
  std::priority_queue<std::pair<int, int>> worths_;  // bounds from above, and the first of equals
  std::vector<int> on_it_;
};

}  // namespace arcstart::seam_finding
