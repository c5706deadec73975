// The laser-stripe sensor: a camera with lens distortion and a laser plane in front of it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "common/geometry.hpp"

namespace arcstart {

struct SensorModel {
  int width = 0;                          // full sensor; px
  int height = 0;                         // px
  double fx = 0, fy = 0, cx = 0, cy = 0;  // px, pixel centres at integers
  std::array<double, 5> distortion{};     // k1, k2, p1, p2, k3 (Brown; OpenCV's order)
  Plane laser_plane;                      // in camera; mm
};

// Why the numbers cannot be a sensor's (not finite, focal length not positive, laser plane through
// the camera centre or not of unit normal, distortion that folds the image); empty where they can.
std::string sensor_model_error(const SensorModel& model);

// Distorted pixel to the ray (x, y, 1) through it in camera, distortion removed by Newton's method
// to 1e-12. Nothing where the distortion has no inverse there.
std::optional<Eigen::Vector3d> undistorted_ray(const SensorModel& model, double u, double v);

// Distorted pixel to undistorted pixel: where a lens without distortion would show it.
std::optional<Eigen::Vector2d> undistorted_pixel(const SensorModel& model, double u, double v);

// Point in camera (mm, z > 0) to distorted pixel.
Eigen::Vector2d project(const SensorModel& model, const Eigen::Vector3d& point);

// Distorted pixel to the point of the laser plane it shows, in camera; mm. Nothing where the ray
// does not meet the plane in front of the camera.
std::optional<Eigen::Vector3d> camera_point(const SensorModel& model, double u, double v);

// Huynh's M (Eq. 1): undistorted pixel (u, v, 1) to homogeneous camera point, in mm. Scaled so that
// its last row is the plane's part (n_x / fx ...) as derived from n . (s K^-1 p) + d = 0.
Eigen::Matrix<double, 4, 3> pixel_to_camera(const SensorModel& model);

}  // namespace arcstart
