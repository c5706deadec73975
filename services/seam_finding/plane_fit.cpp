#include "services/seam_finding/plane_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace arcstart {

void PlaneSums::add(const PlaneSums& other) {
  const Eigen::Vector3d shift = other.origin_ - origin_;
  squares_ += other.squares_ + shift * other.sum_.transpose() + other.sum_ * shift.transpose() +
              other.weight_ * shift * shift.transpose();
  sum_ += other.sum_ + other.weight_ * shift;
  weight_ += other.weight_;
}

PlaneSums::Fit PlaneSums::fit() const {
  Fit fit;
  const Eigen::Vector3d mean = sum_ / weight_;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares_ / weight_ -
                                                              mean * mean.transpose());
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0.0);
  fit.centroid = origin_ + mean;
  fit.plane.normal = solver.eigenvectors().col(0).normalized();
  fit.plane.offset = -fit.plane.normal.dot(fit.centroid);
  fit.rms = std::sqrt(variances[0]);
  fit.spread = {std::sqrt(variances[1]), std::sqrt(variances[2])};
  return fit;
}

}  // namespace arcstart
