#include <algorithm>
#include <cmath>

#include "services/seam_finding/background.hpp"

namespace arcstart {
namespace {

constexpr double kLeastCell = 4;       // mm
constexpr double kCellSpacings = 1.5;  // a cell is so many stripe spacings wide
constexpr double kCellSteps = 1.2;     // and so many steps along a stripe
constexpr double kLeastSpread =
    0.6;  // of a window across its stripes, in spacings; two stripes give 0.5, three 0.82
constexpr double kRoughSpacings = 0.75;  // reach of a point where there is no plane
constexpr std::size_t kCrowd = 512;      // points of a cell that are looked at for the nearest one

double cell_size(const Sampling& sampling) {
  return std::max({kLeastCell, kCellSpacings * sampling.spacing, kCellSteps * sampling.step});
}

}  // namespace

SurfaceBackground::SurfaceBackground(const ScanCloud& cloud, double distance_mm)
    : sampling_(measure_sampling(cloud)),
      distance_(std::max(distance_mm, 3.5 * sampling_.noise)),
      grid_(cloud.points, cell_size(sampling_)) {
  std::vector<PlaneSums> sums;
  for (int i = 0; i < grid_.cell_count(); ++i) {
    const auto inside = grid_.points_in(i);
    PlaneSums& cell = sums.emplace_back(cloud.points[inside.front()]);
    for (const int point : inside) cell.add(cloud.points[point]);
  }
  surfaces_.resize(sums.size());
  for (int i = 0; i < grid_.cell_count(); ++i) {
    PlaneSums window = sums[i];
    grid_.for_each_around(grid_.cell(i), [&](int j) {
      if (j != i) window.add(sums[j]);
    });
    Surface& surface = surfaces_[i];
    surface.fit = window.fit();
    surface.is_plane = window.weight() >= 6 && surface.fit.rms <= distance_ / 2 &&
                       surface.fit.spread[0] >= kLeastSpread * sampling_.spacing;
  }
}

bool SurfaceBackground::contains(const Eigen::Vector3d& point) const {
  const NeighbourGrid::Cell middle = grid_.cell_of(point);
  const Surface* nearest = nullptr;
  double least = 0;
  grid_.for_each_around(middle, [&](int i) {
    const double squared = (surfaces_[i].fit.centroid - point).squaredNorm();
    if (nearest == nullptr || squared < least) nearest = &surfaces_[i], least = squared;
  });
  if (nearest == nullptr) return false;
  if (nearest->is_plane) return std::abs(nearest->fit.plane.signed_distance(point)) <= distance_;
  const double reach = std::max(distance_, kRoughSpacings * sampling_.spacing);
  double to_point = 2 * reach * reach;
  grid_.for_each_around(middle, [&](int i) {
    const auto inside = grid_.points_in(i);
    const std::size_t step = 1 + inside.size() / kCrowd;
    for (std::size_t j = 0; j < inside.size(); j += step)
      to_point = std::min(to_point, (grid_.points()[inside[j]] - point).squaredNorm());
  });
  return to_point <= reach * reach;
}

}  // namespace arcstart
