#include "services/cell_simulator/image/laser_fan.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/cell_simulator/scene/triangle_soup.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

Surface matt() { return {0.4, 0, 1, 0, 0}; }
Surface glossy() { return {0.4, 0, 1, 0.3, 0.01}; }

TriangleMesh rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& one,
                       const Eigen::Vector3d& other) {
  return {{corner, corner + one, corner + one + other, corner + other}, {{0, 1, 2}, {0, 2, 3}}};
}

// The parts of the lines' y for which `wanted` holds, joined where they touch, in order.
template <class Wanted>
std::vector<std::pair<double, double>> extents_in_y(const std::vector<LitLine>& lines,
                                                    Wanted wanted) {
  std::vector<std::pair<double, double>> parts, joined;
  for (const LitLine& line : lines)
    if (wanted(line)) parts.push_back(std::minmax({line.begin.y(), line.end.y()}));
  std::sort(parts.begin(), parts.end());
  for (const auto& part : parts) {
    if (!joined.empty() && part.first < joined.back().second + 1e-9)
      joined.back().second = std::max(joined.back().second, part.second);
    else
      joined.push_back(part);
  }
  return joined;
}

}  // namespace

TEST_CASE("lines are parted where a band begins and ends, and each part answers as it does there") {
  SceneObject floor{"floor", rectangle({-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}), matt()};
  const LightSheet sheet{{0, 0, 300}, {1, 0, 0}, {0, 0, -1}, 0.4};  // lights the y axis
  const auto all = extents_in_y(cast(Scene({floor}), sheet), [](const LitLine&) { return true; });
  floor.band = SurfaceBand{{0, 20, 0}, {0, 1, 0}, 15, glossy()};
  const Scene scene({floor});
  const std::vector<LitLine> lines = cast(scene, sheet);
  CHECK(extents_in_y(lines, [](const LitLine&) { return true; }) == all);
  const auto is_glossy = [&](const LitLine& line) {
    return scene.surface_at(line.triangle, (line.begin + line.end) / 2).specular_share > 0;
  };
  const auto within = extents_in_y(lines, is_glossy);
  REQUIRE(within.size() == 1);
  CHECK(within[0].first == Approx(5));
  CHECK(within[0].second == Approx(35));
}

TEST_CASE("the fan lights a plane along one line, as wide as it opens") {
  const Scene scene({{"floor", rectangle({-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}), matt()}});
  LightSheet sheet;
  sheet.source = {40, 10, 300};
  sheet.normal = Eigen::Vector3d(0.9, 0.1, 0.35).normalized();
  sheet.direction = sheet.normal.cross(Eigen::Vector3d(0.02, 1, 0.1)).normalized();
  if (sheet.direction.z() > 0) sheet.direction = -sheet.direction;
  sheet.half_angle = 0.4;
  const std::vector<LitLine> lines = cast(scene, sheet);
  REQUIRE_FALSE(lines.empty());
  // Where the fan's two outermost rays meet z = 0.
  Eigen::Vector3d outermost[2];
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d ray =
        Eigen::AngleAxisd(i == 0 ? -0.4 : 0.4, sheet.normal) * sheet.direction;
    outermost[i] = sheet.source - ray * sheet.source.z() / ray.z();
  }
  double length = 0, nearest[2] = {1e9, 1e9};
  for (const LitLine& line : lines) {
    length += (line.end - line.begin).norm();
    for (const Eigen::Vector3d& end : {line.begin, line.end}) {
      CHECK(std::abs(end.z()) < 1e-9);
      CHECK(std::abs(sheet.normal.dot(end - sheet.source)) < 1e-9);
      for (int i = 0; i < 2; ++i) nearest[i] = std::min(nearest[i], (end - outermost[i]).norm());
    }
    CHECK(line.share == 1);
    CHECK_FALSE(line.ghost);
  }
  CHECK(length == Approx((outermost[0] - outermost[1]).norm()).epsilon(1e-9));
  CHECK(nearest[0] < 1e-6);
  CHECK(nearest[1] < 1e-6);
}

TEST_CASE("a box throws its shadow where similar triangles put it") {
  const Scene scene({{"floor", rectangle({-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}), matt()},
                     {"box", make_box({-30, 20, 0}, {30, 40, 10}), matt()}});
  const LightSheet sheet{{-50, 0, 300},
                         Eigen::Vector3d(1, 0, 0.2).normalized(),
                         Eigen::Vector3d(0.2, 0, -1).normalized(),
                         0.5};
  const std::vector<LitLine> lines = cast(scene, sheet);
  const auto on = [&](int object, double z) {
    return extents_in_y(lines, [&, object, z](const LitLine& line) {
      return scene.triangles().object_of(line.triangle) == object &&
             std::abs(line.begin.z() - z) < 1e-9 && std::abs(line.end.z() - z) < 1e-9;
    });
  };
  const auto floor = on(0, 0), top = on(1, 10);
  REQUIRE(floor.size() == 2);
  CHECK(floor[0].second == Approx(20).epsilon(1e-9));
  CHECK(floor[1].first == Approx(40 * 300 / 290.0).epsilon(1e-9));
  REQUIRE(top.size() == 1);
  CHECK(top[0].first == Approx(20).epsilon(1e-9));
  CHECK(top[0].second == Approx(40).epsilon(1e-9));
  // The near side is lit from floor to top, the far side not at all.
  double near_side = 0, far_side = 0;
  for (const LitLine& line : lines) {
    if (std::abs(line.begin.y() - 20) < 1e-9 && std::abs(line.end.y() - 20) < 1e-9)
      near_side += std::abs(line.end.z() - line.begin.z());
    if (std::abs(line.begin.y() - 40) < 1e-9 && std::abs(line.end.y() - 40) < 1e-9) far_side += 1;
  }
  CHECK(near_side == Approx(10));
  CHECK(far_side == 0);
}

TEST_CASE("in every direction the lit triangle is the one that a ray meets first") {
  RandomStream random(21);
  for (int round = 0; round < 5; ++round) {
    // Large triangles that pierce each other, and small ones.
    TriangleMesh mesh = test::random_triangles(random, 40, 60, 50);
    append(mesh, test::random_triangles(random, 60, 60, 8));
    const Scene scene({{"soup", mesh, matt()}});
    LightSheet sheet;
    sheet.source = Eigen::Vector3d(150, 20, -30) + test::random_point(random, 10);
    sheet.normal = sheet.source.cross(test::random_point(random, 1)).normalized();
    sheet.direction = -sheet.source.normalized();
    sheet.half_angle = 0.35;
    const std::vector<LitLine> lines = cast(scene, sheet);
    const Eigen::Vector3d aside = sheet.normal.cross(sheet.direction);
    const auto tangent = [&](const Eigen::Vector3d& p) {
      return aside.dot(p - sheet.source) / sheet.direction.dot(p - sheet.source);
    };
    int lit = 0;
    for (int i = 0; i < 400; ++i) {
      const double t = std::tan(0.35) * random.uniform(-1, 1);
      const Eigen::Vector3d far_end = sheet.source + 1000 * (sheet.direction + t * aside);
      const double expected = test::nearest_share(mesh, sheet.source, far_end);
      double found = std::numeric_limits<double>::infinity();
      int times = 0;
      for (const LitLine& line : lines) {
        const double a = tangent(line.begin), b = tangent(line.end);
        if ((t - a) * (t - b) > 0) continue;
        ++times;
        const Triangle& triangle = scene.triangles().triangle(line.triangle);
        found = triangle.normal.dot(triangle.a - sheet.source) /
                triangle.normal.dot(far_end - sheet.source);
      }
      if (std::isinf(expected)) {
        CHECK(times == 0);
      } else {
        ++lit;
        CHECK(times == 1);
        CHECK(found == Approx(expected).epsilon(1e-9));
      }
    }
    CHECK(lit > 200);
  }
}

TEST_CASE("light mirrored from one plate lights the other where the law of reflection says") {
  // Floor from y = -50 to -10 before a wall in y = 0, 45 high; the source looks down from over the
  // floor.
  const Scene scene({{"floor", rectangle({-400, -50, 0}, {800, 0, 0}, {0, 40, 0}), glossy()},
                     {"wall", rectangle({-400, 0, 0}, {0, 0, 45}, {800, 0, 0}), matt()}});
  LightSheet sheet;
  sheet.source = {90, -100, 200};
  sheet.normal = Eigen::Vector3d(0.92, 0.21, 0.33).normalized();
  sheet.direction =
      (Eigen::Vector3d(90 - 0.33 / 0.92 * -200 - 0.21 / 0.92 * 75, -25, 0) - sheet.source)
          .normalized();
  REQUIRE(std::abs(sheet.normal.dot(sheet.direction)) < 1e-12);
  sheet.half_angle = 0.6;
  const std::vector<LitLine> direct = cast(scene, sheet),
                             ghosts = cast_mirrored(scene, direct, 0.01);
  REQUIRE_FALSE(ghosts.empty());
  double lowest = 1e9, highest = -1e9;
  for (const LitLine& ghost : ghosts) {
    CHECK(ghost.ghost);
    CHECK(ghost.share == Approx(0.3));
    CHECK(scene.triangles().object_of(ghost.triangle) ==
          1);  // the wall is matt and sends nothing back
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d p = i == 0 ? ghost.begin : ghost.end;
      lowest = std::min(lowest, p.z());
      highest = std::max(highest, p.z());
      CHECK(std::abs(p.y()) < 1e-9);
      // Fermat: the way by the floor is straight to the point's mirror image under it.
      const Eigen::Vector3d image(p.x(), p.y(), -p.z());
      CHECK(std::abs(sheet.normal.dot(image - sheet.source)) < 1e-9);
      const Eigen::Vector3d on_floor = sheet.source + (image - sheet.source) * 200 / (200 + p.z());
      CHECK(on_floor.y() > -50 - 1e-9);
      CHECK(on_floor.y() < -10 + 1e-9);
      const double spread = i == 0 ? ghost.spread_begin : ghost.spread_end;
      CHECK(spread == Approx(0.01 * (p - on_floor).norm()));
    }
  }
  // The ray by (y, z) = (-10, 0) comes down 200 over 90 and rises as steeply; the wall's top is met
  // by floor points within the floor.
  CHECK(lowest == Approx(10 * 200 / 90.0).epsilon(1e-9));
  CHECK(highest == Approx(45).epsilon(1e-9));
  CHECK(cast_mirrored(scene, direct, 0.31).empty());
}

TEST_CASE("a ghost has its own shadow, and a mirror sends nothing through itself") {
  const auto floor = rectangle({-400, -50, 0}, {800, 0, 0}, {0, 50, 0});
  const auto wall = rectangle({-400, 0, 0}, {0, 0, 100}, {800, 0, 0});
  const auto cellar = rectangle({-400, -300, -50}, {800, 0, 0}, {0, 600, 0});  // under the floor
  const LightSheet sheet{{0, -100, 200}, {1, 0, 0}, Eigen::Vector3d(0, 75, -200).normalized(), 0.5};
  const auto heights = [&](const Scene& scene) {
    std::vector<LitLine> ghosts = cast_mirrored(scene, cast(scene, sheet), 0.01);
    double sum = 0;
    for (const LitLine& ghost : ghosts) {
      CHECK(scene.triangles().object_of(ghost.triangle) != 2);
      if (scene.triangles().object_of(ghost.triangle) == 1)
        sum += std::abs(ghost.end.z() - ghost.begin.z());
    }
    return sum;
  };
  CHECK(heights(Scene(
            {{"floor", floor, glossy()}, {"wall", wall, matt()}, {"cellar", cellar, matt()}})) ==
        Approx(100));
  // A shelf in the mirrored light's way: level at z = 30, y from -12 to -9. The direct light that
  // it stops would have come down behind the wall, from y = -100 + 88 * 200 / 170 > 0 on.
  const Scene with_shelf({{"floor", floor, glossy()},
                          {"wall", wall, matt()},
                          {"cellar", cellar, matt()},
                          {"shelf", rectangle({-400, -12, 30}, {800, 0, 0}, {0, 3, 0}), matt()}});
  // Mirrored rays start at (y, z) = (-100, -200): by the shelf's edges, 230 higher, to the wall.
  const double low = -200 + 230 * 100 / 91.0, high = -200 + 230 * 100 / 88.0;
  CHECK(heights(with_shelf) == Approx(100 - (high - low)).margin(1e-3));
}
