#include "services/cell_simulator/wild/wild_json.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "services/cell_simulator/wild/wild_build.hpp"

namespace arcstart::cell_simulator {

TEST_CASE("A scene written and read back is the same, triangle by triangle") {
  for (const char* joint : wild_joints)
    for (const std::uint64_t seed : {3u, 4u, 7u}) {
      CAPTURE(joint, seed);
      const WildScene scene = draw_wild_scene(joint, seed);
      const WildScene again = wild_scene_from_json(to_json(scene));
      CHECK(to_json(again) == to_json(scene));
      const Scene one = build(scene, SceneKind::workpiece),
                  other = build(again, SceneKind::workpiece);
      REQUIRE(one.objects().size() == other.objects().size());
      for (std::size_t i = 0; i < one.objects().size(); ++i)
        CHECK(one.objects()[i].mesh.corners == other.objects()[i].mesh.corners);
    }
}

TEST_CASE("What a scene's file leaves out is plain, what it makes up is refused") {
  const WildScene scene =
      wild_scene_from_json(R"({"asked": "lap", "works": [{"joint": "lap", "yaw_deg": 5}]})");
  CHECK(scene.works.at(0).yaw_deg == 5);
  CHECK(scene.works.at(0).first.thickness_mm == WildPlate{}.thickness_mm);
  CHECK(scene.scan.pitch_mm == WildScanGeometry{}.pitch_mm);
  CHECK_THROWS_WITH(wild_scene_from_json(R"({"works": [{"jaw_deg": 5}]})"),
                    Catch::Contains("works.0.jaw_deg"));
  CHECK_THROWS_AS(wild_scene_from_json("{"), SceneError);
  CHECK_THROWS_AS(wild_scene_from_json(R"({"seed": "many"})"), SceneError);
}

TEST_CASE("Any element of a scene's lists may be taken away") {
  int taken = 0;
  for (const char* joint : wild_joints)
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto whole = nlohmann::json::parse(to_json(draw_wild_scene(joint, seed)));
      const auto without = [&](const char* way) {
        const nlohmann::json::json_pointer pointer(way);
        if (!whole.contains(pointer)) return;
        for (std::size_t i = 0; i < whole.at(pointer).size(); ++i) {
          nlohmann::json less = whole;
          less.at(pointer).erase(i);
          const WildScene scene = wild_scene_from_json(less.dump());
          CHECK_NOTHROW(build(scene, SceneKind::workpiece));
          ++taken;
        }
      };
      for (const char* way :
           {"/works", "/solids", "/works/0/beads", "/works/0/ribs", "/works/0/tabs",
            "/works/0/first/holes", "/works/0/second/holes", "/works/0/second/notches"})
        without(way);
    }
  CHECK(taken > 100);
}

}  // namespace arcstart::cell_simulator
