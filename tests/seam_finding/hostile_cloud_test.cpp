// Clouds that no scan should give: a reason, in bounded time and memory.
#include <catch2/catch.hpp>
#include <random>

#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kMany = 100'000;
#else
constexpr int kMany = 1'000'000;
#endif

SeamResult find(const ScanCloud& cloud) {
  const SeamResult result = find_seam(cloud, NoBackground(), {}, 1);
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
