#include "common/geometry.hpp"

#include <cmath>
#include <numbers>

namespace arcstart {

RigidTransform make_transform(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
  RigidTransform transform = RigidTransform::Identity();
  transform.linear() = rotation.normalized().toRotationMatrix();
  transform.translation() = position;
  return transform;
}

RigidTransform transform_from_arrays(const double position[3], const double quaternion[4]) {
  return make_transform({position[0], position[1], position[2]},
                        {quaternion[0], quaternion[1], quaternion[2], quaternion[3]});
}

void transform_to_arrays(const RigidTransform& transform, double position[3],
                         double quaternion[4]) {
  Eigen::Map<Eigen::Vector3d>{position} = transform.translation();
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(transform.linear()).normalized();
  // q and -q are one rotation: the one with w >= 0 is written, so that equal poses are equal bytes.
  const double sign = rotation.w() < 0 ? -1 : 1;
  quaternion[0] = sign * rotation.w();
  quaternion[1] = sign * rotation.x();
  quaternion[2] = sign * rotation.y();
  quaternion[3] = sign * rotation.z();
}

RigidTransform interpolate(const RigidTransform& a, const RigidTransform& b, double share) {
  const Eigen::Vector3d position = (1 - share) * a.translation() + share * b.translation();
  // Eigen's slerp turns the sign of the second quaternion where the arc to the first is the longer
  // one.
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond(a.linear()).slerp(share, Eigen::Quaterniond(b.linear()));
  return make_transform(position, rotation);
}

Plane transform_plane(const RigidTransform& T_a_b, const Plane& plane_in_b) {
  const Eigen::Vector3d normal = T_a_b.linear() * plane_in_b.normal;
  return {normal, plane_in_b.offset - normal.dot(T_a_b.translation())};
}

std::optional<Line> intersect(const Plane& a, const Plane& b, const Eigen::Vector3d& near) {
  const Eigen::Vector3d cross = a.normal.cross(b.normal);
  const double sine = cross.norm();
  constexpr double kSmallestSine = 0.1 * std::numbers::pi / 180;
  if (!(sine > kSmallestSine)) return std::nullopt;
  // The point of the line nearest to `near`: go from there by alpha and beta along the two normals,
  // so that both planes hold. Their Gram matrix has the determinant sine^2.
  const double cosine = a.normal.dot(b.normal);
  const double distance_a = a.signed_distance(near);
  const double distance_b = b.signed_distance(near);
  const double alpha = -(distance_a - cosine * distance_b) / (sine * sine);
  const double beta = -(distance_b - cosine * distance_a) / (sine * sine);
  return Line{near + alpha * a.normal + beta * b.normal, cross / sine};
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace arcstart
