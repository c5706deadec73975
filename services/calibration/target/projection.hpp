// The camera's forward model with the centre of a circle's image, for numbers and for Ceres' dual
// numbers.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace arcstart::calibration {

template <class T>
using Vector2 = Eigen::Matrix<T, 2, 1>;
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

// Where the plate's points and directions lie in camera.
template <class T>
struct TargetInCamera {
  Matrix3<T> rotation;
  Vector3<T> position;  // mm
};

// The centre of the ellipse as which a pinhole shows a circle of the plate, on z = 1: exact. The
// circle's own centre where the radius is 0.
template <class T>
Vector2<T> ellipse_centre(const TargetInCamera<T>& plate, const Eigen::Vector3d& point,
                          double radius) {
  const Vector3<T> c = plate.rotation * point.cast<T>() + plate.position;
  const auto h1 = plate.rotation.col(0), h2 = plate.rotation.col(1);
  const T square(radius * radius);
  const T below = square * (h1.z() * h1.z() + h2.z() * h2.z()) - c.z() * c.z();
  return {(square * (h1.x() * h1.z() + h2.x() * h2.z()) - c.x() * c.z()) / below,
          (square * (h1.y() * h1.z() + h2.y() * h2.z()) - c.y() * c.z()) / below};
}

// Brown's distortion (k1, k2, p1, p2, k3) of a point on z = 1.
template <class T>
Vector2<T> distorted(const T* k, const Vector2<T>& point) {
  const T x = point.x(), y = point.y(), r2 = x * x + y * y;
  const T radial = T(1) + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  return {x * radial + T(2) * k[2] * x * y + k[3] * (r2 + T(2) * x * x),
          y * radial + k[2] * (r2 + T(2) * y * y) + T(2) * k[3] * x * y};
}

// camera: fx, fy, cx, cy.
template <class T>
Vector2<T> pixel(const T* camera, const T* distortion, const Vector2<T>& point) {
  const Vector2<T> d = distorted(distortion, point);
  return {camera[0] * d.x() + camera[2], camera[1] * d.y() + camera[3]};
}

// Determinant of the distortion's derivative: how much larger it makes a small area.
template <class T>
T area_factor(const T* k, const Vector2<T>& point) {
  const T x = point.x(), y = point.y(), r2 = x * x + y * y;
  const T radial = T(1) + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const T slope = T(2) * (k[0] + r2 * (T(2) * k[1] + r2 * T(3) * k[4]));
  const T mixed = slope * x * y + T(2) * k[2] * x + T(2) * k[3] * y;
  return (radial + slope * x * x + T(2) * k[2] * y + T(6) * k[3] * x) *
             (radial + slope * y * y + T(6) * k[2] * y + T(2) * k[3] * x) -
         mixed * mixed;
}

// Where the dark area that a circle makes in the image has its middle. The lens bends the ellipse
// too, by 0.04 px at the border of a usual image: the mean over its area by four points at the
// places that make it exact to the third order. A corner, radius 0, is a point.
template <class T>
Vector2<T> seen_centre(const T* camera, const T* distortion, const TargetInCamera<T>& plate,
                       const Eigen::Vector3d& point, double radius) {
  const Vector2<T> centre = ellipse_centre(plate, point, radius);
  if (radius == 0) return pixel(camera, distortion, centre);
  const T depth = (plate.rotation * point.cast<T>() + plate.position).z();
  T weights(0);
  Vector2<T> sum = Vector2<T>::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    const auto h = plate.rotation.col(axis);
    const Vector2<T> reach =
        (h.template head<2>() - centre * h.z()) * (T(radius) / depth) / T(1.4142135623730951);
    for (const double side : {-1.0, 1.0}) {
      const Vector2<T> at = centre + T(side) * reach;
      const T weight = area_factor(distortion, at);
      sum += weight * distorted(distortion, at);
      weights += weight;
    }
  }
  return {camera[0] * sum.x() / weights + camera[2], camera[1] * sum.y() / weights + camera[3]};
}

// The undistorted point on z = 1 that a distorted pixel shows. start: the same for numbers that
// have the value of these; one step of Newton's method from there gives the exact derivative.
template <class T>
Vector2<T> undistorted(const T* camera, const T* k, const Eigen::Vector2d& seen,
                       const Eigen::Vector2d& start) {
  const Vector2<T> at = start.cast<T>();
  const T x = at.x(), y = at.y(), r2 = x * x + y * y;
  const T radial = T(1) + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const T slope = T(2) * (k[0] + r2 * (T(2) * k[1] + r2 * T(3) * k[4]));
  Eigen::Matrix<T, 2, 2> jacobian;
  jacobian(0, 0) = radial + slope * x * x + T(2) * k[2] * y + T(6) * k[3] * x;
  jacobian(0, 1) = jacobian(1, 0) = slope * x * y + T(2) * k[2] * x + T(2) * k[3] * y;
  jacobian(1, 1) = radial + slope * y * y + T(6) * k[2] * y + T(2) * k[3] * x;
  const Vector2<T> wanted((T(seen.x()) - camera[2]) / camera[0],
                          (T(seen.y()) - camera[3]) / camera[1]);
  return at + jacobian.inverse() * (wanted - distorted(k, at));
}

}  // namespace arcstart::calibration
