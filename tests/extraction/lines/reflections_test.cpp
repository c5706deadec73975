#include "services/extraction/lines/reflections.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

// Lines of points a pixel apart, as ridges linked into a chain each.
class Scene {
 public:
  int add(double u0, double v0, double u1, double v1, double strength) {
    return add(u0, v0, u1, v1, strength, strength);
  }
  // Its strength runs from the one to the other.
  int add(double u0, double v0, double u1, double v1, double from, double to) {
    const double length = std::hypot(u1 - u0, v1 - v0);
    for (int i = 0; i <= length; ++i) {
      const double u = u0 + (u1 - u0) * i / length, v = v0 + (v1 - v0) * i / length;
      lines_.push_back(
          {{static_cast<float>(u), static_cast<float>(v), static_cast<float>(-(v1 - v0) / length),
            static_cast<float>((u1 - u0) / length),
            static_cast<float>(from + (to - from) * i / length), static_cast<int>(std::lround(u)),
            static_cast<int>(std::lround(v))},
           count_});
    }
    return count_++;
  }

  // Share of each line's points that lie in a strand marked as a reflection.
  std::vector<double> reflected(bool along_rows = false) {
    std::stable_sort(lines_.begin(), lines_.end(), [](const auto& a, const auto& b) {
      return std::pair(a.first.row, a.first.column) < std::pair(b.first.row, b.first.column);
    });
    std::vector<RidgePoint> points;
    std::vector<Chain> chains(count_);
    std::vector<int> line_of;
    for (const auto& [point, line] : lines_) {
      chains[line].push_back(static_cast<int>(points.size()));
      line_of.push_back(line);
      points.push_back(point);
    }
    for (Chain& chain : chains)  // raster order is not order along the line
      std::sort(chain.begin(), chain.end(), [&](int a, int b) {
        const float ka = along_rows ? points[a].v : points[a].u,
                    kb = along_rows ? points[b].v : points[b].u;
        return ka < kb;
      });
    const Sight sight{along_rows, 0, 899};
    FrameVector<Strand> strands = cut_at_junctions(points, chains, sight, 6);
    mark_reflections(points, sight, strands);
    std::vector<double> share(count_, 0);
    std::size_t all = 0;
    for (const Strand& strand : strands) {
      all += strand.points.size();
      for (const int i : strand.points)
        if (strand.reflection)
          share[line_of[i]] += 1.0 / static_cast<double>(chains[line_of[i]].size());
    }
    REQUIRE(all == points.size());  // cut, never lost or doubled
    return share;
  }

 private:
  std::vector<std::pair<RidgePoint, int>> lines_;
  int count_ = 0;
};

}  // namespace

TEST_CASE("a lone stripe in pieces is no reflection of itself") {
  Scene scene;
  scene.add(0, 100, 300, 130, 10);
  scene.add(330, 133, 600, 160, 3);
  scene.add(601, 90, 900, 100, 8);
  for (const double share : scene.reflected()) CHECK(share == 0);
}

TEST_CASE("what runs beside a stronger stripe is its reflection, over that one's gap too") {
  Scene scene;
  const int left = scene.add(0, 100, 300, 130, 10), right = scene.add(370, 137, 900, 190, 10);
  const int ghost = scene.add(250, 190, 480, 213, 3.5);
  const auto share = scene.reflected();
  CHECK(share[left] == 0);
  CHECK(share[right] == 0);
  CHECK(share[ghost] == Approx(1));
}

TEST_CASE("a bright blob beside a long stripe does not make it a reflection") {
  Scene scene;
  const int stripe = scene.add(0, 100, 900, 130, 5);
  scene.add(400, 200, 435, 210, 40);
  CHECK(scene.reflected()[stripe] == 0);
}

TEST_CASE(
    "of two lines that leave a corner the weaker hanging one is the reflection, however long") {
  Scene scene;
  const int base = scene.add(0, 200, 400, 100, 10);
  const int upright = scene.add(402, 101, 450, 125, 8);
  const int ghost = scene.add(403, 99, 650, 40, 4);
  const auto share = scene.reflected();
  CHECK(share[base] == 0);
  CHECK(share[upright] == 0);
  CHECK(share[ghost] == Approx(1));
}

TEST_CASE(
    "of two lines from a corner that are nearly as strong the one that fades is the reflection") {
  Scene scene;
  const int base = scene.add(0, 200, 400, 100, 10);
  const int upright = scene.add(402, 101, 500, 225, 9);
  const int ghost = scene.add(403, 99, 560, 30, 7, 3);
  const auto share = scene.reflected();
  CHECK(share[base] == 0);
  CHECK(share[upright] == 0);
  CHECK(share[ghost] == Approx(1));

  // Neither fades, and neither is much stronger: that is not for strengths to tell.
  Scene alike;
  alike.add(0, 200, 400, 100, 10);
  alike.add(402, 101, 500, 225, 9);
  alike.add(403, 99, 560, 30, 7);
  for (const double part : alike.reflected()) CHECK(part == 0);
}

TEST_CASE("a dim surface that leads to the next is the stripe, a brighter line to nowhere is not") {
  Scene scene;
  const int table = scene.add(0, 200, 400, 160, 10);
  const int face = scene.add(402, 161, 480, 170, 4);
  const int plate = scene.add(483, 170, 900, 130, 10);
  const int ghost = scene.add(402, 162, 470, 215, 7);
  const auto share = scene.reflected();
  CHECK(share[table] == 0);
  CHECK(share[face] == 0);
  CHECK(share[plate] == 0);
  CHECK(share[ghost] == Approx(1));
}

TEST_CASE("the tip that a stripe leaves beside a step does not make what follows its reflection") {
  // The lower plate goes on behind the step for a few columns, and the upper one's edge, seen
  // there, leads back to it.
  Scene scene;
  const int lower = scene.add(0, 170, 405, 76, 9), upper = scene.add(401, 92, 600, 166, 6);
  const int behind = scene.add(570, 20, 900, 0, 6);
  const auto share = scene.reflected();
  for (const int line : {lower, upper, behind}) CHECK(share[line] == 0);
}

TEST_CASE("along rows it is the same") {
  Scene scene;
  const int base = scene.add(200, 0, 100, 400, 10);
  const int upright = scene.add(101, 402, 125, 450, 8);
  const int ghost = scene.add(99, 403, 40, 650, 4);
  const auto share = scene.reflected(true);
  CHECK(share[base] == 0);
  CHECK(share[upright] == 0);
  CHECK(share[ghost] == Approx(1));
}

TEST_CASE("nothing gives nothing") {
  FrameVector<Strand> strands = cut_at_junctions({}, {}, Sight{}, 6);
  CHECK(strands.empty());
  mark_reflections({}, Sight{}, strands);
}
