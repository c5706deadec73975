// Three angles about the axes, composed in the orders that robots use.
#pragma once

#include <Eigen/Core>
#include <array>

namespace arcstart::calibration {

// By the axes of the three factors from left to right; 0: x, 1: y, 2: z. The middle one is y.
struct EulerOrder {
  std::array<int, 3> axes;
  const char* product;  // for people
};

inline constexpr EulerOrder kFixedXyz{{2, 1, 0}, "Rz Ry Rx"};     // FANUC W P R; KUKA A B C
inline constexpr EulerOrder kRotatingXyz{{0, 1, 2}, "Rx Ry Rz"};  // Staubli
inline constexpr EulerOrder kZyz{{2, 1, 2}, "Rz Ry Rz"};          // Kawasaki O A T

// angles: of the three factors, from left to right; rad.
Eigen::Matrix3d composed(const EulerOrder& order, const Eigen::Vector3d& angles);

// The three angles of a rotation, the middle one within 90 deg, or from 0 to 180 deg where first
// and third axis are one.
Eigen::Vector3d euler_angles(const EulerOrder& order, const Eigen::Matrix3d& rotation);

}  // namespace arcstart::calibration
