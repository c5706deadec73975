#include "services/seam_finding/coverage/round_edge.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// An upright in the plane y = 0 that looks to -y over a base in z = 0, in ten stripes; the points
// of each from the top down. Its edge at the base has a radius, 0 for a sharp one, and is seen
// until the arc lies `hidden` behind the face; mm.
struct Upright {
  ScanCloud cloud;
  std::vector<int> face;
};

Upright upright(double radius, double hidden) {
  Upright scene;
  for (int k = 0; k < 10; ++k) {
    const auto add = [&](double y, double z, int segment) {
      scene.cloud.points.emplace_back(4.0 * k, y, z);
      scene.cloud.origins.push_back({k, segment});
    };
    const int first = scene.cloud.size();
    for (double z = 40; z >= radius; z -= 2) add(0, z, 0);
    for (int i = first; i < scene.cloud.size(); ++i) scene.face.push_back(i);
    for (double beyond = 0.5; beyond < radius; beyond += 0.5) {
      const double behind = radius - std::sqrt(radius * radius - beyond * beyond);
      if (behind > hidden) break;
      add(behind, radius - beyond, 0);
    }
    for (double y = 0; y > -30; y -= 2) add(y, 0, 1);
    end_stripe(scene.cloud, ScanStripe::Seen::kSeen);
  }
  return scene;
}

double round_of(const Upright& scene) {
  const Plane face{-Eigen::Vector3d::UnitY(), 0}, base{Eigen::Vector3d::UnitZ(), 0};
  return round_edge(scene.cloud, scene.face, face, base,
                    {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, Scales{});
}

}  // namespace

TEST_CASE("a round edge begins where its radius does, though most of its arc is hidden") {
  for (const double radius : {4.0, 8.0, 12.0})
    for (const double hidden : {0.45, 2.0}) {
      INFO("radius " << radius << ", seen to a depth of " << hidden);
      CHECK(round_of(upright(radius, hidden)) == Approx(radius).margin(0.5));
    }
}

TEST_CASE("a sharp edge is not round") { CHECK(round_of(upright(0, 0)) == 0); }
