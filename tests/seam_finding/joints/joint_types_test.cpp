// Joints beside the tee: lap, outside corner, butt and V-groove in scans in closed form.
#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry.hpp"
#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/model/joint_type.hpp"
#include "tests/draws.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

// A scene, scanned once, in which several joints may be asked for.
class Scanned {
 public:
  Scanned(const Scene& scene, int seed, const ScanChoice& scan = {})
      : seed_(static_cast<std::uint64_t>(seed)),
        work_(make_scan(scene, scan, seed_).cloud),
        empty_(make_scan(without_boxes(scene), scan, 1000 + seed_).cloud),
        background_(empty_, SeamFindingSettings{}.background_distance()) {}

  SeamResult find(const std::string& joint_type) const {
    SeamFindingSettings settings;
    settings.joint_type = joint_type;
    return find_seam(work_, background_, settings, seed_);
  }

 private:
  static Scene without_boxes(Scene scene) {
    scene.boxes.clear();
    return scene;
  }
  std::uint64_t seed_;
  ScanCloud work_, empty_;
  SurfaceBackground background_;
};

SeamResult find(const Scene& scene, const std::string& joint_type, int seed,
                const ScanChoice& scan = {}) {
  return Scanned(scene, seed, scan).find(joint_type);
}

bool found(const SeamResult& result) { return result.verdict == SeamResult::Verdict::kFound; }

double along_deviation(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& direction) {
  return std::sqrt(direction.dot(covariance * direction));
}

}  // namespace

TEST_CASE("each joint is found as what it is, with both its ends", "[figures]") {
  struct Row {
    std::string joint, asked;
    double angle_deg, lateral;  // lateral: most; mm
  };
  const auto row = GENERATE(Row{"lap", "any", 180, 0.15}, Row{"lap", "lap", 180, 0.15},
                            Row{"outside_corner", "outside_corner", 270, 0.05},
                            Row{"butt", "any", 180, 0.35}, Row{"v", "any", 60, 0.2});
  int answered = 0, covered = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    const Scene scene = make_scene({.joint = row.joint}, static_cast<std::uint64_t>(seed));
    const SeamResult result = find(scene, row.asked, seed);
    INFO(fmt::format("{} asked for as {}, seed {}: {}", row.joint, row.asked, seed,
                     in_words(result.reason)));
    if (!found(result)) continue;
    ++answered;
    CHECK(result.joint_type == row.joint);
    const Eigen::Vector3d direction = (scene.end - scene.start).normalized();
    CHECK(angle_between(result.direction, direction) < 0.01);
    CHECK(result.angle * 180 / M_PI == Approx(row.angle_deg).margin(3));
    for (int j = 0; j < 2; ++j) {
      const double nearest = std::min(angle_between(result.normals[j], scene.normals[0]),
                                      angle_between(result.normals[j], scene.normals[1]));
      CHECK(nearest < 0.01);
    }
    REQUIRE(result.accuracy);
    for (const bool begin : {true, false}) {
      const Eigen::Vector3d error = begin ? result.start - scene.start : result.end - scene.end;
      const double along = error.dot(direction);
      CHECK(std::abs(along) < 1.8);  // half a stripe spacing
      CHECK((error - along * direction).norm() < row.lateral);
      const double deviation =
          along_deviation(begin ? result.accuracy->start : result.accuracy->end, direction);
      CHECK(deviation > 0.02);
      CHECK(deviation < 1.6);
      covered += std::abs(along) <= 2 * deviation;
    }
    // The torch comes from the open side, clear of the plates.
    REQUIRE(result.torch);
    const Eigen::Vector3d back = result.torch->approach - result.start;
    CHECK(back.dot(result.normals[0]) > 30);
    CHECK(back.dot(result.normals[1]) > 30);
  }
  INFO(row.joint << ": " << covered << " of " << 2 * answered << " ends within two deviations");
  CHECK(answered == 5);
  CHECK(covered >= 2 * answered - 2);
}

TEST_CASE("a plate goes on behind a single stripe that does not show it") {
  // In these scans a stripe near the start has no point near enough to the joint.
  for (const auto& [joint, seed] : {std::pair("lap", 566), std::pair("v", 613)}) {
    const Scene scene = make_scene({.joint = joint}, static_cast<std::uint64_t>(seed));
    const SeamResult result = find(scene, "any", seed);
    INFO(joint << ": " << in_words(result.reason));
    REQUIRE(found(result));
    CHECK((result.start - scene.start).norm() < 0.5);
  }
}

TEST_CASE("a plate that stripes show farther from the seam than beside it goes on there") {
  // Near the end of these scans a stripe misses the plate beside its border; 3 to 4 mm were lost.
  struct Row {
    std::string joint;
    int seed;
    ScanChoice scan;
  };
  for (const Row& row :
       {Row{"v", 506, {}}, Row{"v", 506, {.bends = true}}, Row{"butt", 538, {.bends = true}},
        Row{"lap", 555, {.bends = true, .noise = 0.3}}}) {
    const Scene scene = make_scene({.joint = row.joint}, static_cast<std::uint64_t>(row.seed));
    const SeamResult result = find(scene, "any", row.seed, row.scan);
    INFO(row.joint << ": " << in_words(result.reason));
    REQUIRE(found(result));
    REQUIRE(result.accuracy);
    const double off = (result.end - scene.end).norm();
    CHECK(off < 2);
    CHECK(off < 2 * along_deviation(result.accuracy->end, result.direction) + 0.3);
  }
}

TEST_CASE("thickness, gap and groove are measured") {
  const Scene lap = make_scene({.joint = "lap"}, 3);
  const SeamResult lapped = find(lap, "lap", 3);
  REQUIRE(found(lapped));
  const double thickness = 2 * lap.boxes[1].half_size.z();
  CHECK(lapped.thickness == Approx(thickness).margin(0.15));
  CHECK(lapped.gap == -1);  // between the centres kept

  const SeamResult butted = find(make_scene({.joint = "butt"}, 2), "butt", 2);
  REQUIRE(found(butted));
  CHECK(std::abs(butted.gap - 1) < 2.5 * butted.gap_deviation);
  CHECK(butted.gap_deviation < 0.8);  // points 1.4 mm apart
  int measured = 0;
  for (const SeamMeasurement& place : butted.stations) measured += place.gap >= 0;
  CHECK(2 * measured > static_cast<int>(butted.stations.size()));

  // With the stripes' bends kept the gap is known far better than points lie apart.
  // In scan 46 some stripes are joined across the gap.
  for (const int seed : {1, 2, 3, 4, 5, 46}) {
    const Scene butt = make_scene({.joint = "butt"}, static_cast<std::uint64_t>(seed));
    const SeamResult sharp = find(butt, "any", seed, {.bends = true});
    INFO(seed << in_words(sharp.reason));
    REQUIRE(found(sharp));
    CHECK(sharp.joint_type == "butt");
    const Eigen::Vector3d direction = (butt.end - butt.start).normalized();
    const Eigen::Vector3d error = sharp.start - butt.start;
    CHECK((error - error.dot(direction) * direction).norm() < 0.2);
    CHECK(sharp.gap == Approx(1).margin(0.2));
    CHECK(sharp.gap_deviation < 0.2);
  }

  const Scene groove = make_scene({.joint = "v"}, 2);
  const SeamResult v = find(groove, "v", 2);
  REQUIRE(found(v));
  const double depth = 2 * groove.boxes[0].half_size.z();
  CHECK(v.gap == Approx(2 + 2 * depth * std::tan(30 * M_PI / 180)).margin(0.7));
}

TEST_CASE("a tee's and a lap's root gap is measured by station, and is no lack of a joint") {
  struct Row {
    std::string joint;
    double gap, tilt_deg;
  };
  const auto row = GENERATE(Row{"tee", 1, 90}, Row{"tee", 2, 75}, Row{"tee", 3, 90},
                            Row{"tee", 1.5, 105}, Row{"lap", 1.5, 90}, Row{"lap", 3, 90});
  INFO(fmt::format("{}, {} mm, {} deg", row.joint, row.gap, row.tilt_deg));
  const Scene scene =
      make_scene({.joint = row.joint, .tilt_deg = row.tilt_deg, .root_gap = row.gap}, 4);
  const SeamResult result = find(scene, row.joint, 4, {.bends = true});
  INFO(in_words(result.reason) << in_words(result.remarks));
  REQUIRE(found(result));
  CHECK((result.start - scene.start).norm() < 1);
  CHECK(result.gap == Approx(row.gap * std::sin(row.tilt_deg * M_PI / 180)).margin(0.25));
  CHECK(result.gap_deviation > 0.05);
  CHECK(result.gap_deviation < 0.5);
  int measured = 0;
  for (const SeamMeasurement& place : result.stations) measured += place.gap >= 0;
  CHECK(2 * measured > static_cast<int>(result.stations.size()));
}

TEST_CASE("where there is no joint none is found, whatever is asked for") {
  const SceneChoice choice =
      GENERATE(SceneChoice{.workpiece = false}, SceneChoice{.lone_plate = true},
               SceneChoice{.workpiece = false, .tool = true, .big_box = true});
  for (int seed = 1; seed <= test::draws(3); ++seed) {
    const Scanned scene(make_scene(choice, static_cast<std::uint64_t>(seed)), seed);
    for (const char* asked : {"any", "tee", "corner", "outside_corner", "lap", "butt", "v"}) {
      INFO(asked << ", seed " << seed);
      CHECK_FALSE(found(scene.find(asked)));
    }
  }
}

TEST_CASE("beside a tee nothing else is the seam where any joint is wanted") {
  for (const SceneChoice& choice : {SceneChoice{.tool = true}, SceneChoice{.big_box = true}})
    for (int seed = 1; seed <= test::draws(3); ++seed) {
      const Scanned scene(make_scene(choice, static_cast<std::uint64_t>(seed)), seed);
      const SeamResult any = scene.find("any"), tee = scene.find("tee");
      REQUIRE(found(tee));
      REQUIRE(found(any));
      CHECK(any.joint_type == "tee");
      CHECK(any.start == tee.start);
      const SeamResult corner = scene.find("corner");
      REQUIRE(found(corner));
      CHECK(corner.joint_type == "corner");
      CHECK(corner.start == tee.start);
    }
}

TEST_CASE("types are named as in the message, and any leaves out what cannot be told") {
  CHECK(name_of(JointType::kOutsideCorner) == "outside_corner");
  for (const std::string name : {"tee", "corner", "outside_corner", "lap", "butt", "v"}) {
    const auto types = wanted_types(name);
    REQUIRE(types.size() == 1);
    CHECK(name_of(types[0]) == name);
  }
  for (const JointType type : wanted_types("any")) {
    CHECK(type != JointType::kOutsideCorner);
    CHECK(type != JointType::kCorner);
  }
}
