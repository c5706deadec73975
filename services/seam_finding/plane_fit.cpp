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

void PlaneSums::add(const std::vector<Eigen::Vector3d>& points, const std::vector<int>& chosen) {
  double x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const int i : chosen) {
    const double px = points[i].x() - origin_.x(), py = points[i].y() - origin_.y(),
                 pz = points[i].z() - origin_.z();
    x += px, y += py, z += pz;
    xx += px * px, xy += px * py, xz += px * pz, yy += py * py, yz += py * pz, zz += pz * pz;
  }
  weight_ += static_cast<double>(chosen.size());
  sum_ += Eigen::Vector3d(x, y, z);
  Eigen::Matrix3d squares;
  squares << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  squares_ += squares;
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
