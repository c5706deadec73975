#include "services/cell_simulator/image/scene_view.hpp"

#include <cmath>

#include "services/cell_simulator/base/interval.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr double clearance_mm = 0.02;  // what is nearer to a lit point than this does not hide it
constexpr double margin =
    1.2;  // how much of the plane beside the image is looked at; 1 for nothing

}  // namespace

SceneView::SceneView(const Scene& scene, const TrueSensor& sensor,
                     const RigidTransform& T_base_tool)
    : scene_(scene),
      sensor_(sensor),
      T_base_camera_(T_base_tool * sensor.T_tool_camera),
      T_camera_base_(T_base_camera_.inverse()) {}

LightSheet SceneView::sheet(double offset) const {
  const Eigen::Vector3d normal = T_base_camera_.linear() * sensor_.laser_normal;
  return {T_base_camera_ * sensor_.projector + offset * normal, normal,
          T_base_camera_.linear() * sensor_.fan_direction, sensor_.fan_half_angle};
}

std::optional<Eigen::Vector2d> SceneView::pixel(const Eigen::Vector3d& point) const {
  return see(sensor_, T_camera_base_ * point);
}

std::vector<SceneView::Point> SceneView::follow(const LitLine& line, double step_px) const {
  const Eigen::Vector3d a = T_camera_base_ * line.begin, b = T_camera_base_ * line.end;
  const double half_x = margin * 0.5 * sensor_.width / sensor_.fx,
               half_y = margin * 0.5 * sensor_.height / sensor_.fy;
  Interval part;
  part.keep(a.z() - 1, b.z() - 1);
  part.keep(half_x * a.z() - a.x(), half_x * b.z() - b.x());
  part.keep(half_x * a.z() + a.x(), half_x * b.z() + b.x());
  part.keep(half_y * a.z() - a.y(), half_y * b.z() - b.y());
  part.keep(half_y * a.z() + a.y(), half_y * b.z() + b.y());
  if (part.empty()) return {};
  const auto at = [&](double share) -> Eigen::Vector3d {
    return line.begin + share * (line.end - line.begin);
  };
  const auto first = pixel(at(part.begin)), last = pixel(at(part.end));
  if (!first || !last) return {};

  const bool lit_side = faces(line);
  const int pieces = 1 + static_cast<int>((*last - *first).norm() / step_px);
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(pieces) + 1);
  for (int i = 0; i <= pieces; ++i) {
    const Eigen::Vector3d base = at(part.begin + (part.end - part.begin) * i / pieces);
    const auto seen = pixel(base);
    if (!seen) return {};
    points.push_back({base, *seen, lit_side && free(base, line.triangle)});
  }
  return points;
}

SceneView::Point SceneView::edge_of_sight(const Point& one, const Point& other,
                                          const LitLine& line) const {
  Eigen::Vector3d seen = one.visible ? one.base : other.base,
                  hidden = one.visible ? other.base : one.base;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d middle = (seen + hidden) / 2;
    (free(middle, line.triangle) ? seen : hidden) = middle;
  }
  return {seen, pixel(seen).value_or(one.pixel), true};
}

// From the side from which the light comes.
bool SceneView::faces(const LitLine& line) const {
  const Triangle& triangle = scene_.triangles().triangle(line.triangle);
  const double light = triangle.normal.dot(line.source - triangle.a);
  return light * triangle.normal.dot(T_base_camera_.translation() - triangle.a) > 0;
}

bool SceneView::free(const Eigen::Vector3d& point, int triangle) const {
  return !scene_.triangles().blocked(T_base_camera_.translation(), point, clearance_mm, triangle);
}

}  // namespace arcstart::cell_simulator
