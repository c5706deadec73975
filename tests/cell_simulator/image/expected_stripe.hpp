// A flat floor, and what the sensor should show of it by ways other than the renderer's.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "services/cell_simulator/image/image_renderer.hpp"

namespace arcstart::test {

using namespace cell_simulator;

// A flat square under the taught work, tilted about x and y by these slopes.
struct Floor {
  double slope_x, slope_y, height;
  Surface surface{0.4, 0, 1, 0, 0};
  double z(double x, double y) const { return height + slope_x * (x - 950) + slope_y * y; }
  SceneObject object() const {
    TriangleMesh mesh;
    for (const auto& [x, y] :
         {std::pair(550.0, -400.0), {1350.0, -400.0}, {1350.0, 400.0}, {550.0, 400.0}})
      mesh.corners.emplace_back(x, y, z(x, y));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return {"floor", mesh, surface};
  }
};

// What the sensor should show of a floor, by ways of its own: the line in which the laser's plane,
// moved by `offset` mm, cuts the floor, projected by OpenCV.
class Expected {
 public:
  Expected(const SensorSettings& settings, const TrueSensor& sensor,
           const RigidTransform& T_base_tool, const Floor& floor)
      : distortion_(settings.distortion),
        camera_matrix_(sensor.fx, 0, sensor.cx, 0, sensor.fy, sensor.cy, 0, 0, 1) {
    const RigidTransform T_base_camera = T_base_tool * sensor.T_tool_camera;
    T_camera_base_ = T_base_camera.inverse();
    laser_ = T_base_camera.linear() * sensor.laser_normal;
    laser_point_ = T_base_camera * Eigen::Vector3d(0, 0, settings.stand_off_mm);
    floor_ = Eigen::Vector3d(-floor.slope_x, -floor.slope_y, 1).normalized();
    floor_point_ = {950, 0, floor.height};
    projector_ = T_base_camera * sensor.projector;
  }
  // v at u = 0, 1, 2 ... of the stripe's middle.
  std::vector<double> columns(int width, double offset = 0) const {
    const Eigen::Vector3d along = laser_.cross(floor_).normalized();
    Eigen::Matrix<double, 3, 3> planes;
    planes << laser_.transpose(), floor_.transpose(), along.transpose();
    const Eigen::Vector3d middle =
        planes.inverse() * Eigen::Vector3d(laser_.dot(laser_point_) + offset,
                                           floor_.dot(floor_point_), along.dot(floor_point_));
    std::vector<cv::Point3d> points;
    for (double t = -250; t <= 250; t += 0.05) {
      const Eigen::Vector3d p = T_camera_base_ * (middle + t * along);
      points.emplace_back(p.x(), p.y(), p.z());
    }
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), camera_matrix_, distortion_, pixels);
    if (pixels.front().x > pixels.back().x) std::reverse(pixels.begin(), pixels.end());
    std::vector<double> result;
    std::size_t at = 0;
    for (int u = 0; u < width; ++u) {
      while (pixels[at + 1].x < u) ++at;
      const double share = (u - pixels[at].x) / (pixels[at + 1].x - pixels[at].x);
      result.push_back(pixels[at].y + share * (pixels[at + 1].y - pixels[at].y));
    }
    return result;
  }
  // The floor's point that a pixel shows.
  Eigen::Vector3d floor_point(double u, double v) const {
    std::vector<cv::Point2d> rays;
    cv::undistortPoints(std::vector<cv::Point2d>{{u, v}}, rays, camera_matrix_, distortion_,
                        cv::noArray(), cv::noArray(),
                        cv::TermCriteria(cv::TermCriteria::COUNT, 50, 0));
    const RigidTransform T_base_camera = T_camera_base_.inverse();
    const Eigen::Vector3d camera = T_base_camera.translation();
    const Eigen::Vector3d ray = T_base_camera.linear() * Eigen::Vector3d(rays[0].x, rays[0].y, 1);
    return camera + ray * floor_.dot(floor_point_ - camera) / floor_.dot(ray);
  }
  const Eigen::Vector3d& floor_normal() const { return floor_; }
  const Eigen::Vector3d& projector() const { return projector_; }
  const Eigen::Vector3d& target() const { return laser_point_; }
  cv::Point2d pixel(const Eigen::Vector3d& base) const {
    const Eigen::Vector3d p = T_camera_base_ * base;
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(),
                      camera_matrix_, distortion_, pixels);
    return pixels[0];
  }

 private:
  std::array<double, 5> distortion_;
  cv::Matx33d camera_matrix_;
  RigidTransform T_camera_base_;
  Eigen::Vector3d laser_, laser_point_, floor_, floor_point_, projector_;
};

}  // namespace arcstart::test
