#include "services/seam_finding/fit/plane_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace arcstart::seam_finding {

void PlaneSums::add(const PlaneSums& other) {
  const Eigen::Vector3d shift = other.origin_ - origin_;
  const Eigen::Vector3d& sum = other.sum_;
  const auto moved = [&](int a, int b) {
    return shift[a] * sum[b] + sum[a] * shift[b] + other.weight_ * shift[a] * shift[b];
  };
  xx_ += other.xx_ + moved(0, 0), xy_ += other.xy_ + moved(0, 1), xz_ += other.xz_ + moved(0, 2);
  yy_ += other.yy_ + moved(1, 1), yz_ += other.yz_ + moved(1, 2), zz_ += other.zz_ + moved(2, 2);
  sum_ += sum + other.weight_ * shift;
  weight_ += other.weight_;
}

void PlaneSums::add(const std::vector<Eigen::Vector3d>& points, const std::vector<int>& chosen) {
  PlaneSums sums(origin_);  // of its own: in registers
  for (const int i : chosen) sums.add(points[i]);
  add(sums);
}

PlaneSums::Fit PlaneSums::fit() const {
  Fit fit;
  const Eigen::Vector3d mean = sum_ / weight_;
  Eigen::Matrix3d squares;
  squares << xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / weight_ -
                                                              mean * mean.transpose());
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0.0);
  fit.centroid = origin_ + mean;
  fit.plane.normal = solver.eigenvectors().col(0).normalized();
  fit.plane.offset = -fit.plane.normal.dot(fit.centroid);
  fit.rms = std::sqrt(variances[0]);
  fit.spread = {std::sqrt(variances[1]), std::sqrt(variances[2])};
  return fit;
}

}  // namespace arcstart::seam_finding
