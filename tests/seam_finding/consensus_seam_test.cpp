#include "services/seam_finding/consensus_seam.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/background/plane_background.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

TEST_CASE("a Tee in a cloud without stripes: its draws agree, the answer is that of a scan") {
  const Scene scene = make_scene({}, 3);
  const SyntheticScan scan = make_scan(scene, {.pitch = 1.8, .downsample = 5, .noise = 0.2}, 3);
  ScanCloud cloud = unorganised_cloud(scan.cloud.points);
  cloud.viewpoint = Eigen::Vector3d(50, 200, 300);
  cloud.viewpoint_known = true;
  cloud.search_direction = Eigen::Vector3d::UnitX();
  const PlaneBackground table(cloud, {Eigen::Vector3d::UnitZ(), 0});
  const SeamResult result = find_consensus_seam(cloud, table, {}, 1);
  INFO(in_words(result.reason));
  REQUIRE(result.verdict == SeamResult::Verdict::kFound);
  CHECK((result.start - scene.start).norm() < 8);
  CHECK((result.end - scene.end).norm() < 8);
  const SeamResult again = find_consensus_seam(cloud, table, {}, 1);
  CHECK(again.start == result.start);
}

TEST_CASE("a rough round tube gives no seam, however often its planes are drawn") {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> noise(0, 1.5);
  for (int trial = 0; trial < 3; ++trial) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 2500; ++i) {  // a tube of 60 mm, cut square, seen from one side
      const double turn = M_PI * share(engine), radius = 30 + noise(engine);
      points.emplace_back(radius * std::cos(turn), 100 * share(engine), radius * std::sin(turn));
    }
    ScanCloud cloud = unorganised_cloud(points);
    cloud.viewpoint = Eigen::Vector3d(0, 50, 500);
    cloud.viewpoint_known = true;
    const SeamResult result = find_consensus_seam(cloud, NoBackground(), {}, 1);
    CHECK(result.verdict != SeamResult::Verdict::kFound);
    CHECK(result.reason);
  }
}
