#include "services/seam_finding/cloud/plane_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {

PlanePoints::PlanePoints(const std::vector<Eigen::Vector3d>& points) {
  if (!points.empty()) origin_ = points[points.size() / 2];
  x_.resize(points.size()), y_.resize(points.size()), z_.resize(points.size());
  places_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    x_[i] = static_cast<float>(points[i].x() - origin_.x());
    y_[i] = static_cast<float>(points[i].y() - origin_.y());
    z_[i] = static_cast<float>(points[i].z() - origin_.z());
    places_[i] = static_cast<int>(i);
  }
}

PlanePoints::Coefficients PlanePoints::from_origin(const Plane& plane, double tolerance) const {
  return {static_cast<float>(plane.normal.x()), static_cast<float>(plane.normal.y()),
          static_cast<float>(plane.normal.z()), static_cast<float>(plane.signed_distance(origin_)),
          static_cast<float>(tolerance)};
}

int PlanePoints::count_near(const Plane& plane, double tolerance, std::size_t first,
                            std::size_t last) const {
  const Coefficients c = from_origin(plane, tolerance);
  const float *x = x_.data(), *y = y_.data(), *z = z_.data();
  int near = 0;
  for (std::size_t i = first; i < last; ++i)
    near += std::abs(c.x * x[i] + c.y * y[i] + c.z * z[i] + c.offset) <= c.tolerance;
  return near;
}

// In blocks: all distances of one side by side, then what is near of it.
void PlanePoints::find_near(const Plane& plane, double tolerance, std::vector<int>& near) const {
  const Coefficients c = from_origin(plane, tolerance);
  near.clear();
  std::array<float, kCloud.distance_block> off;
  std::array<int, kCloud.distance_block> found;
  for (std::size_t first = 0; first < size(); first += kCloud.distance_block) {
    const std::size_t count = std::min(kCloud.distance_block, size() - first);
    const float *x = &x_[first], *y = &y_[first], *z = &z_[first];
    for (std::size_t i = 0; i < count; ++i)
      off[i] = std::abs(c.x * x[i] + c.y * y[i] + c.z * z[i] + c.offset);
    std::size_t some = 0;
    for (std::size_t i = 0; i < count; ++i) {
      found[some] = places_[first + i];
      some += off[i] <= c.tolerance;
    }
    near.insert(near.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(some));
  }
}

void PlanePoints::remove(const std::vector<int>& places) {
  std::size_t left = 0, next = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (next < places.size() && places[next] == places_[i]) {
      ++next;
      continue;
    }
    x_[left] = x_[i], y_[left] = y_[i], z_[left] = z_[i];
    places_[left++] = places_[i];
  }
  x_.resize(left), y_.resize(left), z_.resize(left), places_.resize(left);
}

}  // namespace arcstart::seam_finding
