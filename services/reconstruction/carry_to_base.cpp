#include "services/reconstruction/carry_to_base.hpp"

#include <algorithm>
#include <optional>

namespace arcstart::reconstruction {
namespace {

// Unit direction across the stripe in the image, from the neighbours in the segment. Nothing for a
// lone centre.
std::optional<Eigen::Vector2d> across(const std::vector<ReceivedCentre>& centres, std::size_t i) {
  const auto same_segment = [&](std::size_t k) {
    return k < centres.size() && centres[k].segment == centres[i].segment;
  };
  const ReceivedCentre& before = centres[i > 0 && same_segment(i - 1) ? i - 1 : i];
  const ReceivedCentre& after = centres[same_segment(i + 1) ? i + 1 : i];
  const Eigen::Vector2d along(after.u - before.u, after.v - before.v);
  const double length = along.norm();
  if (!(length > 0)) return std::nullopt;
  return Eigen::Vector2d(-along.y(), along.x()) / length;
}

// How far the point moves when its centre moves by one standard deviation that way: half the way
// between the points to either side. mm; nothing where one of them does not exist.
std::optional<double> deviation_along(const SensorModel& model, const ReceivedCentre& centre,
                                      const Eigen::Vector2d& direction) {
  const Eigen::Vector2d step = centre.deviation * direction;
  const auto one = camera_point(model, centre.u - step.x(), centre.v - step.y());
  const auto other = camera_point(model, centre.u + step.x(), centre.v + step.y());
  if (!one || !other) return std::nullopt;
  return (*other - *one).norm() / 2;
}

// Across the stripe; where its direction is not known, in the worse of the image's two.
std::optional<double> deviation_in_space(const SensorModel& model, const ReceivedCentre& centre,
                                         const std::optional<Eigen::Vector2d>& direction) {
  if (direction) return deviation_along(model, centre, *direction);
  const auto by_column = deviation_along(model, centre, Eigen::Vector2d::UnitX());
  const auto by_row = deviation_along(model, centre, Eigen::Vector2d::UnitY());
  if (!by_column || !by_row) return std::nullopt;
  return std::max(*by_column, *by_row);
}

}  // namespace

std::vector<ProfilePoint> carry_to_base(const std::vector<ReceivedCentre>& centres,
                                        const Calibration& calibration,
                                        const RigidTransform& T_base_tool,
                                        const WorkingRange& range) {
  const SensorModel& model = calibration.sensor_model;
  const RigidTransform T_base_camera = T_base_tool * calibration.T_tool_camera;
  std::vector<ProfilePoint> points;
  points.reserve(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const ReceivedCentre& centre = centres[i];
    const auto point = camera_point(model, centre.u, centre.v);
    if (!point || point->z() < range.nearest || point->z() > range.farthest) continue;
    double deviation = 0;
    if (centre.deviation > 0) {
      const auto moved = deviation_in_space(model, centre, across(centres, i));
      if (!moved) continue;
      deviation = *moved;
    }
    points.push_back({T_base_camera * *point, centre, deviation});
  }
  return points;
}

}  // namespace arcstart::reconstruction
