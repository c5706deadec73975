#include "tests/bench/seam/wild/shrink.hpp"

#include <catch2/catch.hpp>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/wild/wild_json.hpp"

using namespace arcstart;
using cell_simulator::WildScene;

namespace {

WildScene full() {
  WildScene scene;
  scene.solids.resize(3);
  scene.solids[1].kind = "cable";
  scene.works.resize(2);
  scene.works[0].beads.resize(2);
  scene.works[0].yaw_deg = 12;
  scene.works[0].second.end.cope_mm = 10;
  scene.works[0].second.end.at_mm = 40;
  scene.events.sun_grey = 20;
  return scene;
}

bool has_cable(const WildScene& scene) {
  for (const auto& solid : scene.solids)
    if (solid.kind == "cable") return true;
  return false;
}

}  // namespace

TEST_CASE("what is not needed is taken away, what is needed stays") {
  const WildScene plain = shrunk(full(), 40, [](const WildScene& scene) {
    return has_cable(scene) && scene.works[0].second.end.cope_mm > 0;
  });
  REQUIRE(plain.solids.size() == 1);
  CHECK(plain.solids[0].kind == "cable");
  CHECK(plain.works.size() == 1);
  CHECK(plain.works[0].beads.empty());
  CHECK(plain.works[0].yaw_deg == 0);
  CHECK(plain.events.sun_grey == 0);
  CHECK(plain.works[0].second.end.cope_mm == 10);
  CHECK(plain.works[0].second.end.at_mm == 40);  // where a plate ends is no ornament
}

TEST_CASE("tries are counted, and a scene that cannot be is not kept") {
  int asked = 0;
  const WildScene fewer = shrunk(full(), 2, [&](const WildScene&) { return ++asked > 0; });
  CHECK(asked == 2);
  CHECK(fewer.solids.size() == 1);
  const WildScene same = shrunk(full(), 40, [](const WildScene&) -> bool {
    throw cell_simulator::SceneError("nothing of it");
  });
  CHECK(to_json(same) == to_json(full()));
}
