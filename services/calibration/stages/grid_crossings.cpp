#include <cmath>

#include "services/calibration/linear_algebra/dense_solvers.hpp"
#include "services/calibration/stages/laser_plane_stage.hpp"
#include "services/calibration/target/projection.hpp"

namespace arcstart::calibration {
namespace {

// A line's places in the image and on the plate are one projective map of each other:
// place = (a s + b) / (c s + 1). Least squares over three or more points; nothing less is needed
// than that cross-ratios stay.
std::optional<double> place_on_line(const std::vector<double>& s, const std::vector<double>& places,
                                    double crossing) {
  Eigen::MatrixXd left(static_cast<Eigen::Index>(s.size()), 3);
  Eigen::VectorXd right(left.rows());
  for (Eigen::Index i = 0; i < left.rows(); ++i) {
    const double si = s[static_cast<std::size_t>(i)], p = places[static_cast<std::size_t>(i)];
    left.row(i) << si, 1, -p * si;
    right(i) = p;
  }
  const Eigen::Vector3d map = least_squares(left, right);
  const double below = map(2) * crossing + 1;
  if (!(std::abs(below) > 1e-9)) return std::nullopt;
  return (map(0) * crossing + map(1)) / below;
}

}  // namespace

std::vector<double> crossing_differences(const SensorModel& camera, const Target& plate,
                                         const RigidTransform& T_camera_plate, const View& view) {
  const std::vector<Eigen::Vector3d> model = plate.points();
  // The stripe's line on z = 1 from its two ends, and on the plate by the rays.
  const std::vector<Eigen::Vector3d> rays_meet =
      stripe_on_plate(camera, T_camera_plate, view.stripe);
  if (rays_meet.size() < 2) return {};
  Eigen::MatrixXd flat(static_cast<Eigen::Index>(rays_meet.size()), 2), on_plate(flat.rows(), 2);
  const RigidTransform T_plate_camera = T_camera_plate.inverse();
  for (Eigen::Index i = 0; i < flat.rows(); ++i) {
    const Eigen::Vector3d& point = rays_meet[static_cast<std::size_t>(i)];
    flat.row(i) = point.head<2>().transpose() / point.z();
    on_plate.row(i) = (T_plate_camera * point).head<2>().transpose();
  }
  const auto line_of = [](const Eigen::MatrixXd& points) {
    const Eigen::RowVector2d mean = points.colwise().mean();
    const Eigen::MatrixXd centred = points.rowwise() - mean;
    const Eigen::Matrix2d scatter = centred.transpose() * centred;
    const Eigen::Vector2d normal = direction_of_least_spread(scatter);
    return Eigen::Vector3d(normal.x(), normal.y(), -normal.dot(mean.transpose()));
  };
  const Eigen::Vector3d stripe = line_of(flat), stripe_on = line_of(on_plate);

  // The grid's points on z = 1, circles by their centres.
  const TargetInCamera<double> pose{T_camera_plate.linear(), T_camera_plate.translation()};
  std::vector<Eigen::Vector2d> seen;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const auto ray = undistorted_ray(camera, view.target[i].x(), view.target[i].y());
    if (!ray) return {};
    seen.push_back(ray->head<2>() + ellipse_centre<double>(pose, model[i], 0) -
                   ellipse_centre<double>(pose, model[i], plate.radius(static_cast<int>(i))));
  }
  std::vector<double> differences;
  for (const std::vector<int>& line : plate.lines()) {
    const auto first = static_cast<std::size_t>(line.front()),
               last = static_cast<std::size_t>(line.back());
    const Eigen::Vector2d along = (seen[last] - seen[first]).normalized();
    const Eigen::Vector3d way = (model[last] - model[first]).normalized();
    std::vector<double> s, places;
    for (const int number : line) {
      const auto i = static_cast<std::size_t>(number);
      s.push_back(along.dot(seen[i] - seen[first]));
      places.push_back(way.dot(model[i] - model[first]));
    }
    const double slope = stripe.head<2>().dot(along);
    if (std::abs(slope) < 0.2) continue;  // nearly along the stripe
    const double crossing = -(stripe.head<2>().dot(seen[first]) + stripe.z()) / slope;
    if (crossing < 0 || crossing > s.back()) continue;
    const auto place = place_on_line(s, places, crossing);
    if (!place) continue;
    const Eigen::Vector3d point = model[first] + *place * way;
    differences.push_back(stripe_on.dot(Eigen::Vector3d(point.x(), point.y(), 1)));
  }
  return differences;
}

}  // namespace arcstart::calibration
