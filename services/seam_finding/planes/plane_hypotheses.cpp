#include "services/seam_finding/planes/plane_hypotheses.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/planes/constants.hpp"

namespace arcstart::seam_finding {

std::size_t jury_step(std::size_t points) {
  return std::max<std::size_t>(1, (points + kCloud.sample - 1) / kCloud.sample);
}

std::vector<Eigen::Vector3d> every(std::size_t step, std::size_t first,
                                   const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> some;
  some.reserve(points.size() / step + 1);
  for (std::size_t i = first; i < points.size(); i += step) some.push_back(points[i]);
  return some;
}

PlaneHypotheses::PlaneHypotheses(std::vector<Plane> planes,
                                 const std::vector<Eigen::Vector3d>& points, const Pieces& pieces,
                                 const PlaneSearch& search)
    : search_(search),
      planes_(std::move(planes)),
      step_(jury_step(points.size())),
      sample_(every(step_, 0, points)),
      left_(sample_),
      pieces_(step_ == 1
                  ? pieces
                  : Pieces(NeighbourGrid(
                        sample_, search.connection * std::sqrt(static_cast<double>(step_))))),
      least_(std::max(2, search.least_points / static_cast<int>(step_))) {
  for (std::size_t i = 0; i < planes_.size(); ++i)
    offer(left_.count_near(planes_[i], search.tolerance, 0, left_.size()), i);
}

std::optional<Plane> PlaneHypotheses::best() {
  while (!worths_.empty()) {
    const auto [bound, place] = worths_.top();
    worths_.pop();
    const auto plane = static_cast<std::size_t>(-place);
    left_.find_near(planes_[plane], search_.tolerance, on_it_);
    const int worth = static_cast<int>(on_it_.size()) < least_ ? 0 : pieces_.largest_size(on_it_);
    if (worth >= least_ && (worths_.empty() || worth >= worths_.top().first)) return planes_[plane];
    offer(worth, plane);
  }
  return std::nullopt;
}

void PlaneHypotheses::remove(const std::vector<int>& places) {
  std::vector<int> sampled;
  for (const int i : places)
    if (i % static_cast<int>(step_) == 0) sampled.push_back(i / static_cast<int>(step_));
  left_.remove(sampled);
}

void PlaneHypotheses::offer(int worth, std::size_t plane) {
  if (worth >= least_) worths_.emplace(worth, -static_cast<int>(plane));
}

}  // namespace arcstart::seam_finding
