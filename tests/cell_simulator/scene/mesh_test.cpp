#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>

#include "services/cell_simulator/base/interval.hpp"
#include "services/cell_simulator/scene/tool_shapes.hpp"
#include "services/cell_simulator/scene/triangle_hierarchy.hpp"
#include "tests/cell_simulator/scene/triangle_soup.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

// By Gauss' theorem; positive only where the corners run counter-clockwise seen from outside.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += mesh.corners[a].dot(mesh.corners[b].cross(mesh.corners[c])) / 6;
  return sum;
}

// Of a closed surface the triangles' area vectors sum to nothing.
double openness(const TriangleMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (mesh.corners[b] - mesh.corners[a]).cross(mesh.corners[c] - mesh.corners[a]);
  return sum.norm();
}

}  // namespace

TEST_CASE("boxes, prisms and plates are closed and have their volume") {
  const TriangleMesh box = make_box({1, 2, 3}, {4, 7, 5});
  CHECK(volume(box) == Approx(3 * 5 * 2));
  CHECK(openness(box) < 1e-9);
  const TriangleMesh prism = make_prism(6, 2, -1, 4);
  CHECK(volume(prism) == Approx(5 * 6 * std::sqrt(3.0)));  // hexagon: 3/2 sqrt(3) r^2
  CHECK(openness(prism) < 1e-9);
  CHECK(volume(make_plate({{0, 0}, {4, 0}, {0, 3}}, 10, 12)) == Approx(12));

  RigidTransform T = RigidTransform::Identity();
  T.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())).translation() << 5, -9,
      40;
  TriangleMesh both = transformed(box, T);
  append(both, prism);
  CHECK(volume(both) == Approx(30 + 30 * std::sqrt(3.0)));
  CHECK(openness(both) < 1e-9);
  for (const TriangleMesh& tool : {make_hammer(), make_pliers()}) {
    CHECK(openness(tool) < 1e-9);
    CHECK(volume(tool) > 0);
    double lowest = 1;
    for (const auto& corner : tool.corners) lowest = std::min(lowest, corner.z());
    CHECK(lowest >= -1e-9);
    CHECK(lowest < 0.1);
  }
}

TEST_CASE("footprints overlap where they do") {
  const TriangleMesh square = make_box({-1, -1, 0}, {1, 1, 1});
  RigidTransform aside = RigidTransform::Identity();
  aside.translation().x() = 2.3;
  RigidTransform turned = aside;
  turned.rotate(Eigen::AngleAxisd(std::numbers::pi / 4,
                                  Eigen::Vector3d::UnitZ()));  // its corner now reaches x = 0.886
  const Footprint still = footprint(square, RigidTransform::Identity(), 0);
  CHECK_FALSE(overlap(still, footprint(square, aside, 0)));
  CHECK(overlap(still, footprint(square, turned, 0)));
  CHECK(overlap(still, footprint(square, aside, 0.31)));
  // Corner to edge: only an edge of the turned one parts them.
  RigidTransform before_corner = turned;
  before_corner.translation() << 1.75, 1.75, 0;
  CHECK_FALSE(overlap(still, footprint(square, before_corner, 0)));
  CHECK_FALSE(overlap(footprint(square, before_corner, 0), still));
  CHECK(
      overlap(footprint(square, RigidTransform::Identity(), -0.9), still));  // one within the other
}

TEST_CASE("rays through the tree hit what rays through every triangle hit") {
  RandomStream random(11);
  const TriangleMesh one = test::random_triangles(random, 150, 50, 12),
                     two = test::random_triangles(random, 70, 50, 5);
  TriangleMesh all = one;
  append(all, two);
  const TriangleHierarchy tree({&one, &two});
  REQUIRE(tree.size() == 220);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d from = test::random_point(random, 80),
                          to = test::random_point(random, 80);
    const double expected = test::nearest_share(all, from, to);
    int triangle = -1;
    const double found = tree.first_hit(from, to, &triangle);
    if (expected > 1) {
      CHECK(found > 1);
    } else {
      ++hits;
      CHECK(found == Approx(expected).epsilon(1e-9));
      const Triangle& t = tree.triangle(triangle);
      CHECK(std::abs(t.normal.dot(from + found * (to - from) - t.a)) < 1e-8);
      CHECK(tree.object_of(triangle) ==
            (triangle >= 0 && test::nearest_share(one, from, to) == expected ? 0 : 1));
    }
    CHECK(tree.blocked(from, to, 0, -1) == (expected < 1));
    // A clearance that reaches back past the hit leaves the way free of it; passing one triangle
    // over leaves the others.
    if (expected < 1) {
      const double rest = (1 - expected) * (to - from).norm();
      CHECK(tree.blocked(from, to, rest - 1e-6, -1));
      CHECK_FALSE(tree.blocked(from, to, rest + 1e-6, -1));
      double next = std::numeric_limits<double>::infinity();
      for (const auto& candidate : all.triangles)
        if (const double share = test::share_to(all, candidate, from, to); share != expected)
          next = std::min(next, share);
      CHECK(tree.blocked(from, to, 0, triangle) == (next < 1));
    }
  }
  CHECK(hits > 100);
}

TEST_CASE("a plane cuts every triangle it passes through, in its own line") {
  RandomStream random(12);
  TriangleMesh mesh = test::random_triangles(random, 300, 50, 10);
  mesh.corners.emplace_back(1, 1, 1);
  mesh.triangles.push_back({900, 900, 900});  // no area: left out
  const TriangleHierarchy tree({&mesh});
  REQUIRE(tree.size() == 300);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d normal = test::random_point(random, 1).normalized();
    const double offset = random.uniform(-40, 40);
    std::vector<PlaneCut> cuts;
    tree.cut(normal, offset, cuts);
    std::size_t expected = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      int above = 0;
      for (const int corner : {a, b, c}) above += normal.dot(mesh.corners[corner]) + offset > 0;
      expected += above == 1 || above == 2;
    }
    CHECK(cuts.size() == expected);
    for (const PlaneCut& cut : cuts) {
      for (const Eigen::Vector3d& end : {cut.begin, cut.end}) {
        const Triangle& t = tree.triangle(cut.triangle);
        CHECK(std::abs(normal.dot(end) + offset) < 1e-9);
        CHECK(std::abs(t.normal.dot(end - t.a)) < 1e-9);
        // On the triangle's rim: on one edge, between its corners.
        double off_rim = 1e9;
        for (const auto& [p, q] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)})
          off_rim = std::min(off_rim, (end - p).norm() + (end - q).norm() - (p - q).norm());
        CHECK(off_rim < 1e-9);
      }
    }
  }
}

TEST_CASE("a tree of nothing is cut and blocked by nothing") {
  const TriangleHierarchy tree(std::vector<const TriangleMesh*>{});
  std::vector<PlaneCut> cuts;
  tree.cut(Eigen::Vector3d::UnitX(), 0, cuts);
  CHECK(cuts.empty());
  CHECK_FALSE(tree.blocked({0, 0, 0}, {1, 1, 1}, 0, -1));
  CHECK(tree.first_hit({0, 0, 0}, {1, 1, 1}) > 1);
}

TEST_CASE("an interval keeps what every condition leaves") {
  Interval part;
  part.keep(1, 2);  // everywhere
  CHECK((part.begin == 0 && part.end == 1));
  part.keep(-1, 1);  // from 1/2 on
  part.keep(-1, 3);  // from 1/4 on: already narrower
  CHECK(part.begin == Approx(0.5));
  part.keep(3, -1);  // up to 3/4
  part.keep(9, -1);  // up to 9/10
  CHECK(part.end == Approx(0.75));
  CHECK_FALSE(part.empty());
  part.keep(0.4, -0.6);  // up to 0.4
  CHECK(part.empty());
  Interval nowhere;
  nowhere.keep(-1, -2);
  CHECK(nowhere.empty());
}

TEST_CASE("a sphere is closed, its corners lie on it and its faces hardly below") {
  const TriangleMesh sphere = make_sphere(20, 5);
  CHECK(sphere.triangles.size() == 20480);
  CHECK(openness(sphere) < 1e-6);
  CHECK(volume(sphere) == Approx(4 * std::numbers::pi / 3 * 8000).epsilon(1e-3));
  double deepest = 20;
  for (const auto& [a, b, c] : sphere.triangles)
    deepest =
        std::min(deepest, (sphere.corners[a] + sphere.corners[b] + sphere.corners[c]).norm() / 3);
  CHECK(deepest > 20 - 0.009);
  for (const auto& corner : sphere.corners) CHECK(corner.norm() == Approx(20));
}
