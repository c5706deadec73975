#include "services/seam_finding/background/surface_background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "services/seam_finding/background/constants.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"

namespace arcstart::seam_finding {
namespace {

double cell_size(const Sampling& sampling) {
  return std::max({kBackground.least_cell, kBackground.cell_spacings * sampling.spacing,
                   kBackground.cell_steps * sampling.step});
}

}  // namespace

SurfaceBackground::SurfaceBackground(const ScanCloud& cloud, double distance_mm)
    : sampling_(measure_sampling(cloud)),
      distance_(std::max(distance_mm, 3.5 * sampling_.noise)),
      grid_(cloud.points, cell_size(sampling_)),
      adjacency_(grid_.adjacency()) {
  std::vector<PlaneSums> sums;
  for (int i = 0; i < grid_.cell_count(); ++i) {
    const auto inside = grid_.points_in(i);
    PlaneSums& cell = sums.emplace_back(cloud.points[inside.front()]);
    Surface& surface = surfaces_.emplace_back();
    surface.low = surface.high = cloud.points[inside.front()];
    for (const int point : inside) {
      cell.add(cloud.points[point]);
      surface.low = surface.low.cwiseMin(cloud.points[point]);
      surface.high = surface.high.cwiseMax(cloud.points[point]);
    }
  }
  for (int i = 0; i < grid_.cell_count(); ++i) {
    PlaneSums window = sums[i];
    for (const int j : adjacency_.of(i))
      if (j != i) window.add(sums[j]);
    const PlaneSums::Fit fit = window.fit();
    Surface& surface = surfaces_[i];
    surface.centroid = fit.centroid;
    surface.plane = fit.plane;
    surface.is_plane = window.weight() >= 6 && fit.rms <= distance_ / 2 &&
                       fit.spread[0] >= kBackground.least_spread * sampling_.spacing;
  }
  surroundings_.reserve(surfaces_.size());
  for (int i = 0; i < grid_.cell_count(); ++i)
    surroundings_.push_back(look_around(grid_.cell(i), adjacency_.of(i)));
}

// A linear function is the largest over a cube at one of its corners.
SurfaceBackground::Surroundings SurfaceBackground::look_around(const NeighbourGrid::Cell& middle,
                                                               std::span<const int> cells) const {
  Surroundings around{cells, {}, 0};
  if (cells.empty()) return around;
  around.common = surfaces_[cells.front()].plane;
  const double half = grid_.cell_size() / 2;
  const Eigen::Vector3d centre =
      middle.cast<double>() * grid_.cell_size() + Eigen::Vector3d::Constant(half);
  const double height = around.common.signed_distance(centre);
  for (const int i : cells) {
    const Surface& surface = surfaces_[i];
    const Plane plane = surface.plane.normal.dot(around.common.normal) < 0 ? surface.plane.flipped()
                                                                           : surface.plane;
    const double tilt = (plane.normal - around.common.normal).lpNorm<1>();
    const double apart = std::abs(plane.signed_distance(centre) - height) + half * tilt;
    around.apart = surface.is_plane ? std::max(around.apart, apart) : INFINITY;
  }
  return around;
}

Belonging SurfaceBackground::by_nearest(const Eigen::Vector3d& point,
                                        std::span<const int> cells) const {
  int nearest = cells.front();
  double least = INFINITY;
  for (const int i : cells)
    if (const double squared = (surfaces_[i].centroid - point).squaredNorm(); squared < least)
      nearest = i, least = squared;
  const Surface& surface = surfaces_[nearest];
  if (surface.is_plane)
    return std::abs(surface.plane.signed_distance(point)) <= distance_ ? Belonging::kBackground
                                                                       : Belonging::kOff;
  const double reach = std::max(distance_, kBackground.rough_spacings * sampling_.spacing);
  const auto reaches = [&](int i) {
    const Eigen::Vector3d to_box =
        (surfaces_[i].low - point).cwiseMax(point - surfaces_[i].high).cwiseMax(0.0);
    if (to_box.squaredNorm() > reach * reach) return false;
    const auto inside = grid_.points_in(i);
    const std::size_t step = 1 + inside.size() / kBackground.nearest_crowd;
    for (std::size_t j = 0; j < inside.size(); j += step)
      if ((grid_.points()[inside[j]] - point).squaredNorm() <= reach * reach) return true;
    return false;
  };
  return reaches(nearest) || std::any_of(cells.begin(), cells.end(), reaches)
             ? Belonging::kBackground
             : Belonging::kUnknown;
}

bool SurfaceBackground::contains(const Eigen::Vector3d& point) const {
  std::vector<Belonging> belonging;
  classify({&point, 1}, belonging);
  return belonging.front() == Belonging::kBackground;
}

// A stripe runs through one cell for many points, or to and fro between two along their border.
// Whichever surface is the nearest there: the answer is plain but for a narrow range of distances
// from the common one.
void SurfaceBackground::classify(std::span<const Eigen::Vector3d> points,
                                 std::vector<Belonging>& belonging) const {
  const double half = grid_.cell_size() / 2;
  struct Place {
    Eigen::Vector3d centre = Eigen::Vector3d::Constant(INFINITY);  // of no cell yet
    Surroundings around;
    std::vector<int> cells;
  };
  std::array<Place, 2> places;
  Place *here = &places[0], *before = &places[1];
  const auto is_here = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d off = (point - here->centre).cwiseAbs();
    return std::max(std::max(off.x(), off.y()), off.z()) < half - kBackground.within_cell;
  };
  const auto go_to = [&](const Eigen::Vector3d& point) {
    const NeighbourGrid::Cell cell = grid_.cell_of(point);
    here->centre = cell.cast<double>() * grid_.cell_size() + Eigen::Vector3d::Constant(half);
    if (const int index = grid_.index_of(cell); index >= 0) {
      here->around = surroundings_[static_cast<std::size_t>(index)];
      return;
    }
    here->cells.clear();
    grid_.for_each_around(cell, [&](int i) { here->cells.push_back(i); });
    here->around = look_around(cell, here->cells);
  };
  const std::size_t first = belonging.size();
  belonging.resize(first + points.size(), Belonging::kUnknown);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_here(points[i])) {
      std::swap(here, before);
      if (!is_here(points[i])) go_to(points[i]);
    }
    const Surroundings& around = here->around;
    if (around.cells.empty()) continue;
    const double about = std::abs(around.common.signed_distance(points[i]));
    belonging[first + i] = about + around.apart < distance_   ? Belonging::kBackground
                           : about - around.apart > distance_ ? Belonging::kOff
                                                              : by_nearest(points[i], around.cells);
  }
}

}  // namespace arcstart::seam_finding
