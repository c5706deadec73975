// The joints beside the Tee: their true seams are where the meshes say.
#include <catch2/catch.hpp>

#include "tests/cell_simulator/image/scene_measures.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;
using namespace arcstart::test;

TEST_CASE("the true seams of the other joints are the meshes' own") {
  for (const std::string joint : {"outside_corner", "lap", "butt", "v"})
    for (const double gap : {0.0, 1.5})
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        SceneSettings settings = with_coarse_table();
        settings.joint = joint;
        settings.root_gap_mm = gap;
        const Scene scene = make_scene(settings, SceneKind::workpiece, seed);
        const SeamTruth& seam = *scene.seam();
        INFO(joint << ", gap " << gap << ", seed " << seed);
        CHECK(seam.joint_type == joint);
        const TriangleMesh &first = scene.objects()[1].mesh, &second = scene.objects()[2].mesh;
        const Eigen::Vector3d up = seam.normals[0], across = up.cross(seam.direction);
        const Eigen::Vector3d middle = (seam.start + seam.end) / 2;
        const auto lies = [&](const TriangleMesh& mesh, const Eigen::Vector3d& way) {
          const auto [low, high] = extent(mesh, way);
          return std::pair(low - way.dot(middle), high - way.dot(middle));
        };
        // The seam lies in the first plate's top, which is its highest part.
        CHECK((face_towards(first, up).normal - up).norm() < 1e-9);
        CHECK(lies(first, up).second == Approx(0).margin(1e-9));
        if (joint == "outside_corner") {
          CHECK(lies(first, across).first == Approx(0).margin(1e-9));
          CHECK(lies(second, across).first == Approx(0).margin(1e-9));
          CHECK(lies(second, up).second == Approx(-gap).margin(1e-9));
          const Eigen::Vector3d mitre = (across + up) / std::sqrt(2);
          CHECK(lies(second, mitre).second == Approx(-gap / std::sqrt(2)).margin(1e-9));
          CHECK((seam.normals[1] + across).norm() < 1e-9);
          CHECK(seam.angle == Approx(270 * degree));
        } else if (joint == "lap") {
          CHECK(lies(second, across).first == Approx(0).margin(1e-9));
          CHECK(lies(second, up).first == Approx(gap).margin(1e-9));
          CHECK(lies(first, across).first < -30);
          CHECK(seam.angle == Approx(180 * degree));
        } else {  // in the middle of the gap, on either side half of it
          CHECK(lies(first, across).second == Approx(-gap / 2).margin(1e-9));
          CHECK(lies(second, across).first == Approx(gap / 2).margin(1e-9));
          CHECK(lies(second, up).second == Approx(0).margin(1e-9));
          CHECK(lies(second, up).first == Approx(lies(first, up).first).margin(1e-9));
          CHECK(seam.angle == Approx((joint == "v" ? 60 : 180) * degree));
          if (joint == "v") {
            const FlatFace slant = face_towards(first, across + 0.5 * up);
            CHECK(std::acos(slant.normal.dot(across)) == Approx(30 * degree));
          }
        }
        // It begins where both have begun and ends where one ends.
        CHECK(std::max(lies(first, seam.direction).first, lies(second, seam.direction).first) ==
              Approx(seam.direction.dot(seam.start - middle)));
        CHECK(std::min(lies(first, seam.direction).second, lies(second, seam.direction).second) ==
              Approx(seam.direction.dot(seam.end - middle)));
        for (const TriangleMesh* mesh : {&first, &second})
          CHECK(extent(*mesh, Eigen::Vector3d::UnitZ()).first > -1e-9);  // on the table
      }
}
