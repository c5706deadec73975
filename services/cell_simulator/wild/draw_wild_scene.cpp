#include <algorithm>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/wild/drawing.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::cell_simulator {
namespace {

enum Purpose : std::uint64_t {
  kKind = 21,
  kWork,
  kSecondWork,
  kClutter,
  kSurroundings,
  kGround,
  kCorner
};

// A part in which the joint asked for is not to be found by anybody.
WildWork draw_wrong_work(const std::string& asked, Draw& kind, Draw& draw, bool quiet) {
  const bool fillet = asked == "tee" || asked == "inside_corner";
  const double which = kind.within(0, 1);
  if (which < 0.4) {
    WildWork work = draw_work(asked, draw, quiet);
    work.second_missing = true;
    work.beads.clear();
    work.ribs.clear();
    return work;
  }
  if (which < 0.7 && fillet) {
    WildWork work = draw_work("tee", draw, true);
    work.upside_down = true;
    return work;
  }
  return draw_work(fillet ? "butt" : "tee", draw, true);
}

// Behind the first along the search.
void place_beside(WildWork& work, const WildWork& first, Draw& draw) {
  const auto reach = [](const WildWork& w) {
    return std::max(
        {-w.first.begin.at_mm, -w.second.begin.at_mm, w.first.end.at_mm, w.second.end.at_mm});
  };
  work.yaw_deg = first.yaw_deg + draw.within(-5, 5);
  const double apart = reach(first) + reach(work) + draw.within(15, 40);
  work.position_mm[0] = first.position_mm[0] + apart;
  work.position_mm[1] = first.position_mm[1] + draw.within(-10, 10);
}

}  // namespace

WildScene draw_wild_scene(const std::string& joint, std::uint64_t seed) {
  if (std::find(wild_joints.begin(), wild_joints.end(), joint) == wild_joints.end())
    throw SceneError("joint " + joint +
                     " is none of tee, inside_corner, outside_corner, lap, butt, v");
  // The joint's name goes into the seed: the same number shows another scene of another joint.
  std::uint64_t mixed = seed * 8;
  for (std::size_t i = 0; i < wild_joints.size(); ++i)
    if (joint == wild_joints[i]) mixed += i;
  Draw kind(mixed, kKind), work(mixed, kWork), clutter(mixed, kClutter);
  Draw surroundings(mixed, kSurroundings);

  WildScene scene;
  scene.asked = joint;
  scene.seed = mixed;
  const bool quiet = kind.chance(0.27);
  const bool wrong = kind.chance(0.06), empty = wrong && kind.chance(0.25);
  if (wrong && !empty)
    scene.works.push_back(draw_wrong_work(joint, kind, work, quiet));
  else if (!empty)
    scene.works.push_back(draw_work(joint, work, quiet));
  if (!wrong && !quiet && kind.chance(0.08)) {
    Draw second(mixed, kSecondWork);
    WildWork other = draw_work(joint, second, true);
    place_beside(other, scene.works[0], second);
    scene.works.push_back(other);
  }
  Draw ground(mixed, kGround);
  Draw corner(mixed, kCorner);
  for (WildWork& one : scene.works) {
    draw_ground_bands(one, ground);
    draw_corner(one, corner);
  }
  scene.table = draw_table(surroundings);
  scene.scan = draw_scan(scene.works, surroundings);
  if (quiet) return scene;
  scene.events = draw_events(surroundings);
  if (clutter.chance(0.9)) scene.solids = draw_clutter(scene, clutter);
  return scene;
}

}  // namespace arcstart::cell_simulator
