// Plates side by side at unlike heights, thin laps and run-off tabs, in scans in closed form. The
// truth is that of a plain scene whose boxes are moved by hand.
#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/cloud/scales.hpp"
#include "services/seam_finding/joints/parallel_joints.hpp"
#include "tests/draws.hpp"
#include "tests/seam_finding/joints/moved_plates.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;
using Eigen::Vector3d;

namespace {

constexpr int seeds = test::draws(5);

}  // namespace

TEST_CASE("plates side by side at unlike heights are parted, though one plane lies near both",
          "[figures]") {
  const double raised = GENERATE(-0.7, -0.4, 0.4, 0.7);
  int right = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Scene scene = stepped_butt(seed, 0, raised);
    const SeamResult result = find(scene, "butt", seed);
    if (result.verdict != SeamResult::Verdict::kFound) continue;
    const Axes axes(scene);
    right += std::abs(axes.across.dot(result.start - scene.start)) < 0.4 &&
             std::abs(axes.across.dot(result.end - scene.end)) < 0.4 &&
             std::abs(axes.along.dot(result.start - scene.start)) < 3 &&
             std::abs(axes.along.dot(result.end - scene.end)) < 3;
  }
  INFO("raised by " << raised << " mm");
  CHECK(right == seeds);
}

TEST_CASE(
    "a joint is whole though its faces were laid out as a plate with half of the other, and the "
    "rest") {
  const Scene scene = stepped_butt(1, 0, 0);
  const Axes axes(scene);
  const ScanCloud cloud = make_scan(scene, with_bends, 1).cloud;
  const double length = (scene.end - scene.start).norm();
  const Plane top{axes.out, -axes.out.dot(scene.start)};
  std::vector<Face> faces(2);
  for (int i = 0; i < cloud.size(); ++i) {
    const Vector3d from_start = cloud.points[i] - scene.start;
    const double along = axes.along.dot(from_start), across = axes.across.dot(from_start);
    if (std::abs(top.signed_distance(cloud.points[i])) > 0.5 || along < -5 || along > length + 5)
      continue;
    faces[across > 0 || along < length / 2 ? 0 : 1].points.push_back(i);
  }
  for (Face& face : faces) face.plane = top;
  SeamFindingSettings settings;
  settings.joint_type = "butt";
  const Scales scales = scales_of(cloud, measure_sampling(cloud), 0);
  double longest = 0;
  for (const Joint& joint : find_parallel_joints(cloud, faces, scales, settings))
    if (!joint.flaw) longest = std::max(longest, joint.coverage.covered);
  CHECK(longest > 0.9 * length);
}

TEST_CASE("a lap of thin sheet is a lap where one is asked for, and begins with the sheet") {
  const double thickness = GENERATE(0.8, 1.2);
  for (int seed = 1; seed <= seeds; ++seed) {
    const Scene scene = thin_lap(seed, thickness, 15);
    const SeamResult result = find(scene, "lap", seed);
    INFO("seed " << seed << ", " << thickness << " mm: " << in_words(result.reason));
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    CHECK(result.joint_type == "lap");
    CHECK(result.thickness == Approx(thickness).margin(0.25));
    CHECK(std::abs(Axes(scene).along.dot(result.start - scene.start)) < 3);
    CHECK(std::abs(Axes(scene).across.dot(result.start - scene.start)) < 0.4);
  }
}

TEST_CASE("plates whose tops differ by less than 1 mm are a butt joint where one is asked for",
          "[figures]") {
  for (const double raised : {-0.85, 0.85})
    for (int seed = 1; seed <= seeds; ++seed) {
      const SeamResult result = find(stepped_butt(seed, 0, raised), "butt", seed);
      INFO("seed " << seed << ", raised by " << raised << " mm: " << in_words(result.reason));
      REQUIRE(result.verdict == SeamResult::Verdict::kFound);
      CHECK(result.joint_type == "butt");
    }
}

TEST_CASE("a lap of thin sheet is no butt joint", "[figures]") {
  for (const double thickness : {1.2, 2.0})
    for (int seed = 1; seed <= seeds; ++seed) {
      INFO("seed " << seed << ", " << thickness << " mm");
      CHECK(find(thin_lap(seed, thickness, 0), "butt", seed).verdict !=
            SeamResult::Verdict::kFound);
    }
}

TEST_CASE("beside a step the seam's deviation across covers what the higher edge hides",
          "[figures]") {
  // The edges touch: where the truth is, the higher plate's edge is seen, the lower one's is not.
  const double raised = GENERATE(-0.85, 0.85);
  for (int seed = 1; seed <= seeds; ++seed) {
    const Scene scene = stepped_butt(seed, 1, raised);
    const SeamResult result = find(scene, "butt", seed);
    INFO("seed " << seed << ", raised by " << raised << " mm: " << in_words(result.reason));
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    REQUIRE(result.accuracy);
    const Vector3d across = Axes(scene).across;
    const double start = across.dot(result.start - scene.start),
                 end = across.dot(result.end - scene.end);
    CHECK(std::abs(start) < 0.8);
    CHECK(std::abs(end) < 0.8);
    CHECK(std::abs(start) < 3 * deviation(result.accuracy->start, across));
    CHECK(std::abs(end) < 3 * deviation(result.accuracy->end, across));
    CHECK(deviation(result.accuracy->start, across) < 0.5);
  }
}

TEST_CASE("a groove ends where a run-off tab begins") {
  constexpr double length_mm = 25, half_width_mm = 22, thickness_mm = 6;
  for (int seed = 1; seed <= seeds; ++seed) {
    Scene scene = scene_of("v", seed);
    const Axes axes(scene);
    // Both plates end on it: the second, which goes on by 5 mm, is what it lies against.
    Box tab = scene.boxes[1];
    tab.cuts.clear();
    tab.half_size = {length_mm / 2, half_width_mm, thickness_mm / 2};
    tab.T_base_box.translation() =
        scene.end + (length_mm / 2 + 5) * axes.along - thickness_mm / 2 * axes.out;
    scene.boxes.push_back(tab);
    const SeamResult result = find(scene, "v", seed);
    INFO("seed " << seed << ": " << in_words(result.reason));
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    REQUIRE(result.accuracy);
    const double off = axes.along.dot(result.end - scene.end);
    CHECK(std::abs(off) < 3.6);
    CHECK(std::abs(off) < 3 * deviation(result.accuracy->end, axes.along));
  }
}
