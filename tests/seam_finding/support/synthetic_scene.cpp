#include <cmath>

#include "common/geometry.hpp"
#include "tests/seam_finding/support/synthetic_random.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

namespace arcstart::seam_finding::synthetic {
namespace {

Box standing_box(const Eigen::Isometry3d& frame, const Eigen::Vector3d& corner,
                 const Eigen::Vector3d& size) {
  Box box;
  box.half_size = size / 2;
  box.T_base_box = frame * Eigen::Translation3d(corner + size / 2);
  return box;
}

// Takes away what lies before a plane through a point, both in the frame of standing_box().
void cut(Box& box, const Eigen::Isometry3d& frame, const Eigen::Vector3d& point,
         const Eigen::Vector3d& normal) {
  const Eigen::Vector3d at = box.T_base_box.inverse() * (frame * point);
  box.cuts.push_back({normal.normalized(), -normal.normalized().dot(at)});
}

// The work's frame: x along the seam, which runs in the first plate's top; the open side is +y.
struct Sizes {
  double length, width, height, base, thickness, gap;
};
void add_other_joint(Scene& scene, const std::string& joint, const Eigen::Isometry3d& work,
                     const Sizes& s) {
  using Vector = Eigen::Vector3d;
  const auto at = [&](double x, double y, double z) { return Vector(x, y, z); };
  Eigen::Isometry3d top = work * Eigen::Translation3d(0, 0, s.base);  // of the first plate
  Vector second = Vector::UnitZ();
  if (joint == "inside_corner") {
    scene.boxes.push_back(
        standing_box(work, at(-5, -s.thickness, 0), {s.length, s.thickness + s.width / 2, s.base}));
    scene.boxes.push_back(
        standing_box(top, at(0, -s.thickness, 0), {s.length, s.thickness, s.height}));
    second = Vector::UnitY();
  } else if (joint == "lap") {
    scene.boxes.push_back(standing_box(work, at(-5, -s.width / 2, 0), {s.length, s.width, s.base}));
    scene.boxes.push_back(
        standing_box(top, at(0, -s.height, s.gap), {s.length, s.height, s.thickness}));
  } else if (joint == "outside_corner") {
    top = top * Eigen::Translation3d(0, 0, s.height);
    Box flat = standing_box(top, at(-5, -s.width / 2, -s.base), {s.length, s.width / 2, s.base});
    cut(flat, top, at(0, 0, 0), at(0, 1, -1));
    Box wall = standing_box(top, at(0, -s.thickness, -s.height), {s.length, s.thickness, s.height});
    cut(wall, top, at(0, 0, 0), at(0, -1, 1));
    scene.boxes.push_back(flat);
    scene.boxes.push_back(wall);
    second = Vector::UnitY();
  } else {
    const double slant = joint == "v" ? 30 * kDegree : 0, root = joint == "v" ? 1 : 0.5;
    Box near = standing_box(top, at(-5, root, -s.base), {s.length, s.width / 2, s.base});
    Box far = standing_box(top, at(0, -root - s.height, -s.base), {s.length, s.height, s.base});
    cut(near, top, at(0, root, -s.base), at(0, -std::cos(slant), std::sin(slant)));
    cut(far, top, at(0, -root, -s.base), at(0, std::cos(slant), std::sin(slant)));
    scene.boxes.push_back(near);
    scene.boxes.push_back(far);
  }
  scene.joint_type = joint == "inside_corner" ? "corner" : joint;
  scene.start = top * at(0, 0, 0);
  scene.end = top * at(s.length - 5, 0, 0);
  scene.normals[0] = work.linear() * Vector::UnitZ();
  scene.normals[1] = work.linear() * second;
}

Eigen::Isometry3d placed(double x, double y, double yaw) {
  return Eigen::Translation3d(x, y, 0) *
         Eigen::Isometry3d(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

}  // namespace

Scene make_scene(const SceneChoice& choice, std::uint64_t seed) {
  Random random{std::mt19937_64(seed * 7919 + 17)};
  Scene scene;
  const double length = random.between(80, 120), width = random.between(88, 132),
               height = random.between(36, 54);
  const double base = random.between(8, 12), thickness = random.between(6.5, 9.5);
  Eigen::Isometry3d work =
      placed(random.between(-12, 12), random.between(-12, 12), random.between(-15, 15) * kDegree);
  work = work * Eigen::AngleAxisd(random.between(-3, 3) * kDegree, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(random.between(-3, 3) * kDegree, Eigen::Vector3d::UnitY());
  work.translation().z() += 2;  // what is tilted would dip into the table
  if (choice.workpiece && choice.joint != "tee") {
    add_other_joint(scene, choice.joint, work,
                    {length, width, height, base, thickness, choice.root_gap});
  } else if (choice.workpiece) {
    const double before = choice.base_overhang;
    scene.boxes.push_back(
        standing_box(work, {-before, -width / 2, 0}, {length + 2 * before, width, base}));
    if (!choice.lone_plate) {
      // The upright's face toward +y stands on the seam; it leans by turning about it.
      const Eigen::Isometry3d foot =
          work * Eigen::Translation3d(0, 0, base) *
          Eigen::Isometry3d(
              Eigen::AngleAxisd((90 - choice.tilt_deg) * kDegree * -1, Eigen::Vector3d::UnitX()));
      scene.boxes.push_back(
          standing_box(foot, {0, -thickness, choice.root_gap}, {length, thickness, height}));
      const double first = std::max(0.0, -before), last = length + std::min(0.0, before);
      scene.start = work * Eigen::Vector3d(first, 0, base);
      scene.end = work * Eigen::Vector3d(last, 0, base);
      scene.normals[0] = work.linear() * Eigen::Vector3d::UnitZ();
      scene.normals[1] = foot.linear() * Eigen::Vector3d::UnitY();
    }
  }
  if (choice.box_on_base) {
    const Eigen::Isometry3d on_base =
        work * Eigen::Translation3d(random.between(-5, 25), random.between(4, 35), base) *
        Eigen::AngleAxisd(random.between(-40, 40) * kDegree, Eigen::Vector3d::UnitZ());
    scene.boxes.push_back(
        standing_box(on_base, {0, 0, 0},
                     {random.between(12, 25), random.between(12, 25), random.between(8, 25)}));
  }
  if (choice.tool) {  // handle and head of a hammer
    const auto lying =
        placed(random.between(0, 70), random.between(62, 75), random.between(-40, 40) * kDegree);
    scene.boxes.push_back(standing_box(lying, {0, 0, 0}, {80, 14, 14}));
    scene.boxes.push_back(standing_box(lying, {80, -20, 0}, {20, 54, 22}));
  }
  if (choice.big_box)
    scene.boxes.push_back(standing_box(
        placed(random.between(-20, 0), random.between(66, 72), random.between(-8, 8) * kDegree),
        {0, 0, 0}, {random.between(120, 150), 70, random.between(30, 45)}));
  return scene;
}

}  // namespace arcstart::seam_finding::synthetic
