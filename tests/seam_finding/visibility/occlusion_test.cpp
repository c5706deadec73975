#include <catch2/catch.hpp>

#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/ends/seam_ends.hpp"
#include "tests/seam_finding/support/scales.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// What stands on a base plate 120 mm long, upright and whatever is before it.
struct Bench {
  ScanCloud cloud;
  std::array<JointPlate, 2> plates;
  Line line{{0, 0, 10}, Eigen::Vector3d::UnitX()};
};

synthetic::Box box_at(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  synthetic::Box box;
  box.half_size = (high - low) / 2;
  box.T_base_box = Eigen::Translation3d((low + high) / 2) * Eigen::Isometry3d::Identity();
  return box;
}

Bench bench_of(const std::vector<synthetic::Box>& on_base) {
  synthetic::Scene scene;
  scene.boxes.push_back(box_at({0, -60, 0}, {120, 60, 10}));
  scene.boxes.insert(scene.boxes.end(), on_base.begin(), on_base.end());
  synthetic::ScanChoice choice;
  choice.noise = 0.02, choice.outliers = 0, choice.stripe_noise = 0;
  Bench bench;
  bench.cloud = synthetic::make_scan(scene, choice, 1).cloud;
  bench.plates[0].plane = {Eigen::Vector3d::UnitZ(), -10};
  bench.plates[1].plane = {Eigen::Vector3d::UnitY(), 0};
  for (int i = 0; i < bench.cloud.size(); ++i) {
    const Eigen::Vector3d& p = bench.cloud.points[i];
    if (std::abs(p.z() - 10) < 0.3 && p.y() > 0) bench.plates[0].points.push_back(i);
    if (std::abs(p.y()) < 0.3 && p.z() > 10) bench.plates[1].points.push_back(i);
  }
  return bench;
}

const Scales kBenchScales = scales_of_test(3.6, 0.6, 0.02);

std::array<SeamEnd, 2> ends_of(const Bench& bench, const Coverage& coverage) {
  Joint joint;
  joint.plates = bench.plates;
  joint.line = bench.line;
  joint.coverage = coverage;
  return find_seam_ends(bench.cloud, joint, kBenchScales, {});
}

}  // namespace

TEST_CASE("a seam goes on behind what hides it, however long, and ends where a plate does") {
  // In a gap of 40 mm either a box stands before the seam or the upright is missing.
  for (const bool hidden : {true, false}) {
    const Bench bench =
        hidden ? bench_of({box_at({0, -8, 10}, {120, 0, 50}), box_at({40, 3, 10}, {80, 20, 45})})
               : bench_of({box_at({0, -8, 10}, {35, 0, 50}), box_at({75, -8, 10}, {120, 0, 50})});
    const Coverage course = find_coverage(bench.cloud, bench.plates, bench.line, kBenchScales);
    INFO(hidden);
    CHECK(std::abs(course.end - 120) < 4);
    if (hidden)
      CHECK(std::abs(course.begin) < 4);
    else
      CHECK(std::abs(course.begin - 75) < 4);
  }
}

TEST_CASE("a reflection in one of the stripes behind what hides a seam does not end it") {
  Bench bench = bench_of({box_at({0, -8, 10}, {120, 0, 50}), box_at({40, 3, 10}, {80, 20, 45})});
  // Of the stripe that crosses the box in its middle the points on it lie deep under the base
  // plate.
  int spoilt = 0;
  for (const ScanStripe& stripe : bench.cloud.stripes) {
    std::vector<int> on_box;
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i)
      if (const Eigen::Vector3d& p = bench.cloud.points[i]; p.z() > 12 && p.y() > 2.5)
        on_box.push_back(i);
    if (on_box.size() < 4 || bench.cloud.points[on_box[0]].x() < 55) continue;
    for (const int i : on_box) bench.cloud.points[i] = {60, 6 + 0.5 * spoilt++, -5};
    break;
  }
  REQUIRE(spoilt >= 4);
  const Coverage course = find_coverage(bench.cloud, bench.plates, bench.line, kBenchScales);
  CHECK(std::abs(course.begin) < 4);
  CHECK(std::abs(course.end - 120) < 4);
  CHECK(ends_of(bench, course)[1].along == Approx(120).margin(0.3));
}

TEST_CASE("a start that is hidden lies where both plates are seen to begin beyond what hides it") {
  // A box before the seam from its begin on, over which both plates are seen.
  const Bench bench =
      bench_of({box_at({0, -8, 10}, {120, 0, 50}), box_at({-1, 2, 10}, {30, 14, 22})});
  const Coverage course = find_coverage(bench.cloud, bench.plates, bench.line, kBenchScales);
  REQUIRE(course.begin > 20);
  const SeamEnd start = ends_of(bench, course)[0];
  CHECK(start.by_edges);
  CHECK(start.along == Approx(0).margin(0.3));
  CHECK(start.along * start.along <= 9 * start.variance);
}

TEST_CASE("what lies in a plate's plane beyond a place that is seen past is no part of it") {
  const Bench bench =
      bench_of({box_at({0, -8, 10}, {120, 0, 50}), box_at({140, 12, 0}, {180, 40, 10})});
  const Coverage course = find_coverage(bench.cloud, bench.plates, bench.line, kBenchScales);
  CHECK(ends_of(bench, course)[1].along == Approx(120).margin(0.3));
}

TEST_CASE("a thing as high as a plate that touches its end does not prolong it") {
  // The upright reaches beyond the base, so that the seam ends with that.
  for (const double from : {22.0, 28.0, 35.0, 45.0}) {
    const Bench bench =
        bench_of({box_at({0, -8, 10}, {150, 0, 50}), box_at({120, from, 0}, {200, 60, 10})});
    const Coverage course = find_coverage(bench.cloud, bench.plates, bench.line, kBenchScales);
    const SeamEnd end = ends_of(bench, course)[1];
    INFO(from);
    INFO(end.along);
    INFO(std::sqrt(end.variance));
    CHECK(std::abs(end.along - 120) <= 2 * std::sqrt(end.variance) + 0.02);
    CHECK(std::sqrt(end.variance) < 1.6);
  }
}
