#include "services/seam_finding/cloud/outliers.hpp"

#include <cmath>
#include <numeric>

#include "services/seam_finding/cloud/constants.hpp"
#include "services/seam_finding/cloud/neighbour_grid.hpp"

namespace arcstart::seam_finding {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A bound from above on a point's mean distance to its nearest neighbours: to as many that stand
// about it in the list, which follows the stripes. They must lie within `reach`, where all
// neighbours are sought. Infinite for none.
double bound_of(const std::vector<Eigen::Vector3d>& points, std::size_t i, std::size_t neighbours,
                double reach) {
  const std::size_t before = neighbours / 2, after = neighbours - before;
  if (i < before || i + after >= points.size()) return INFINITY;
  double sum = 0;
  for (std::size_t j = i - before; j <= i + after; ++j) {
    const double squared = (points[j] - points[i]).squaredNorm();
    if (squared > reach * reach) return INFINITY;
    sum += std::sqrt(squared);
  }
  return sum / static_cast<double>(neighbours);
}

}  // namespace

std::vector<int> without_outliers(const ScanCloud& cloud, const std::vector<int>& points,
                                  int neighbours, double deviations, double spacing) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.size());
  for (const int i : points) positions.push_back(cloud.points[i]);
  const bool many = points.size() > kCloud.sample;
  const NeighbourGrid grid(positions, std::max(1e-3, (many ? 1.0 : 1.5) * spacing));
  const NeighbourGrid::Adjacency adjacency = grid.adjacency();
  const std::vector<int> cells = grid.cells_of_points();
  std::vector<double> distances;
  const auto ask = [&](std::size_t i) {
    grid.nearest_distances(static_cast<int>(i), neighbours, adjacency.of(cells[i]), distances);
  };
  const std::size_t step = many ? points.size() / kCloud.outlier_sample : 1;
  std::vector<double> means;  // where all are asked
  double sum = 0, squares = 0;
  int counted = 0;
  for (std::size_t i = 0; i < points.size(); i += step) {
    ask(i);
    const double mean = distances.empty() ? INFINITY : mean_of(distances);
    if (!many) means.push_back(mean);
    if (distances.empty()) continue;
    sum += mean, squares += mean * mean, ++counted;
  }
  if (counted < 2) return points;
  const double usual = sum / counted;
  const double deviation = std::sqrt(std::max(0.0, (squares - sum * usual) / (counted - 1)));
  const double limit = usual + deviations * deviation;
  std::vector<int> kept;
  kept.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool keep = many ? bound_of(positions, i, static_cast<std::size_t>(neighbours),
                                grid.cell_size()) <= limit
                     : means[i] <= limit;
    if (many && !keep) {
      ask(i);
      keep = !distances.empty() && mean_of(distances) <= limit;
    }
    if (keep) kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace arcstart::seam_finding
