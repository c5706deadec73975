// Solvers whose templates take seconds to compile: once here, not in every file that uses them.
#pragma once

#include <Eigen/Core>

namespace arcstart::calibration {

// Of a symmetric n x n matrix that is positive definite or nearly so, by Cholesky's method with
// pivots (LDL^T).
Eigen::MatrixXd symmetric_inverse(const Eigen::MatrixXd& matrix);

// The x, n, of least |left x - right|, left m x n with m >= n, right m, by a QR decomposition with
// pivots.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& left, const Eigen::VectorXd& right);

// The unit direction in which points of this scatter (2 x 2, symmetric) spread least.
Eigen::Vector2d direction_of_least_spread(const Eigen::Matrix2d& scatter);

// The rotation R for which trace(R^T matrix) is greatest: Procrustes, by SVD.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

}  // namespace arcstart::calibration
