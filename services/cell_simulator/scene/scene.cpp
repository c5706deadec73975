#include "services/cell_simulator/scene/scene.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>

#include "services/cell_simulator/scene/scene_parts.hpp"
#include "services/cell_simulator/scene/stl.hpp"

namespace arcstart::cell_simulator {
namespace {

std::vector<const TriangleMesh*> meshes_of(const std::vector<SceneObject>& objects) {
  std::vector<const TriangleMesh*> meshes;
  for (const SceneObject& object : objects) meshes.push_back(&object.mesh);
  return meshes;
}

std::vector<SceneObject> read_stl_files(const SceneSettings& settings) {
  const Surface steel{0.45, 0.08, 1, 0.1, 0.01};
  const auto& poses = settings.stl_poses;
  if (poses.size() != 6 * settings.stl_files.size())
    throw SceneError(
        fmt::format("stl_poses: {} numbers for {} STL files; give six a file: x, y, z mm, turns "
                    "about x, y, z deg",
                    poses.size(), settings.stl_files.size()));
  std::vector<SceneObject> objects;
  for (std::size_t i = 0; i < settings.stl_files.size(); ++i) {
    const double* pose = &poses[6 * i];
    RigidTransform transform = RigidTransform::Identity();
    transform.translation() = Eigen::Vector3d(pose[0], pose[1], pose[2]);
    transform.linear() = turn(pose[5], Eigen::Vector3d::UnitZ()) *
                         turn(pose[4], Eigen::Vector3d::UnitY()) *
                         turn(pose[3], Eigen::Vector3d::UnitX());
    try {
      objects.push_back(
          {settings.stl_files[i], transformed(read_stl(settings.stl_files[i]), transform), steel});
    } catch (const StlError& error) {
      throw SceneError(fmt::format("stl_files: {}", error.what()));
    }
  }
  return objects;
}

}  // namespace

Eigen::Matrix3d turn(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(degrees * EIGEN_PI / 180, axis).toRotationMatrix();
}

Scene::Scene(std::vector<SceneObject> objects, std::optional<SeamTruth> seam)
    : objects_(std::move(objects)), seam_(std::move(seam)), triangles_(meshes_of(objects_)) {}

Scene make_scene(const SceneSettings& settings, SceneKind kind, std::uint64_t seed) {
  std::vector<SceneObject> objects{make_table(settings, seed)};
  if (kind == SceneKind::background) return Scene(std::move(objects));
  if (settings.ball_radius_mm > 0) {
    objects.push_back(make_ball(settings));
    return Scene(std::move(objects));
  }
  Work work = make_work(settings, seed);
  const std::vector<SceneObject> clutter = make_clutter(settings, work, seed),
                                 read = read_stl_files(settings);
  objects.push_back(std::move(work.first_plate));
  objects.push_back(std::move(work.second_plate));
  objects.insert(objects.end(), clutter.begin(), clutter.end());
  objects.insert(objects.end(), read.begin(), read.end());
  return Scene(std::move(objects), work.seam);
}

}  // namespace arcstart::cell_simulator
