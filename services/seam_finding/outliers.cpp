#include "services/seam_finding/outliers.hpp"

#include <cmath>
#include <numeric>

#include "services/seam_finding/neighbour_grid.hpp"

namespace arcstart {

std::vector<int> without_outliers(const ScanCloud& cloud, const std::vector<int>& points,
                                  int neighbours, double deviations, double spacing) {
  std::vector<Eigen::Vector3d> positions;
  for (const int i : points) positions.push_back(cloud.points[i]);
  const NeighbourGrid grid(positions, std::max(1e-3, 1.5 * spacing));
  std::vector<double> means(points.size(), -1), distances;
  double sum = 0, squares = 0;
  int counted = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    grid.nearest_distances(static_cast<int>(i), neighbours, distances);
    if (distances.empty()) continue;
    means[i] = std::accumulate(distances.begin(), distances.end(), 0.0) /
               static_cast<double>(distances.size());
    sum += means[i], squares += means[i] * means[i], ++counted;
  }
  if (counted < 2) return points;
  const double mean = sum / counted;
  const double deviation = std::sqrt(std::max(0.0, (squares - sum * mean) / (counted - 1)));
  std::vector<int> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (means[i] >= 0 && means[i] <= mean + deviations * deviation) kept.push_back(points[i]);
  return kept;
}

}  // namespace arcstart
