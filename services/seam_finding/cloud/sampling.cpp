#include "services/seam_finding/cloud/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/cloud/constants.hpp"
#include "services/seam_finding/cloud/neighbour_grid.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"

namespace arcstart::seam_finding {
namespace {

// The median way between neighbouring stripes, where the tool moves: it may stand still at the
// scan's begin and end.
double stripe_spacing(const ScanCloud& cloud) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < cloud.stripes.size(); ++i) {
    const ScanStripe &a = cloud.stripes[i - 1], &b = cloud.stripes[i];
    if (a.seen == ScanStripe::Seen::kSeen && b.seen == ScanStripe::Seen::kSeen)
      steps.push_back((b.tool_position - a.tool_position).norm());
  }
  const double fast = quantile(steps, 0.9);
  std::erase_if(steps, [&](double step) { return step < 0.3 * fast; });
  return quantile(steps, 0.5);
}

// Between neighbours along a stripe, evenly taken where there are many.
std::vector<double> stripe_steps(const ScanCloud& cloud) {
  std::vector<double> steps;
  const int every = 1 + cloud.size() / kCloud.small_sample;
  for (int i = 1; i < cloud.size(); i += every)
    if (cloud.origins[i].stripe == cloud.origins[i - 1].stripe &&
        cloud.origins[i].segment == cloud.origins[i - 1].segment)
      steps.push_back((cloud.points[i] - cloud.points[i - 1]).norm());
  return steps;
}

// Median distance to the eighth neighbour over that of a square grid of spacing 1.
double point_spacing(const ScanCloud& cloud) {
  Eigen::Vector3d low = cloud.points.front(), high = low;
  for (const auto& point : cloud.points) low = low.cwiseMin(point), high = high.cwiseMax(point);
  // Points of a cloud lie on surfaces: so many fill its box about so densely.
  double cell = 4 * (high - low).norm() / std::sqrt(static_cast<double>(cloud.size()));
  std::vector<double> found, distances;
  for (int attempt = 0; attempt < 4 && cell > 1e-6; ++attempt, cell *= 2) {
    const NeighbourGrid grid(cloud.points, cell);
    found.clear();
    const int step = std::max(1, cloud.size() / kCloud.spacing_places);
    for (int i = 0; i < cloud.size(); i += step) {
      grid.nearest_distances(i, kCloud.neighbours, distances);
      if (distances.size() == kCloud.neighbours) found.push_back(distances.back());
    }
    if (2 * found.size() * static_cast<std::size_t>(step) > cloud.points.size()) break;
  }
  return quantile(found, 0.5) / std::sqrt(2.0);
}

// The typical distance of points from the plane through their neighbourhood. Edges and corners
// raise it in places, so the lower third speaks for the flat ones.
double surface_noise(const ScanCloud& cloud, double radius) {
  if (!(radius > 0)) return 0;
  std::vector<Eigen::Vector3d> points;
  const int enough = cloud.organised() ? kCloud.noise_points : kCloud.loose_noise_points;
  const int every = cloud.size() <= 2 * enough ? 1 : cloud.size() / enough;
  points.reserve(static_cast<std::size_t>(cloud.size() / every + 1));
  for (int i = 0; i < cloud.size(); i += every) points.push_back(cloud.points[i]);
  const NeighbourGrid grid(points, radius);
  std::vector<double> found;
  for (std::size_t i = 0; i < points.size();
       i += std::max<std::size_t>(1, points.size() / kCloud.noise_places)) {
    const Eigen::Vector3d& centre = points[i];
    PlaneSums sums(centre);
    grid.for_each_around(grid.cell_of(centre), [&](int cell) {
      const auto inside = grid.points_in(cell);
      const std::size_t stride = 1 + inside.size() / kCloud.noise_crowd;
      for (std::size_t j = 0; j < inside.size(); j += stride)
        if ((points[inside[j]] - centre).squaredNorm() < radius * radius)
          sums.add(points[inside[j]]);
    });
    if (sums.weight() < 8) continue;
    const auto fit = sums.fit();
    if (fit.spread[0] > 0.2 * radius)
      found.push_back(fit.rms * std::sqrt(sums.weight() / (sums.weight() - 3)));
  }
  return quantile(found, 0.35);
}

// The typical distance of points from the chord between others in their stripe, as far away as
// their errors do not depend on each other; what stands about in the scene bends few of them.
// pitch: of the points in a stripe; mm.
double stripe_noise(const ScanCloud& cloud, double pitch) {
  std::vector<double> found;
  const int every = 1 + cloud.size() / kCloud.noise_points;
  const int beside = std::max(1, static_cast<int>(std::lround(kCloud.chord / pitch)));
  for (int i = beside; i + beside < cloud.size(); i += every) {
    const PointOrigin &before = cloud.origins[i - beside], &after = cloud.origins[i + beside];
    if (before.stripe != after.stripe || before.segment != after.segment) continue;
    const Eigen::Vector3d& from = cloud.points[i - beside];
    const Eigen::Vector3d chord = cloud.points[i + beside] - from;
    if (const double length = chord.norm(); length > 0)
      found.push_back(chord.cross(cloud.points[i] - from).norm() / length);
  }
  // The point itself varies, and the middle of its neighbours by half as much.
  return kFit.median_to_deviation * quantile(found, 0.5) / std::sqrt(1.5);
}

}  // namespace

Sampling measure_sampling(const ScanCloud& cloud) {
  Sampling sampling;
  if (cloud.points.size() < 16) return sampling;
  sampling.spacing = cloud.organised() ? stripe_spacing(cloud) : point_spacing(cloud);
  if (cloud.organised()) {
    std::vector<double> steps = stripe_steps(cloud);
    sampling.step = quantile(steps, 0.9);
    sampling.pitch = quantile(steps, 0.5);
  }
  sampling.noise = surface_noise(cloud, 3 * sampling.spacing);
  // Between stripes points scatter more, but not as much as where hardly a neighbourhood is flat.
  if (cloud.organised() && sampling.pitch > 0)
    sampling.noise =
        std::min(sampling.noise, kCloud.between_stripes * stripe_noise(cloud, sampling.pitch));
  return sampling;
}

}  // namespace arcstart::seam_finding
