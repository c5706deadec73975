#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

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
constexpr float kFarAway = 1e9f;         // mm; fills up what is not there
constexpr double kWithinCell = 1e-6;     // from its borders a cell is told without doubt; mm
constexpr unsigned kRemembered = 128;    // cells

double cell_size(const Sampling& sampling) {
  return std::max({kLeastCell, kCellSpacings * sampling.spacing, kCellSteps * sampling.step});
}

// Which of the places is nearest, the first of equals. Count is rounded up to fours.
int nearest_of(const float* x, const float* y, const float* z, int count,
               const Eigen::Vector3f& to) {
  typedef float Four __attribute__((vector_size(16)));
  const auto four = [](const float* from) {
    Four lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
  };
  std::array<Four, 7> squared;
  Four least = Four{} + std::numeric_limits<float>::max();
  const int fours = (count + 3) / 4;
  for (int i = 0; i < fours; ++i) {
    const Four dx = four(x + 4 * i) - to.x(), dy = four(y + 4 * i) - to.y(),
               dz = four(z + 4 * i) - to.z();
    squared[i] = dx * dx + dy * dy + dz * dz;
    least = squared[i] < least ? squared[i] : least;
  }
  const float smallest = std::min({least[0], least[1], least[2], least[3]});
  for (int i = 0; i < fours; ++i)
    for (int lane = 0; lane < 4; ++lane)
      if (squared[i][lane] == smallest) return 4 * i + lane;
  return 0;
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
    Surface& surface = surfaces_.emplace_back();
    surface.low = surface.high = cloud.points[inside.front()];
    for (const int point : inside) {
      cell.add(cloud.points[point]);
      surface.low = surface.low.cwiseMin(cloud.points[point]);
      surface.high = surface.high.cwiseMax(cloud.points[point]);
    }
  }
  const NeighbourGrid::Adjacency adjacency = grid_.adjacency();
  for (int i = 0; i < grid_.cell_count(); ++i) {
    PlaneSums window = sums[i];
    for (const int j : adjacency.of(i))
      if (j != i) window.add(sums[j]);
    const PlaneSums::Fit fit = window.fit();
    Surface& surface = surfaces_[i];
    surface.centroid = fit.centroid;
    surface.plane = fit.plane;
    surface.is_plane = window.weight() >= 6 && fit.rms <= distance_ / 2 &&
                       fit.spread[0] >= kLeastSpread * sampling_.spacing;
  }
}

void SurfaceBackground::look_around(const NeighbourGrid::Cell& middle, Surroundings& around) const {
  around.middle = middle;
  around.corner = middle.cast<double>() * grid_.cell_size();
  around.count = 0;
  around.x.fill(kFarAway), around.y.fill(kFarAway), around.z.fill(kFarAway);
  grid_.for_each_around(middle, [&](int i) {
    const Eigen::Vector3f centroid = (surfaces_[i].centroid - around.corner).cast<float>();
    around.cells[around.count] = i;
    around.x[around.count] = centroid.x();
    around.y[around.count] = centroid.y();
    around.z[around.count] = centroid.z();
    ++around.count;
  });
  around.apart = apart_in_cell(around);
}

// A linear function is the largest over a cube at one of its corners.
double SurfaceBackground::apart_in_cell(Surroundings& around) const {
  if (around.count == 0) return INFINITY;
  around.common = surfaces_[around.cells[0]].plane;
  const double half = grid_.cell_size() / 2;
  const Eigen::Vector3d centre = around.corner + Eigen::Vector3d::Constant(half);
  const double height = around.common.signed_distance(centre);
  double apart = 0;
  for (int i = 0; i < around.count; ++i) {
    const Surface& surface = surfaces_[around.cells[i]];
    if (!surface.is_plane) return INFINITY;
    const Plane plane = surface.plane.normal.dot(around.common.normal) < 0 ? surface.plane.flipped()
                                                                           : surface.plane;
    const double tilt = (plane.normal - around.common.normal).lpNorm<1>();
    apart = std::max(apart, std::abs(plane.signed_distance(centre) - height) + half * tilt);
  }
  return apart;
}

bool SurfaceBackground::contains(const Eigen::Vector3d& point, const Surroundings& around) const {
  if (around.count == 0) return false;
  // Whichever surface is the nearest: the answer is plain but for a narrow range of distances.
  const double about = std::abs(around.common.signed_distance(point));
  if (about + around.apart < distance_) return true;
  if (about - around.apart > distance_) return false;
  return nearest_contains(point, around);
}

bool SurfaceBackground::nearest_contains(const Eigen::Vector3d& point,
                                         const Surroundings& around) const {
  const Surface& nearest =
      surfaces_[around.cells[nearest_of(around.x.data(), around.y.data(), around.z.data(),
                                        around.count, (point - around.corner).cast<float>())]];
  if (nearest.is_plane) return std::abs(nearest.plane.signed_distance(point)) <= distance_;
  const double reach = std::max(distance_, kRoughSpacings * sampling_.spacing);
  for (int i = 0; i < around.count; ++i) {
    const Surface& surface = surfaces_[around.cells[i]];
    const Eigen::Vector3d to_box =
        (surface.low - point).cwiseMax(point - surface.high).cwiseMax(0.0);
    if (to_box.squaredNorm() > reach * reach) continue;
    const auto inside = grid_.points_in(around.cells[i]);
    const std::size_t step = 1 + inside.size() / kCrowd;
    for (std::size_t j = 0; j < inside.size(); j += step)
      if ((grid_.points()[inside[j]] - point).squaredNorm() <= reach * reach) return true;
  }
  return false;
}

bool SurfaceBackground::contains(const Eigen::Vector3d& point) const {
  Surroundings surroundings;
  look_around(grid_.cell_of(point), surroundings);
  return contains(point, surroundings);
}

// A stripe runs through one cell for many points, or to and fro between two.
void SurfaceBackground::classify(std::span<const Eigen::Vector3d> points,
                                 std::vector<char>& inside) const {
  std::vector<Surroundings> remembered(kRemembered);
  for (Surroundings& one : remembered) one.middle.setConstant(std::numeric_limits<int>::min());
  const double from = kWithinCell, to = grid_.cell_size() - kWithinCell;
  const Surroundings* around = nullptr;
  for (const Eigen::Vector3d& point : points) {
    if (around != nullptr) {
      const Eigen::Array3d place = point - around->corner;
      if (!(place.minCoeff() > from && place.maxCoeff() < to)) around = nullptr;
    }
    if (around == nullptr) {
      const NeighbourGrid::Cell middle = grid_.cell_of(point);
      const auto place = static_cast<unsigned>(middle.x() + 37 * middle.y() + 101 * middle.z());
      Surroundings& found = remembered[place % kRemembered];
      if (found.middle != middle) look_around(middle, found);
      around = &found;
    }
    inside.push_back(contains(point, *around));
  }
}

}  // namespace arcstart
