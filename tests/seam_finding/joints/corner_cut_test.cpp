// Outside corners whose lying plate is longer than the standing one: its cut goes on in the
// standing one's face.
#include <catch2/catch.hpp>

#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/referee/ruling.hpp"
#include "tests/draws.hpp"
#include "tests/seam_finding/joints/moved_plates.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

// The lying plate on top of the standing one, not mitred, and so much longer at the start.
Scene cut_in_face(int seed, double longer_mm) {
  Scene scene = scene_of("outside_corner", seed);
  Box& lying = scene.boxes[0];
  lying.cuts.clear();
  lying.half_size.x() += longer_mm / 2;
  move(lying, -longer_mm / 2 * Axes(scene).along);
  return scene;
}

}  // namespace

TEST_CASE("outside a corner the lying plate's cut does not make the standing one longer") {
  constexpr double longer = 15;  // and 5 that it is longer anyhow
  constexpr int seeds = test::draws(8);
  int near = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Scene scene = cut_in_face(seed, longer);
    const ScanCloud cloud = make_scan(scene, with_bends, static_cast<std::uint64_t>(seed)).cloud;
    SeamResult result = find(scene, cloud, "outside_corner", seed);
    INFO("seed " << seed << ": " << in_words(result.reason));
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    rule(examine(cloud, result), result);
    const Axes axes(scene);
    const double off = std::abs(axes.along.dot(result.start - scene.start));
    // Never sure of a place where the cut alone goes on.
    const bool sure = result.start_visibility == EndVisibility::kSeen;
    CHECK((!sure || off < std::max(1.0, 3 * deviation(result.accuracy->start, axes.along))));
    near += off < longer / 3;
  }
  CHECK(near >= seeds / 2);
}
