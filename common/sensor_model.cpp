#include "common/sensor_model.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace arcstart {
namespace {

struct Distorted {
  Eigen::Vector2d point;     // on the plane z = 1
  Eigen::Matrix2d jacobian;  // symmetric: Brown's model is the gradient of a potential
};

// Brown's lens distortion of a point on the plane z = 1, with its exact derivative.
Distorted distort(const std::array<double, 5>& distortion, const Eigen::Vector2d& undistorted) {
  const auto& [k1, k2, p1, p2, k3] = distortion;
  const double x = undistorted.x(), y = undistorted.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // d radial / dx = slope * x
  Distorted result;
  result.point = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                  y * radial + 2 * p2 * x * y + p1 * (r2 + 2 * y * y)};
  const double mixed = slope * x * y + 2 * p1 * x + 2 * p2 * y;
  result.jacobian << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x, mixed,  //
      mixed, radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
  return result;
}

// Positive definite: there the image is neither folded nor turned over. A symmetric derivative that
// is so all over a convex region makes the distortion one to one on it.
bool unfolded(const Eigen::Matrix2d& jacobian) {
  return jacobian.trace() > 0 && jacobian.determinant() > 0;
}

// The undistorted point on the plane z = 1 of a distorted one: Newton's method from the centre, a
// step halved until it stays where the distortion is unfolded and comes nearer.
std::optional<Eigen::Vector2d> undistort(const std::array<double, 5>& distortion,
                                         const Eigen::Vector2d& distorted) {
  constexpr double kTolerance = 1e-12, kFinest = 1e-15;
  constexpr int kSteps = 50, kHalvings = 20;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Distorted here = distort(distortion, point);
  double error = (distorted - here.point).norm();
  for (int step = 0; step < kSteps && error > kFinest; ++step) {
    Eigen::Vector2d change = here.jacobian.inverse() * (distorted - here.point);
    bool nearer = false;
    for (int halving = 0; halving < kHalvings && !nearer; ++halving, change /= 2) {
      const Distorted there = distort(distortion, point + change);
      const double error_there = (distorted - there.point).norm();
      nearer = unfolded(there.jacobian) && error_there < error;
      if (!nearer) continue;
      point += change;
      here = there;
      error = error_there;
    }
    if (!nearer) break;
  }
  if (!(error <= kTolerance)) return std::nullopt;
  return point;
}

// Whether the image's border has an undistorted place, with no fold on the way to it from the
// centre.
bool folds(const SensorModel& model) {
  constexpr int kSamples = 32;
  for (int i = 0; i <= kSamples; ++i) {
    const double u = -0.5 + model.width * (i / double{kSamples});
    const double v = -0.5 + model.height * (i / double{kSamples});
    const Eigen::Vector2d border[] = {
        {u, -0.5}, {u, model.height - 0.5}, {-0.5, v}, {model.width - 0.5, v}};
    for (const Eigen::Vector2d& pixel : border) {
      const auto ray = undistorted_ray(model, pixel.x(), pixel.y());
      if (!ray) return true;
      for (int k = 1; k < kSamples; ++k)
        if (!unfolded(distort(model.distortion, ray->head<2>() * (k / double{kSamples})).jacobian))
          return true;
    }
  }
  return false;
}

bool sees_laser_plane(const SensorModel& model) {
  constexpr int kSamples = 8;
  for (int i = 0; i <= kSamples; ++i)
    for (int k = 0; k <= kSamples; ++k)
      if (camera_point(model, (model.width - 1) * (i / double{kSamples}),
                       (model.height - 1) * (k / double{kSamples})))
        return true;
  return false;
}

}  // namespace

std::string sensor_model_error(const SensorModel& model) {
  constexpr int kLargestSize = 32767;  // what a message can say
  if (model.width < 1 || model.height < 1 || model.width > kLargestSize ||
      model.height > kLargestSize)
    return "the image size must lie between 1 and 32767 px";
  for (const double number : {model.fx, model.fy, model.cx, model.cy, model.laser_plane.offset})
    if (!std::isfinite(number)) return "the camera matrix or the laser plane is not finite";
  for (const double number : model.distortion)
    if (!std::isfinite(number)) return "the distortion is not finite";
  if (!model.laser_plane.normal.allFinite()) return "the laser plane is not finite";
  if (!(model.fx > 0 && model.fy > 0)) return "the focal length must be greater than 0";
  if (std::abs(model.laser_plane.normal.norm() - 1) > 1e-6)
    return "the laser plane's normal must have length 1";
  if (std::abs(model.laser_plane.offset) < 1)
    return "the laser plane passes within 1 mm of the camera centre";
  if (folds(model)) return "the distortion folds the image";
  if (!sees_laser_plane(model)) return "the laser plane lies outside the image";
  return "";
}

std::optional<Eigen::Vector3d> undistorted_ray(const SensorModel& model, double u, double v) {
  const auto point =
      undistort(model.distortion, {(u - model.cx) / model.fx, (v - model.cy) / model.fy});
  if (!point) return std::nullopt;
  return Eigen::Vector3d{point->x(), point->y(), 1};
}

std::optional<Eigen::Vector2d> undistorted_pixel(const SensorModel& model, double u, double v) {
  const auto ray = undistorted_ray(model, u, v);
  if (!ray) return std::nullopt;
  return Eigen::Vector2d{model.fx * ray->x() + model.cx, model.fy * ray->y() + model.cy};
}

Eigen::Vector2d project(const SensorModel& model, const Eigen::Vector3d& point) {
  const Eigen::Vector2d distorted =
      distort(model.distortion, {point.x() / point.z(), point.y() / point.z()}).point;
  return {model.fx * distorted.x() + model.cx, model.fy * distorted.y() + model.cy};
}

std::optional<Eigen::Vector3d> camera_point(const SensorModel& model, double u, double v) {
  const auto ray = undistorted_ray(model, u, v);
  if (!ray) return std::nullopt;
  const double depth = -model.laser_plane.offset / model.laser_plane.normal.dot(*ray);
  if (!(depth > 0 && std::isfinite(depth))) return std::nullopt;
  return depth * *ray;
}

Eigen::Matrix<double, 4, 3> pixel_to_camera(const SensorModel& model) {
  Eigen::Matrix3d inverse_camera_matrix;
  inverse_camera_matrix << 1 / model.fx, 0, -model.cx / model.fx,  //
      0, 1 / model.fy, -model.cy / model.fy,                       //
      0, 0, 1;
  Eigen::Matrix<double, 4, 3> matrix;
  matrix.topRows<3>() = -model.laser_plane.offset * inverse_camera_matrix;
  matrix.bottomRows<1>() = model.laser_plane.normal.transpose() * inverse_camera_matrix;
  return matrix;
}

}  // namespace arcstart
