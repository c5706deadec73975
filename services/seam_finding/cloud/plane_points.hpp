// Points side by side, for passes over many of them: how far each lies from a plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::seam_finding {

// Coordinates as floats from an origin among them: within a metre good to 0.05 um.
class PlanePoints {
 public:
  PlanePoints() = default;
  explicit PlanePoints(const std::vector<Eigen::Vector3d>& points);

  std::size_t size() const { return x_.size(); }
  // How many of those from first to last lie no farther from the plane than the tolerance.
  int count_near(const Plane& plane, double tolerance, std::size_t first, std::size_t last) const;
  // All that do: their places in the list given first, rising.
  void find_near(const Plane& plane, double tolerance, std::vector<int>& near) const;

  const std::vector<int>& places() const { return places_; }
  void remove(const std::vector<int>& places);  // rising

 private:
  struct Coefficients {
    float x, y, z, offset, tolerance;
  };
  Coefficients from_origin(const Plane& plane, double tolerance) const;

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<float> x_, y_, z_;
  std::vector<int> places_;
};

}  // namespace arcstart::seam_finding
