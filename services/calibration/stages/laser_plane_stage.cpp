#include "services/calibration/stages/laser_plane_stage.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/calibration/linear_algebra/dense_solvers.hpp"

namespace arcstart::calibration {
namespace {

constexpr std::size_t kFewest = 20;  // centres of a stripe

struct ImageLine {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double offset = 0;
  double distance(const Eigen::Vector2d& p) const { return std::abs(normal.dot(p) + offset); }
};

ImageLine line_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  ImageLine line;
  line.normal = Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()).normalized();
  line.offset = -line.normal.dot(a);
  return line;
}

ImageLine fit_line(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto& p : points) scatter += (p - mean) * (p - mean).transpose();
  ImageLine line;
  line.normal = direction_of_least_spread(scatter);
  line.offset = -line.normal.dot(mean);
  return line;
}

}  // namespace

std::vector<Eigen::Vector2d> straight_stripe(const SensorModel& camera,
                                             const std::vector<Eigen::Vector2d>& stripe, int most) {
  std::vector<Eigen::Vector2d> seen, flat;  // flat: undistorted, on z = 1, in px of the lens' scale
  for (const Eigen::Vector2d& pixel : stripe)
    if (const auto ray = undistorted_ray(camera, pixel.x(), pixel.y())) {
      seen.push_back(pixel);
      flat.push_back(camera.fx * ray->head<2>());
    }
  if (flat.size() < kFewest) return {};
  // The line through two centres that most others support, of pairs all over the stripe.
  constexpr double kSupport = 2;  // px
  constexpr std::size_t kPlaces = 24;
  ImageLine best;
  std::size_t most_support = 0;
  for (std::size_t i = 0; i < kPlaces; ++i)
    for (std::size_t j = i + 1; j < kPlaces; ++j) {
      const auto& a = flat[i * (flat.size() - 1) / (kPlaces - 1)];
      const auto& b = flat[j * (flat.size() - 1) / (kPlaces - 1)];
      if ((a - b).norm() < 10 * kSupport) continue;
      const ImageLine line = line_through(a, b);
      const auto support = static_cast<std::size_t>(std::count_if(
          flat.begin(), flat.end(), [&](const auto& p) { return line.distance(p) < kSupport; }));
      if (support > most_support) {
        most_support = support;
        best = line;
      }
    }
  std::vector<std::size_t> chosen;
  double reach = kSupport;
  for (int round = 0; round < 3; ++round) {
    chosen.clear();
    std::vector<Eigen::Vector2d> points;
    std::vector<double> distances;
    for (std::size_t i = 0; i < flat.size(); ++i)
      if (const double distance = best.distance(flat[i]); distance < reach) {
        chosen.push_back(i);
        points.push_back(flat[i]);
        distances.push_back(distance);
      }
    if (points.size() < kFewest) return {};
    best = fit_line(points);
    reach = std::clamp(4 * 1.4826 * median(std::move(distances)), 0.2, kSupport);
  }
  std::vector<Eigen::Vector2d> result;
  const std::size_t count = std::min(chosen.size(), static_cast<std::size_t>(most));
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(seen[chosen[i * (chosen.size() - 1) / std::max<std::size_t>(1, count - 1)]]);
  return result;
}

std::vector<Eigen::Vector3d> stripe_on_plate(const SensorModel& camera,
                                             const RigidTransform& T_camera_plate,
                                             const std::vector<Eigen::Vector2d>& stripe) {
  const Eigen::Vector3d normal = T_camera_plate.linear().col(2);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector2d& pixel : stripe)
    if (const auto ray = undistorted_ray(camera, pixel.x(), pixel.y())) {
      const double depth = normal.dot(T_camera_plate.translation()) / normal.dot(*ray);
      if (depth > 0 && std::isfinite(depth)) points.push_back(depth * *ray);
    }
  return points;
}

LaserPlaneFit fit_laser_plane(const std::vector<Eigen::Vector3d>& points) {
  constexpr int kRounds = 10;
  constexpr double kHuber = 2;  // standard deviations beyond which a point counts for less
  std::vector<double> weights(points.size(), 1);
  LaserPlaneFit fit;
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      mean += weights[i] * points[i];
      sum += weights[i];
    }
    mean /= sum;
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i)
      scatter += weights[i] * (points[i] - mean) * (points[i] - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    fit.plane.normal = solver.eigenvectors().col(0);
    fit.plane.offset = -fit.plane.normal.dot(mean);
    fit.spread = std::sqrt(std::max(0.0, solver.eigenvalues()(1) / solver.eigenvalues()(2)));
    std::vector<double> distances;
    double squares = 0;
    for (const Eigen::Vector3d& point : points) {
      distances.push_back(std::abs(fit.plane.signed_distance(point)));
      squares += distances.back() * distances.back();
    }
    fit.rms_mm = std::sqrt(squares / static_cast<double>(points.size()));
    const double deviation = std::max(1e-6, 1.4826 * median(std::vector(distances)));
    for (std::size_t i = 0; i < points.size(); ++i)
      weights[i] = std::min(1.0, kHuber * deviation / std::max(1e-12, distances[i]));
  }
  if (fit.plane.offset > 0) fit.plane = fit.plane.flipped();
  return fit;
}

}  // namespace arcstart::calibration
