#include "services/cell_simulator/wild/wild_build.hpp"

#include <Eigen/Geometry>

#include "services/cell_simulator/wild/solid_shapes.hpp"
#include "services/cell_simulator/wild/wild_table.hpp"
#include "services/cell_simulator/wild/work_form.hpp"

namespace arcstart::cell_simulator {
namespace {

Surface rendered(const WildSurface& surface) {
  return {surface.albedo, surface.mottling, 1, surface.specular_share, surface.gloss_spread_rad};
}

bool stands(const WildSolid& solid, SceneKind kind) {
  return kind == SceneKind::background ? solid.with_background : solid.with_work;
}

bool may_answer(const WildScene& wild, const WildSeam& seam) {
  // Seen from inside, a corner is a tee.
  const bool fillet = wild.asked == "tee" || wild.asked == "inside_corner";
  if (fillet) return seam.joint_type == "tee" || seam.joint_type == "corner";
  return seam.joint_type == wild.asked;
}

std::optional<SeamTruth> first_seam(const WildTruth& truth) {
  if (truth.seams.empty()) return {};
  const WildSeam& seam = truth.seams[0];
  return SeamTruth{seam.joint_type, seam.start.point, seam.end.point,
                   seam.direction,  seam.normals,     seam.angle};
}

// Objects of the scene in their order: their names, meshes, surfaces and bands.
template <class Add>
void for_each_object(const WildScene& wild, SceneKind kind, Add&& add) {
  add(
      "table", [&] { return make_wild_table(wild); }, wild.table.surface, std::nullopt);
  if (kind == SceneKind::workpiece)
    for (const WildWork& work : wild.works)
      for (WorkPart& part : parts_of(work))
        add(
            part.name, [&] { return std::move(part.mesh); }, part.surface, part.band);
  for (const WildSolid& solid : wild.solids)
    if (stands(solid, kind))
      add(
          solid.kind, [&] { return mesh_of(solid); }, solid.surface, std::nullopt);
}

}  // namespace

Scene build(const WildScene& wild, SceneKind kind) {
  std::vector<SceneObject> objects;
  for_each_object(wild, kind,
                  [&](const std::string& name, auto mesh, const WildSurface& surface,
                      const std::optional<WorkBand>& band) {
                    objects.push_back({name, mesh(), rendered(surface)});
                    if (band)
                      objects.back().band = SurfaceBand{band->middle, band->across,
                                                        band->half_width, rendered(band->surface)};
                  });
  if (kind == SceneKind::background) return Scene(std::move(objects));
  return Scene(std::move(objects), first_seam(truth_of(wild)));
}

std::vector<WildSurface> surfaces_of(const WildScene& wild, SceneKind kind) {
  std::vector<WildSurface> surfaces, bands;
  for_each_object(wild, kind,
                  [&](const std::string&, auto, const WildSurface& surface,
                      const std::optional<WorkBand>& band) {
                    surfaces.push_back(surface);
                    bands.push_back(band ? band->surface : surface);
                  });
  surfaces.insert(surfaces.end(), bands.begin(), bands.end());
  return surfaces;
}

WildTruth truth_of(const WildScene& wild) {
  WildTruth truth;
  int first = 1;  // object, behind the table
  for (const WildWork& work : wild.works) {
    for (WildSeam& seam : seams_of(work)) {
      for (int& object : seam.objects) object += first;
      if (may_answer(wild, seam)) truth.seams.push_back(std::move(seam));
    }
    first += static_cast<int>(1 + (work.second_missing ? 0 : 1) + work.ribs.size() +
                              work.tabs.size() + work.beads.size());
  }
  truth.wrong = truth.seams.empty();
  return truth;
}

std::optional<Scene> on_tool(const WildScene& wild) {
  const WildEvents& events = wild.events;
  if (events.wire_radius_mm <= 0) return {};
  constexpr double wire_mm = 15, nozzle_mm = 60, nozzle_radius_mm = 8;
  // From the tip back past the camera, on the side where the laser's sheet is.
  const Eigen::Vector3d back = Eigen::Vector3d(0, 0.5, -1).normalized();
  RigidTransform T_camera_wire = RigidTransform::Identity();
  T_camera_wire.translation() = Eigen::Vector3d(events.wire_in_camera_mm.data());
  T_camera_wire.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), back).toRotationMatrix();
  TriangleMesh mesh = make_prism(24, events.wire_radius_mm, 0, wire_mm);
  append(mesh, make_prism(48, nozzle_radius_mm, wire_mm, wire_mm + nozzle_mm));
  return Scene({{"nozzle", transformed(mesh, T_camera_wire), {0.5, 0.05, 1, 0.2, 0.01}}});
}

Scene in_frame(const Scene& scene, const Scene* carried, const RigidTransform& T_base_camera,
               const Eigen::Vector3d& shaken_mm) {
  std::vector<SceneObject> objects = scene.objects();
  for (std::size_t i = 1; i < objects.size(); ++i) {
    for (Eigen::Vector3d& corner : objects[i].mesh.corners) corner += shaken_mm;
    if (objects[i].band) objects[i].band->middle += shaken_mm;
  }
  if (carried)
    for (SceneObject object : carried->objects()) {
      object.mesh = transformed(object.mesh, T_base_camera);
      objects.push_back(std::move(object));
    }
  return Scene(std::move(objects), scene.seam());
}

SensorSettings sensor_of(const WildScene& wild, SensorSettings sensor) {
  sensor.lean_deg = wild.scan.lean_deg;
  sensor.ambient_grey += wild.events.sun_grey;
  sensor.arc_grey = wild.events.arc_grey;
  if (wild.events.arc_grey > 0) sensor.spatter_streaks = 8;
  return sensor;
}

SceneSettings taught_scene_of(const WildScene& wild, SceneSettings scene) {
  scene.search_begin_mm = wild.scan.begin_mm;
  scene.search_end_mm = wild.scan.end_mm;
  // taught_tool_pose() looks at a base plate's top.
  scene.work_position_mm[2] = 0;
  scene.base_plate_mm[2] = wild.scan.taught_height_mm;
  return scene;
}

}  // namespace arcstart::cell_simulator
