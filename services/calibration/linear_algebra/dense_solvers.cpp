#include "services/calibration/linear_algebra/dense_solvers.hpp"

#include <Eigen/Dense>

namespace arcstart::calibration {

Eigen::MatrixXd symmetric_inverse(const Eigen::MatrixXd& matrix) {
  return matrix.ldlt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& left, const Eigen::VectorXd& right) {
  return left.colPivHouseholderQr().solve(right);
}

Eigen::Vector2d direction_of_least_spread(const Eigen::Matrix2d& scatter) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvectors().col(0);
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

}  // namespace arcstart::calibration
