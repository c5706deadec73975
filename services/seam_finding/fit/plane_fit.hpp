// Least-squares planes from sums over points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::seam_finding {

// Ten sums over points, from which the best plane follows; two of them add up. Points are taken
// relative to an origin near them, so that no digits are lost.
class PlaneSums {
 public:
  explicit PlaneSums(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) : origin_(origin) {}

  void add(const Eigen::Vector3d& point, double weight = 1) {
    const Eigen::Vector3d p = point - origin_, q = weight * p;
    weight_ += weight;
    sum_ += q;
    xx_ += q.x() * p.x(), xy_ += q.x() * p.y(), xz_ += q.x() * p.z();
    yy_ += q.y() * p.y(), yz_ += q.y() * p.z(), zz_ += q.z() * p.z();
  }
  // All of them that `chosen` names, one after the other.
  void add(const std::vector<Eigen::Vector3d>& points, const std::vector<int>& chosen);
  void add(const PlaneSums& other);  // of any origin

  struct Fit {
    Plane plane;               // normal of either sign
    Eigen::Vector3d centroid;  // mm
    double rms = 0;            // distance of the points from the plane; mm
    Eigen::Vector2d spread;    // standard deviation within the plane, small and large; mm
  };
  // Needs a weight above 0; three points not on a line make the plane a definite one (spread[0] >
  // 0).
  Fit fit() const;
  double weight() const { return weight_; }

 private:
  Eigen::Vector3d origin_;
  double weight_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
};

}  // namespace arcstart::seam_finding
