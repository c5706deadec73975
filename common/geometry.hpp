// Rigid transforms, planes and lines. Lengths in mm, angles in rad.
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <optional>

namespace arcstart {

inline constexpr double kDegree = std::numbers::pi / 180;  // rad

// T_a_b takes coordinates in b to coordinates in a.
using RigidTransform = Eigen::Isometry3d;

// position in mm, quaternion (w, x, y, z), normalised here.
RigidTransform make_transform(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation);

// As messages carry them: 3 numbers in mm, 4 numbers w, x, y, z.
RigidTransform transform_from_arrays(const double position[3], const double quaternion[4]);
void transform_to_arrays(const RigidTransform& transform, double position[3], double quaternion[4]);

// The pose a share of the way from a to b (0: a, 1: b): position linear, orientation by slerp on
// the shorter arc.
RigidTransform interpolate(const RigidTransform& a, const RigidTransform& b, double share);

// All points p with normal.dot(p) + offset = 0, |normal| = 1. A plate's normal points out of the
// metal.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;  // mm

  double signed_distance(const Eigen::Vector3d& point) const { return normal.dot(point) + offset; }
  Plane flipped() const { return {-normal, -offset}; }
};

// The plane in frame a of one given in frame b.
Plane transform_plane(const RigidTransform& T_a_b, const Plane& plane_in_b);

// point + t * direction, |direction| = 1.
struct Line {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();

  double along(const Eigen::Vector3d& p) const { return direction.dot(p - point); }
  Eigen::Vector3d at(double t) const { return point + t * direction; }
  double distance(const Eigen::Vector3d& p) const { return (p - at(along(p))).norm(); }
};

// The common line of two planes, its point the one nearest to `near`; nothing where they are
// parallel within 0.1 deg.
std::optional<Line> intersect(const Plane& a, const Plane& b, const Eigen::Vector3d& near);

// Angle between two directions, 0 to pi. Exact near 0 and pi, where acos is not.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace arcstart
