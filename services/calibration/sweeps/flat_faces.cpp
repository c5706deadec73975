#include "services/calibration/sweeps/flat_faces.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

namespace arcstart::calibration {
namespace {

constexpr int kTries = 150;
constexpr std::size_t kMostFaces = 4;
constexpr double kLeastShare = 0.1;   // of all points
constexpr double kLeastHeight = 5.0;  // of a sample's triangle; mm

using Points = std::vector<Eigen::Vector3d>;

// Without standard distributions, which differ from library to library.
const Eigen::Vector3d& any_of(const Points& points, std::mt19937_64& random) {
  return points[random() % points.size()];
}

Points near(const Points& points, const Plane& plane, double tolerance) {
  Points found;
  for (const Eigen::Vector3d& point : points)
    if (std::abs(plane.signed_distance(point)) < tolerance) found.push_back(point);
  return found;
}

Plane best_sample(const Points& points, double tolerance, std::mt19937_64& random) {
  Plane best;
  std::ptrdiff_t most = 0;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const Eigen::Vector3d &a = any_of(points, random), &b = any_of(points, random),
                          &c = any_of(points, random);
    const Eigen::Vector3d across = (b - a).cross(c - a);
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    if (!(across.norm() > kLeastHeight * longest)) continue;
    const Eigen::Vector3d normal = across.normalized();
    const Plane plane{normal, -normal.dot(a)};
    const auto count = std::count_if(points.begin(), points.end(), [&](const auto& point) {
      return std::abs(plane.signed_distance(point)) < tolerance;
    });
    if (count > most) most = count, best = plane;
  }
  return best;
}

}  // namespace

FlatFace fit_face(const Points& points) {
  FlatFace face;
  face.points = static_cast<int>(points.size());
  face.centre.setZero();
  for (const Eigen::Vector3d& point : points) face.centre += point;
  face.centre /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points)
    scatter += (point - face.centre) * (point - face.centre).transpose();
  face.plane.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  face.plane.offset = -face.plane.normal.dot(face.centre);
  return face;
}

std::vector<FlatFace> flat_faces(const Points& points, double tolerance) {
  std::mt19937_64 random(1);
  std::vector<FlatFace> faces;
  Points rest = points;
  const double fewest = std::max(12.0, kLeastShare * static_cast<double>(points.size()));
  while (faces.size() < kMostFaces && static_cast<double>(rest.size()) >= fewest) {
    Plane plane = best_sample(rest, tolerance, random);
    for (int round = 0; round < 2; ++round) {
      const Points on = near(rest, plane, tolerance);
      if (static_cast<double>(on.size()) < fewest) return faces;
      plane = fit_face(on).plane;
    }
    const Points on = near(rest, plane, tolerance);
    if (static_cast<double>(on.size()) < fewest) return faces;
    faces.push_back(fit_face(on));
    std::erase_if(rest, [&](const auto& point) {
      return std::abs(plane.signed_distance(point)) < tolerance;
    });
  }
  return faces;
}

}  // namespace arcstart::calibration
