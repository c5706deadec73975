#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>

#include "services/cell_simulator/image/laser_fan.hpp"
#include "services/cell_simulator/image/sensor_camera.hpp"
#include "tests/cell_simulator/image/scene_measures.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;
using namespace arcstart::test;
using Catch::Matchers::Contains;

TEST_CASE("the true seam is the meshes' own") {
  for (const double joint_angle : {90.0, 75.0, 105.0}) {
    for (const double gap : {0.0, 1.5}) {
      for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        SceneSettings settings = with_coarse_table();
        settings.joint_angle_deg = joint_angle;
        settings.root_gap_mm = gap;
        const Scene scene = make_scene(settings, SceneKind::workpiece, seed);
        REQUIRE(scene.seam());
        const SeamTruth& seam = *scene.seam();
        CHECK(seam.joint_type == "tee");
        const TriangleMesh &base = object(scene, "base plate").mesh,
                           &upright = object(scene, "upright plate").mesh;
        const FlatFace floor = face_towards(base, Eigen::Vector3d::UnitZ());
        const FlatFace wall = face_towards(upright, -Eigen::Vector3d::UnitY());
        CHECK((seam.normals[0] - floor.normal).norm() < 1e-9);
        CHECK((seam.normals[1] - wall.normal).norm() < 1e-9);
        for (const Eigen::Vector3d& end : {seam.start, seam.end}) {
          CHECK(std::abs(floor.normal.dot(end - floor.point)) < 1e-9);
          CHECK(std::abs(wall.normal.dot(end - wall.point)) < 1e-9);
        }
        const Eigen::Vector3d along = wall.normal.cross(floor.normal).normalized();
        CHECK(std::abs(seam.direction.cross(along).norm()) < 1e-9);
        CHECK(seam.direction.x() > 0.9);
        CHECK(seam.angle == Approx(joint_angle * degree));
        CHECK(std::acos(floor.normal.dot(wall.normal)) == Approx(std::numbers::pi - seam.angle));
        // It begins where both have begun and ends where one ends.
        const auto base_part = extent(base, seam.direction),
                   upright_part = extent(upright, seam.direction);
        CHECK(seam.direction.dot(seam.start) ==
              Approx(std::max(base_part.first, upright_part.first)));
        CHECK(seam.direction.dot(seam.end) ==
              Approx(std::min(base_part.second, upright_part.second)));
        CHECK((seam.end - seam.start).norm() > 60);
        CHECK((seam.end - seam.start).cross(seam.direction).norm() < 1e-9);
      }
    }
  }
}

TEST_CASE("seeds move, turn, tilt and size the work within their ranges and use them") {
  double widest[5] = {};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Scene scene = make_scene(with_coarse_table(), SceneKind::workpiece, seed);
    const SeamTruth& seam = *scene.seam();
    const TriangleMesh &base = object(scene, "base plate").mesh,
                       &upright = object(scene, "upright plate").mesh;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& corner : upright.corners) middle += corner / 8;
    const double yaw = std::atan2(seam.direction.y(), seam.direction.x()) / degree;
    const double tilt = std::acos(seam.normals[0].z()) / degree;
    const Eigen::Vector3d root = (seam.start + seam.end) / 2;
    const double length =
        extent(upright, seam.direction).second - extent(upright, seam.direction).first;
    CHECK(std::abs(yaw) < 15.1);
    CHECK(tilt <= 3 + 1e-9);
    CHECK(std::abs(root.x() - 950) <= 12);
    CHECK(std::abs(root.y()) <= 12);
    CHECK(std::abs(length - 100) <= 20 + 1e-9);
    CHECK(extent(base, Eigen::Vector3d::UnitZ()).first ==
          Approx(0).margin(1e-9));  // rests on the table
    const double shares[5] = {std::abs(yaw) / 15, tilt / 3, std::abs(root.x() - 950) / 12,
                              std::abs(root.y()) / 12, std::abs(length - 100) / 20};
    for (int i = 0; i < 5; ++i) widest[i] = std::max(widest[i], shares[i]);
  }
  for (const double share : widest) CHECK(share > 0.85);
}

TEST_CASE("the table is uneven within its range, and the same with and without work") {
  const Scene empty = make_scene({}, SceneKind::background, 7),
              full = make_scene({}, SceneKind::workpiece, 7);
  CHECK(empty.objects().size() == 1);
  CHECK_FALSE(empty.seam());
  const TriangleMesh& table = object(empty, "table").mesh;
  CHECK(same(table, object(full, "table").mesh));
  CHECK_FALSE(same(table, object(make_scene({}, SceneKind::background, 8), "table").mesh));
  const auto [low, high] = extent(table, Eigen::Vector3d::UnitZ());
  CHECK(low >= -0.4);
  CHECK(high <= 0.4);
  CHECK(std::max(-low, high) > 0.33);
  // It faces up, and there is table wherever the laser goes.
  for (double x = 700; x <= 1200; x += 31) {
    for (double y = -250; y <= 300; y += 29) {
      int triangle = -1;
      const double share = empty.triangles().first_hit({x, y, 10}, {x, y, -10}, &triangle);
      CHECK(std::abs(10 - 20 * share) <= 0.4);
      CHECK(empty.triangles().triangle(triangle).normal.z() > 0.9);
    }
  }
}

TEST_CASE("the same seed makes the same scene; what lies about does not move the work") {
  SceneSettings bare = with_coarse_table();
  bare.tool_lying_about = false;
  SceneSettings full = with_coarse_table();
  full.box_beside = full.box_on_base = true;
  std::set<std::string> tools;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene one = make_scene(with_coarse_table(), SceneKind::workpiece, seed),
                again = make_scene(with_coarse_table(), SceneKind::workpiece, seed);
    const Scene without = make_scene(bare, SceneKind::workpiece, seed),
                with = make_scene(full, SceneKind::workpiece, seed);
    REQUIRE(one.objects().size() == 4);
    REQUIRE(without.objects().size() == 3);
    REQUIRE(with.objects().size() == 6);
    for (std::size_t i = 0; i < 4; ++i) CHECK(same(one.objects()[i].mesh, again.objects()[i].mesh));
    for (const std::string name : {"base plate", "upright plate"}) {
      CHECK(same(object(one, name).mesh, object(without, name).mesh));
      CHECK(same(object(one, name).mesh, object(with, name).mesh));
    }
    tools.insert(one.objects()[3].name);
    // The tool touches no plate: no corner of it comes over the base plate, nor of the plate over
    // it.
    const SeamTruth& seam = *one.seam();
    const Eigen::Vector3d across = seam.normals[0].cross(seam.direction);
    const auto [begin, end] = extent(object(one, "base plate").mesh, seam.direction);
    const auto [front, back] = extent(object(one, "base plate").mesh, across);
    for (const auto& corner : one.objects()[3].mesh.corners) {
      const double u = seam.direction.dot(corner), v = across.dot(corner);
      CHECK_FALSE((u > begin && u < end && v > front && v < back));
    }
    CHECK(extent(with.objects()[3].mesh, Eigen::Vector3d::UnitZ()).second == Approx(60));
    CHECK(has(with, "box beside"));
    CHECK(has(with, "box on base"));
  }
  CHECK(tools == std::set<std::string>{"hammer", "pliers"});
}

TEST_CASE("the search passes the seam's start and sees it, whatever the seed") {
  const SensorSettings sensor_settings;
  const SceneSettings settings = with_coarse_table();
  const TrueSensor sensor = make_true_sensor(sensor_settings);
  const auto ahead_of_laser = [&](double along, const Eigen::Vector3d& point) {
    const RigidTransform T_camera_base =
        (taught_tool_pose(sensor_settings, settings, along) * sensor.T_tool_camera).inverse();
    return sensor.laser_normal.dot(T_camera_base * point) + sensor.laser_offset;
  };
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    const Scene scene = make_scene(settings, SceneKind::workpiece, seed);
    const Eigen::Vector3d& start = scene.seam()->start;
    double low = settings.search_begin_mm, high = settings.search_end_mm;
    REQUIRE(ahead_of_laser(low, start) > 1);  // at least a millimetre to go
    REQUIRE(ahead_of_laser(high, start) < -50);
    for (int i = 0; i < 40; ++i)
      (ahead_of_laser((low + high) / 2, start) > 0 ? low : high) = (low + high) / 2;
    // 1 mm behind the start and 1 mm up either plate, laser and camera both reach it.
    const RigidTransform T_base_camera =
        taught_tool_pose(sensor_settings, settings, low) * sensor.T_tool_camera;
    for (const Eigen::Vector3d& normal : scene.seam()->normals) {
      const Eigen::Vector3d point = start + scene.seam()->direction + scene.seam()->normals[0] +
                                    scene.seam()->normals[1] - (1 - 1e-3) * normal;
      CHECK_FALSE(scene.triangles().blocked(T_base_camera.translation(), point, 0, -1));
      CHECK_FALSE(scene.triangles().blocked(T_base_camera * sensor.projector, point, 0, -1));
      const auto pixel = see(sensor, T_base_camera.inverse() * point);
      REQUIRE(pixel);
      CHECK(pixel->x() > 100);
      CHECK(pixel->x() < 1500);
      CHECK(pixel->y() > 100);
      CHECK(pixel->y() < 1100);
    }
  }
}

TEST_CASE(
    "STL files stand where their poses put them; what cannot be read is refused with its name") {
  const std::string path = std::filesystem::temp_directory_path() / "arcstart_scene_test.stl";
  std::ofstream(path)
      << "solid s\nfacet normal 0 0 1\nouter loop\nvertex 10 0 0\nvertex 0 20 0\nvertex 0 0 30\n"
         "endloop\nendfacet\nendsolid s\n";
  SceneSettings settings;
  settings.stl_files = {path};
  settings.stl_poses = {1000, 200, 5, 0, 0, 90};
  const Scene scene = make_scene(settings, SceneKind::workpiece, 1);
  const TriangleMesh& mesh = object(scene, path).mesh;
  CHECK((mesh.corners[0] - Eigen::Vector3d(1000, 210, 5)).norm() < 1e-9);
  CHECK((mesh.corners[1] - Eigen::Vector3d(980, 200, 5)).norm() < 1e-9);
  CHECK((mesh.corners[2] - Eigen::Vector3d(1000, 200, 35)).norm() < 1e-9);
  CHECK(make_scene(settings, SceneKind::background, 1).objects().size() == 1);
  settings.stl_poses = {1000, 200, 5};
  CHECK_THROWS_WITH(make_scene(settings, SceneKind::workpiece, 1),
                    Contains("stl_poses") && Contains("six a file"));
  std::filesystem::remove(path);
  settings.stl_poses = {1000, 200, 5, 0, 0, 90};
  CHECK_THROWS_WITH(make_scene(settings, SceneKind::workpiece, 1),
                    Contains("stl_files") && Contains(path));
}

TEST_CASE("a ball lies on the table in the joint's place, and there is no seam") {
  SceneSettings settings = with_coarse_table();
  settings.ball_radius_mm = 20;
  const Scene scene = make_scene(settings, SceneKind::workpiece, 3);
  CHECK_FALSE(scene.seam());
  CHECK(scene.objects().size() == 2);
  const Eigen::Vector3d centre(950, 0, 20);
  for (const auto& corner : object(scene, "ball").mesh.corners)
    CHECK((corner - centre).norm() == Approx(20));
  CHECK_FALSE(has(make_scene(settings, SceneKind::background, 3), "ball"));
}
