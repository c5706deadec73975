#include "services/calibration/sweeps/ball_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "common/order_statistics.hpp"
#include "services/calibration/sweeps/flat_faces.hpp"

namespace arcstart::calibration {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int kPlaces = 150, kBallTries = 100;  // samples, of each place so many
constexpr std::size_t kFewestOnBall = 60;
constexpr double kFlat = 0.6;       // mm
constexpr double kRadiusOff = 0.2;  // of a sample's radius, as a share
constexpr int kBallRounds = 30;
constexpr double kLooseShare = 0.35;  // of the tolerance, RMS: points strewn evenly have 0.58
constexpr double kBallHuber = 2;      // times the points' deviation

struct Sphere {
  Eigen::Vector3d centre;
  double radius;
  double distance(const Eigen::Vector3d& point) const { return (point - centre).norm() - radius; }
};

// Through four points.
std::optional<Sphere> through(const std::array<Eigen::Vector3d, 4>& points) {
  Eigen::Matrix3d rows;
  Eigen::Vector3d right;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& p = points[static_cast<std::size_t>(i + 1)];
    rows.row(i) = 2 * (p - points[0]).transpose();
    right(i) = p.squaredNorm() - points[0].squaredNorm();
  }
  const auto solver = rows.fullPivLu();
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector3d centre = solver.solve(right);
  return Sphere{centre, (points[0] - centre).norm()};
}

Points on(const Points& points, const Sphere& sphere, double tolerance) {
  Points result;
  for (const Eigen::Vector3d& point : points)
    if (std::abs(sphere.distance(point)) < tolerance) result.push_back(point);
  return result;
}

// The table and the like would make up for a wrong radius by their number.
Points without_large_faces(const Points& points, double radius) {
  Points rest = points;
  for (const FlatFace& face : flat_faces(points, kFlat)) {
    const auto on_it = [&](const Eigen::Vector3d& point) {
      return std::abs(face.plane.signed_distance(point)) < 2 * kFlat;
    };
    const bool large = std::any_of(points.begin(), points.end(), [&](const auto& point) {
      return on_it(point) && (point - face.centre).norm() > 1.5 * radius;
    });
    if (large) std::erase_if(rest, on_it);
  }
  return rest;
}

// Gauss-Newton; the radius is held or free.
Sphere fit(const Points& points, Sphere sphere, bool radius_free) {
  for (int round = 0; round < kBallRounds; ++round) {
    std::vector<double> distances;
    for (const Eigen::Vector3d& point : points)
      distances.push_back(std::abs(sphere.distance(point)));
    const double deviation = std::max(1e-3, 1.4826 * median(distances));
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
    for (const Eigen::Vector3d& point : points) {
      const double distance = sphere.distance(point);
      const Eigen::Vector3d outward = (point - sphere.centre).normalized();
      const Eigen::Vector4d derivative(-outward.x(), -outward.y(), -outward.z(),
                                       radius_free ? -1 : 0);
      const double weight =
          std::min(1.0, kBallHuber * deviation / std::max(1e-12, std::abs(distance)));
      information += weight * derivative * derivative.transpose();
      gradient += weight * distance * derivative;
    }
    if (!radius_free) information(3, 3) = 1;
    const Eigen::Vector4d step = -information.ldlt().solve(gradient);
    sphere.centre += step.head<3>();
    sphere.radius += step(3);
    if (step.norm() < 1e-7) break;
  }
  return sphere;
}

}  // namespace

std::optional<FittedBall> find_ball(const Points& scanned, double radius_mm, double tolerance) {
  const Points points = without_large_faces(scanned, radius_mm);
  if (points.size() < kFewestOnBall) return std::nullopt;
  std::mt19937_64 random(1);
  const auto any_of = [&](const Points& from) -> const Eigen::Vector3d& {
    return from[random() % from.size()];
  };
  Sphere best{};
  std::ptrdiff_t most = 0;
  for (int place = 0; place < kPlaces; ++place) {
    // Points of one ball lie no farther apart than it is wide.
    const Eigen::Vector3d& first = any_of(points);
    Points around;
    for (const Eigen::Vector3d& point : points)
      if ((point - first).norm() < 2 * radius_mm) around.push_back(point);
    for (int attempt = 0; attempt < kBallTries; ++attempt) {
      const auto sphere = through({first, any_of(around), any_of(around), any_of(around)});
      if (!sphere || std::abs(sphere->radius / radius_mm - 1) > kRadiusOff) continue;
      const auto count = std::count_if(around.begin(), around.end(), [&](const auto& point) {
        return std::abs(sphere->distance(point)) < tolerance;
      });
      if (count > most) most = count, best = *sphere;
    }
  }
  if (most < static_cast<std::ptrdiff_t>(kFewestOnBall)) return std::nullopt;
  for (int round = 0; round < 3; ++round) {
    const Points near = on(points, best, tolerance);
    if (near.size() < kFewestOnBall) return std::nullopt;
    best = fit(near, best, true);
  }
  FittedBall ball;
  ball.points = on(points, best, tolerance);
  if (ball.points.size() < kFewestOnBall) return std::nullopt;
  ball.radius_mm = best.radius;
  const Sphere held = fit(ball.points, {best.centre, radius_mm}, false);
  ball.centre = held.centre;
  double sum = 0;
  for (const Eigen::Vector3d& point : ball.points) sum += std::pow(held.distance(point), 2);
  ball.rms_mm = std::sqrt(sum / static_cast<double>(ball.points.size()));
  if (ball.rms_mm > kLooseShare * tolerance) return std::nullopt;
  return ball;
}

}  // namespace arcstart::calibration
