// Edges of plates side by side that are bent, hidden in part, or at unlike heights.
#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/answer/wording.hpp"
#include "tests/draws.hpp"
#include "tests/seam_finding/joints/moved_plates.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;
using Eigen::Vector3d;

namespace {

constexpr int seeds = test::draws(5);

// The second plate raised.
Scene stepped(const std::string& joint, int seed, double raised_mm) {
  Scene scene = scene_of(joint, seed);
  move(scene.boxes[1], raised_mm * Axes(scene).out);
  return scene;
}

// Something of that size that lies on the plates. From the seam's start: along, across, out; mm.
Box lying(const Scene& scene, const Vector3d& from_start, const Vector3d& size) {
  const Axes axes(scene);
  Box box;
  box.half_size = size / 2;
  box.T_base_box.linear() << axes.along, axes.out.cross(axes.along), axes.out;
  box.T_base_box.translation() = scene.start + from_start.x() * axes.along +
                                 from_start.y() * axes.across + from_start.z() * axes.out;
  return box;
}

// The work bends so that its middle lies so much below its ends, and its surface is smooth: a
// plate's points lie nearer to each other than the bend is high.
ScanCloud bent(const Scene& scene, int seed, double bend_mm) {
  const Axes axes(scene);
  ScanCloud cloud =
      make_scan(scene, {.bends = true, .noise = 0.03}, static_cast<std::uint64_t>(seed)).cloud;
  const double half = (scene.end - scene.start).norm() / 2;
  for (Vector3d& point : cloud.points) {
    const double from_middle = axes.along.dot(point - scene.start) - half;
    point += bend_mm * std::pow(from_middle / half, 2) * axes.out;
  }
  return cloud;
}

double turn_deg(const SeamResult& result, const Scene& scene) {
  return angle_between(result.direction, Axes(scene).along) / kDegree;
}

}  // namespace

TEST_CASE("a groove is one though its tops differ by more than a mismatch may") {
  for (const double raised : {-1.8, 1.8})
    for (int seed = 1; seed <= seeds; ++seed) {
      const SeamResult result = find(stepped("v", seed, raised), "v", seed);
      INFO("seed " << seed << ", raised by " << raised << " mm: " << in_words(result.reason));
      REQUIRE(result.verdict == SeamResult::Verdict::kFound);
      CHECK(result.joint_type == "v");
      CHECK(std::abs(result.mismatch - 1.8) < 0.1);
    }
}

TEST_CASE("a butt joint's mismatch is measured whichever plate is higher, along a wedge mid-seam") {
  for (const double raised : {-0.7, 0.0, 0.7}) {
    const SeamResult result = find(stepped_butt(1, 0, raised), "butt", 1);
    INFO("raised by " << raised << " mm: " << in_words(result.reason));
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    CHECK(std::abs(result.mismatch - std::abs(raised)) < 0.08);
  }
  // From 0 at the start to 0.8 mm at the end.
  Scene wedge = scene_of("butt", 2);
  const Axes axes(wedge);
  const double length = (wedge.end - wedge.start).norm();
  const Eigen::AngleAxisd turn(-0.8 / length, axes.across);
  Box& second = wedge.boxes[1];
  const Vector3d from_start = second.T_base_box.translation() - wedge.start;
  second.T_base_box.translation() = wedge.start + turn * from_start;
  second.T_base_box.linear() = turn * second.T_base_box.linear();
  const SeamResult result = find(wedge, "butt", 2);
  INFO(in_words(result.reason));
  REQUIRE(result.verdict == SeamResult::Verdict::kFound);
  CHECK(std::abs(result.mismatch - 0.4) < 0.08);
}

TEST_CASE("other joints have no mismatch") {
  for (const std::string joint : {"tee", "lap"}) {
    const SeamResult result = find(scene_of(joint, 1), joint, 1);
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    CHECK(result.mismatch == -1);
  }
}

TEST_CASE("a groove whose tops differ is no lap", "[figures]") {
  for (const double raised : {-1.8, 1.8})
    for (int seed = 1; seed <= seeds; ++seed) {
      INFO("seed " << seed << ", raised by " << raised << " mm");
      CHECK(find(stepped("v", seed, raised), "lap", seed).verdict != SeamResult::Verdict::kFound);
    }
}

TEST_CASE("plates between which light is seen to go down past both are a butt joint, not a lap") {
  // The camera looks onto the cut of one of them.
  int butts = 0;
  for (const double raised : {-1.6, 1.6})
    for (int seed = 1; seed <= seeds; ++seed) {
      Scene scene = stepped("butt", seed, raised);
      move(scene.boxes[1], -Axes(scene).across);  // 2 mm
      butts += find(scene, "butt", seed).verdict == SeamResult::Verdict::kFound;
    }
  CHECK(butts >= seeds);
}

TEST_CASE("a bent lap is found all along") {
  for (int seed = 1; seed <= seeds; ++seed) {
    const Scene scene = thin_lap(seed, 1.5, 0);
    const SeamResult result = find(scene, bent(scene, seed, 1), "lap", seed);
    INFO("seed " << seed << ": " << in_words(result.reason));
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    CHECK((result.end - result.start).norm() > 0.8 * (scene.end - scene.start).norm());
    CHECK(std::abs(Axes(scene).across.dot(result.start - scene.start)) < 0.3);
    CHECK(std::abs(Axes(scene).across.dot(result.end - scene.end)) < 0.3);
  }
}

TEST_CASE("what hides the edges for a while does not turn the seam") {
  const std::string joint = GENERATE("lap", "butt", "v");
  for (int seed = 1; seed <= seeds; ++seed) {
    Scene scene = scene_of(joint, seed);
    const double length = (scene.end - scene.start).norm();
    // A bar across one plate's edge, on a third of the seam.
    scene.boxes.push_back(lying(scene, {length / 3, 5, 12}, {length / 3, 12, 24}));
    const SeamResult result = find(scene, joint, seed);
    INFO(joint << ", seed " << seed << ": " << in_words(result.reason));
    if (result.verdict != SeamResult::Verdict::kFound) continue;
    REQUIRE(result.accuracy);
    const double turn = turn_deg(result, scene);
    CHECK((turn < 0.5 || turn < 3 * result.accuracy->direction / kDegree));
  }
}

TEST_CASE("edges behind a bar that lies along a groove are not put to its other side") {
  for (int seed = 1; seed <= seeds; ++seed)
    for (const double side : {-1.0, 1.0}) {
      Scene scene = scene_of("v", seed);
      const double length = (scene.end - scene.start).norm();
      scene.boxes.push_back(lying(scene, {length / 2, side * 14, 8}, {1.5 * length, 6, 16}));
      const SeamResult result = find(scene, "v", seed);
      INFO("seed " << seed << ", side " << side << ": " << in_words(result.reason));
      if (result.verdict != SeamResult::Verdict::kFound) continue;
      CHECK(std::abs(Axes(scene).across.dot(result.start - scene.start)) < 1);
    }
}

TEST_CASE("a lap's step is its upper plate and the gap under it") {
  for (int seed = 1; seed <= seeds; ++seed) {
    const SeamResult result = find(thin_lap(seed, 13, 0), "lap", seed);  // 12 mm, and 1 mm of gap
    INFO("seed " << seed << ": " << in_words(result.reason));
    CHECK(result.verdict == SeamResult::Verdict::kFound);
  }
}

TEST_CASE("a gap over a backing strip is a butt joint's, no groove") {
  int butts = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Scene scene = scene_of("butt", seed);
    const double length = (scene.end - scene.start).norm();
    move(scene.boxes[1], -1.8 * Axes(scene).across);  // the gap is 2.8 mm wide
    scene.boxes.push_back(lying(scene, {length / 2, -0.9, -3}, {length, 20, 2}));
    butts += find(scene, "butt", seed).verdict == SeamResult::Verdict::kFound;
  }
  CHECK(butts == seeds);
}

TEST_CASE("a butt joint is found beside a slot that is wider than a gap") {
  // The slot is crossed by as many stripes as the gap, and parts the plate.
  for (int seed = 1; seed <= seeds; ++seed) {
    const Scene scene = scene_of("butt", seed);
    const Axes axes(scene);
    ScanCloud cloud = make_scan(scene, with_bends, static_cast<std::uint64_t>(seed)).cloud;
    for (Vector3d& point : cloud.points) {
      const double beside = axes.across.dot(point - scene.start);
      if (beside > 14 && beside < 24 && axes.out.dot(point - scene.start) > -1)
        point -= 40 * axes.out;
    }
    const SeamResult result = find(scene, cloud, "butt", seed);
    INFO("seed " << seed << ": " << in_words(result.reason));
    REQUIRE(result.verdict == SeamResult::Verdict::kFound);
    CHECK(std::abs(axes.across.dot(result.start - scene.start)) < 0.4);
    CHECK(std::abs(axes.across.dot(result.end - scene.end)) < 0.4);
  }
}

TEST_CASE("a step that touches is a butt joint's as far as the job says, no lap's") {
  // Nothing seen from above tells it from a lap of sheet as thin.
  for (const double limit : {1.0, 2.0})
    for (int seed = 1; seed <= seeds; ++seed) {
      const Scene scene = stepped_butt(seed, 1, 1.5);
      SeamFindingSettings settings;
      settings.joint_type = "butt";
      settings.mismatch_max_mm = limit;
      Scene cell = scene;
      cell.boxes.clear();
      const ScanCloud table = make_scan(cell, with_bends, 1).cloud;
      const SurfaceBackground empty(table, settings.background_distance());
      const auto number = static_cast<std::uint64_t>(seed);
      const SeamResult result =
          find_seam(make_scan(scene, with_bends, number).cloud, empty, settings, number);
      INFO("seed " << seed << ", limit " << limit << " mm: " << in_words(result.reason));
      CHECK((result.verdict == SeamResult::Verdict::kFound) == (limit > 1.5));
    }
}
