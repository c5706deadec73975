// Clouds that no scan should give: a reason, in bounded time and memory.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <ctime>
#include <random>

#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "tests/draws.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr int kMany = test::sanitized ? 100'000 : 1'000'000;

// What a million points take is 0.1 to 1 s of processor time and 36 bytes each (BENCHMARK.md).
constexpr double kLongest = 10;          // s
constexpr double kMostMemory = 200'000;  // kB above what the program had before

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double peak_memory_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss);
}

SeamResult find(const ScanCloud& cloud) {
  const double begin = processor_seconds(), before = peak_memory_kb();
  const SeamResult result = find_seam(cloud, NoBackground(), {}, 1);
  if (!test::sanitized) {
    CHECK(processor_seconds() - begin < kLongest);
    CHECK(peak_memory_kb() - before < kMostMemory);
  }
  CHECK(result.verdict == SeamResult::Verdict::kRefused);
  CHECK(result.reason);
  return result;
}

}  // namespace

TEST_CASE("no points, few points") {
  find({});
  find(unorganised_cloud({{1, 2, 3}}));
  find(unorganised_cloud(std::vector<Eigen::Vector3d>(15, Eigen::Vector3d(1, 2, 3))));
}

TEST_CASE("a million equal points") {
  find(unorganised_cloud(std::vector<Eigen::Vector3d>(kMany, Eigen::Vector3d(10, 20, 30))));
}

TEST_CASE("a million points on one plane, and on a line") {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> place(0, 300);
  std::vector<Eigen::Vector3d> plane, line;
  for (int i = 0; i < kMany; ++i) {
    plane.emplace_back(place(engine), place(engine), 5);
    line.emplace_back(place(engine), 0, 0);
  }
  find(unorganised_cloud(plane));
  find(unorganised_cloud(line));
}

TEST_CASE("points everywhere") {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> place(-200, 200);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20000; ++i) points.emplace_back(place(engine), place(engine), place(engine));
  find(unorganised_cloud(points));
}

TEST_CASE("half of the points doubled, and some far away") {
  synthetic::Scene scene = synthetic::make_scene({}, 3);
  ScanCloud work = synthetic::make_scan(scene, {}, 3).cloud;
  scene.boxes.clear();
  const ScanCloud empty = synthetic::make_scan(scene, {}, 4).cloud;
  ScanCloud changed;
  for (const ScanStripe& stripe : work.stripes) {
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i)
      for (int twice = 0; twice < 1 + i % 2; ++twice) {
        changed.points.push_back(i % 97 == 0 ? Eigen::Vector3d(9e4, -9e4, 9e4) : work.points[i]);
        changed.origins.push_back(work.origins[i]);
      }
    end_stripe(changed, stripe.seen, stripe.camera_centre, stripe.tool_position);
  }
  const SeamResult result = find_seam(changed, SurfaceBackground(empty, 1.5), {}, 3);
  REQUIRE(result.verdict == SeamResult::Verdict::kFound);
  CHECK((result.start - synthetic::make_scene({}, 3).start).norm() < 4);
}

TEST_CASE("a scan of one stripe, of one place, and one whose stripes are all missing") {
  const ScanCloud whole = synthetic::make_scan(synthetic::make_scene({}, 3), {}, 3).cloud;
  ScanCloud one, still, missing;
  for (const ScanStripe& stripe : whole.stripes) {
    const bool middle = &stripe == &whole.stripes[whole.stripes.size() / 2];
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
      if (middle) one.points.push_back(whole.points[i]), one.origins.push_back({0, 0, false, 0});
      still.points.push_back(whole.points[i]);
      still.origins.push_back(whole.origins[i]);
    }
    if (middle) end_stripe(one, stripe.seen, stripe.camera_centre, stripe.tool_position);
    end_stripe(still, stripe.seen, stripe.camera_centre, {500, 0, 300});
    end_stripe(missing, ScanStripe::Seen::kMissing);
  }
  find(one);
  find(still);
  find(missing);
}
