#include <catch2/catch.hpp>

#include "services/seam_finding/course.hpp"
#include "tests/seam_finding/synthetic_scan.hpp"

using namespace arcstart;

namespace {

// An upright 120 mm long on a base plate, in a gap of 40 mm of which either a box stands before
// the seam or the upright is missing.
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

Bench bench_of(bool hidden) {
  synthetic::Scene scene;
  scene.boxes.push_back(box_at({0, -60, 0}, {120, 60, 10}));
  if (hidden) {
    scene.boxes.push_back(box_at({0, -8, 10}, {120, 0, 50}));
    scene.boxes.push_back(box_at({40, 3, 10}, {80, 20, 45}));
  } else {
    scene.boxes.push_back(box_at({0, -8, 10}, {35, 0, 50}));
    scene.boxes.push_back(box_at({75, -8, 10}, {120, 0, 50}));
  }
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

}  // namespace

TEST_CASE("a seam goes on behind what hides it, however long, and ends where a plate does") {
  for (const bool hidden : {true, false}) {
    const Bench bench = bench_of(hidden);
    const Course course = find_course(bench.cloud, bench.plates, bench.line, {3.6, 0.6, 20});
    INFO(hidden);
    CHECK(std::abs(course.end - 120) < 4);
    if (hidden)
      CHECK(std::abs(course.begin) < 4);
    else
      CHECK(std::abs(course.begin - 75) < 4);
  }
}
