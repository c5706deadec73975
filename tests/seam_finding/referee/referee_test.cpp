#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry.hpp"
#include "services/seam_finding/referee/ruling.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

using Verdict = SeamResult::Verdict;

constexpr double kDeviation = 0.1;  // claimed along the seam; mm

Plane plane_at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return {normal, -normal.dot(point)};
}

// The true answer of a tee: no part of the product finds it.
SeamResult truth_of(const synthetic::Scene& scene) {
  SeamResult seam;
  seam.verdict = Verdict::kFound;
  seam.joint_type = "tee";
  seam.start = scene.start, seam.end = scene.end;
  seam.direction = (scene.end - scene.start).normalized();
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector3d &own = scene.normals[j], &other = scene.normals[1 - j];
    seam.normals[j] = own;
    seam.faces[j].plane = plane_at(scene.start, own);
    seam.faces[j].away = (other - other.dot(own) * own).normalized();
  }
  seam.start_visibility = seam.end_visibility = EndVisibility::kSeen;
  SeamAccuracy accuracy;
  accuracy.start = accuracy.end = kDeviation * kDeviation * Eigen::Matrix3d::Identity();
  seam.accuracy = accuracy;
  return seam;
}

SeamResult ruled(const ScanCloud& cloud, SeamResult seam) {
  rule(examine(cloud, seam), seam);
  return seam;
}

void turn_about_seam(SeamResult& seam, int plate, double angle) {
  const Eigen::AngleAxisd turn(angle, seam.direction);
  SeamPlate& face = seam.faces[plate];
  seam.normals[plate] = turn * seam.normals[plate];
  face.plane = plane_at(seam.start, seam.normals[plate]);
  face.away = turn * face.away;
}

struct Scan {
  synthetic::Scene scene;
  synthetic::ScanChoice choice;
  ScanCloud cloud;
};

Scan scan_of(const synthetic::SceneChoice& choice, std::uint64_t seed) {
  Scan scan;
  scan.scene = synthetic::make_scene(choice, seed);
  scan.cloud = synthetic::make_scan(scan.scene, scan.choice, seed).cloud;
  return scan;
}

}  // namespace

TEST_CASE("a true answer is upheld") {
  for (std::uint64_t seed = 301; seed < 313; ++seed) {
    const double overhang = static_cast<double>(seed % 3) * 8 - 8;
    const Scan scan = scan_of({.base_overhang = overhang}, seed);
    const SeamResult seam = ruled(scan.cloud, truth_of(scan.scene));
    INFO("seed " << seed);
    CHECK(seam.verdict == Verdict::kFound);
    CHECK(seam.start_visibility == EndVisibility::kSeen);
    CHECK(seam.end_visibility == EndVisibility::kSeen);
    CHECK(seam.start_second.weight == 0);
    CHECK(seam.checked.stripes > 20);
    CHECK(seam.checked.explained > 0.9);
  }
}

TEST_CASE("an end that was moved is not determined, and the true one lies in what is said") {
  for (std::uint64_t seed = 321; seed < 329; ++seed)
    for (const double way : {-1.0, 1.0}) {
      const Scan scan = scan_of({}, seed);
      const double far = way * (1.5 * scan.choice.pitch + 3 * kDeviation);
      SeamResult moved = truth_of(scan.scene);
      moved.start += far * moved.direction;
      const SeamResult seam = ruled(scan.cloud, moved);
      INFO("seed " << seed << " start moved by " << far);
      CHECK(seam.verdict == Verdict::kFound);
      CHECK(seam.start_visibility == EndVisibility::kNotDetermined);
      CHECK(seam.end_visibility == EndVisibility::kSeen);
      CHECK(seam.start_second.weight > 0);
      CHECK((seam.start_second.place - scan.scene.start).norm() < scan.choice.pitch);

      SeamResult other = truth_of(scan.scene);
      other.end += far * other.direction;
      const SeamResult at_end = ruled(scan.cloud, other);
      CHECK(at_end.end_visibility == EndVisibility::kNotDetermined);
      CHECK(at_end.start_visibility == EndVisibility::kSeen);
    }
}

TEST_CASE("a plate that is turned by a degree, or taken for the other one, is noticed") {
  for (std::uint64_t seed = 331; seed < 337; ++seed) {
    const Scan scan = scan_of({}, seed);
    INFO("seed " << seed);
    for (const int plate : {0, 1})
      for (const double angle : {-kDegree, kDegree}) {
        SeamResult turned = truth_of(scan.scene);
        turn_about_seam(turned, plate, angle);
        const SeamResult seam = ruled(scan.cloud, turned);
        INFO("plate " << plate << " by " << angle / kDegree);
        CHECK(seam.verdict == Verdict::kRefused);
        CHECK(seam.reason.code == Reason::Code::kPlateTurned);
      }
    SeamResult swapped = truth_of(scan.scene);
    std::swap(swapped.normals[0], swapped.normals[1]);
    std::swap(swapped.faces[0].plane, swapped.faces[1].plane);
    CHECK(ruled(scan.cloud, swapped).verdict == Verdict::kRefused);
  }
}

TEST_CASE("a cloud without stripes, and what was not found, is not examined") {
  const Scan scan = scan_of({}, 341);
  const SeamResult truth = truth_of(scan.scene);
  CHECK(examine(unorganised_cloud(scan.cloud.points), truth).stripes == 0);
  SeamResult refused;
  CHECK(examine(scan.cloud, refused).stripes == 0);
  CHECK(ruled(scan.cloud, refused).checked.stripes == -1);
}
