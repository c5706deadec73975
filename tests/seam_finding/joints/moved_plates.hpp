// Plates side by side in scans in closed form, their boxes moved by hand.
#pragma once

#include <cmath>
#include <string>

#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

namespace arcstart::seam_finding::synthetic {

inline const ScanChoice with_bends{.bends = true};

inline SeamResult find(const Scene& scene, const ScanCloud& cloud, const std::string& joint_type,
                       int seed) {
  const auto number = static_cast<std::uint64_t>(seed);
  Scene cell = scene;
  cell.boxes.clear();
  const ScanCloud empty = make_scan(cell, with_bends, 1000 + number).cloud;
  SeamFindingSettings settings;
  settings.joint_type = joint_type;
  return find_seam(cloud, SurfaceBackground(empty, settings.background_distance()), settings,
                   number);
}
inline SeamResult find(const Scene& scene, const std::string& joint_type, int seed) {
  return find(scene, make_scan(scene, with_bends, static_cast<std::uint64_t>(seed)).cloud,
              joint_type, seed);
}

// Along the seam, across it toward the first plate, out of the metal.
struct Axes {
  explicit Axes(const Scene& scene)
      : along((scene.end - scene.start).normalized()),
        across(scene.normals[0].cross(along)),
        out(scene.normals[0]) {}
  Eigen::Vector3d along, across, out;
};

inline void move(Box& box, const Eigen::Vector3d& by) {
  box.T_base_box = Eigen::Translation3d(by) * box.T_base_box;
}

inline Scene scene_of(const std::string& joint, int seed) {
  return make_scene({.joint = joint}, static_cast<std::uint64_t>(seed));
}

// A butt joint whose gap is closed by so much of its 1 mm and whose second plate is raised.
inline Scene stepped_butt(int seed, double closed_mm, double raised_mm) {
  Scene scene = scene_of("butt", seed);
  const Axes axes(scene);
  move(scene.boxes[0], -closed_mm / 2 * axes.across);
  move(scene.boxes[1], closed_mm / 2 * axes.across + raised_mm * axes.out);
  return scene;
}

// A lap whose upper plate is a thin sheet that begins later; the truth begins with it.
inline Scene thin_lap(int seed, double thickness_mm, double later_mm) {
  Scene scene = scene_of("lap", seed);
  const Axes axes(scene);
  Box& upper = scene.boxes[1];
  move(upper, (thickness_mm / 2 - upper.half_size.z()) * axes.out + later_mm * axes.along);
  upper.half_size.z() = thickness_mm / 2;
  scene.start += later_mm * axes.along;
  return scene;
}

inline double deviation(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& direction) {
  return std::sqrt(direction.dot(covariance * direction));
}

}  // namespace arcstart::seam_finding::synthetic
