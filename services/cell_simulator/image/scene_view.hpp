// A scene seen by the sensor in one pose: where the lit lines come to lie in the image, and what of
// them is hidden.
#pragma once

#include <optional>
#include <vector>

#include "services/cell_simulator/image/laser_fan.hpp"
#include "services/cell_simulator/image/sensor_camera.hpp"
#include "services/cell_simulator/scene/scene.hpp"

namespace arcstart::cell_simulator {

class SceneView {
 public:
  // Scene and sensor must outlive the view.
  SceneView(const Scene& scene, const TrueSensor& sensor, const RigidTransform& T_base_tool);

  // The laser's sheet in base, moved by `offset` mm along its normal.
  LightSheet sheet(double offset) const;

  // Distorted pixel of a point in base, as see() has it.
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& point) const;

  // A point of a lit line and whether the camera sees it.
  struct Point {
    Eigen::Vector3d base;
    Eigen::Vector2d pixel;
    bool visible;
  };
  // The part of the line in or near the image, in points at most `step_px` apart; none where it is
  // not there.
  std::vector<Point> follow(const LitLine& line, double step_px) const;

  // The point where the line gets out of sight between two neighbours of unlike visibility, within
  // 0.4 % of their distance.
  Point edge_of_sight(const Point& one, const Point& other, const LitLine& line) const;

 private:
  bool faces(const LitLine& line) const;
  bool free(const Eigen::Vector3d& point, int triangle) const;

  const Scene& scene_;
  const TrueSensor& sensor_;
  RigidTransform T_base_camera_, T_camera_base_;
};

}  // namespace arcstart::cell_simulator
