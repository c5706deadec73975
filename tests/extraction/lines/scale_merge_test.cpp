#include "services/extraction/lines/scale_merge.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "services/extraction/lines/course_evidence.hpp"

using namespace arcstart::extraction;

namespace {

// A level chain at this row, of one curvature, over columns begin to end.
void add_level(std::vector<RidgePoint>& points, std::vector<Chain>& chains, int begin, int end,
               int row, float curvature) {
  Chain& chain = chains.emplace_back();
  for (int u = begin; u < end; ++u) {
    chain.push_back(static_cast<int>(points.size()));
    points.push_back({static_cast<float>(u), static_cast<float>(row), 0, 1, curvature, u, row});
  }
}

struct Found {
  std::vector<RidgePoint> points;
  std::vector<Chain> chains;
};

int chained_at(const ScaledLines& lines, int column, float sigma) {
  int count = 0;
  for (const Chain& chain : lines.chains)
    for (const int i : chain) count += lines.points[i].column == column && lines.sigmas[i] == sigma;
  return count;
}

}  // namespace

TEST_CASE("of two scales on one line the stronger is kept, at each place its own") {
  // The line is strong at sigma 2 on the left, at sigma 8 on the right; strengths 4 and 8 times the
  // curvature.
  ScaledLines lines;
  Found fine, coarse;
  add_level(fine.points, fine.chains, 0, 200, 50, 10);
  for (int u = 100; u < 200; ++u) fine.points[u].curvature = 2;
  add_level(coarse.points, coarse.chains, 0, 200, 53, 2);
  lines.add(fine.points, fine.chains, 2, 4, 4, heap());
  lines.add(coarse.points, coarse.chains, 8, 8, 4, heap());
  CHECK(lines.points[0].curvature == 10);
  CHECK(lines.points[200].curvature == 4);  // in units of the first factor
  keep_best_scale(lines, 5, heap());
  CHECK(chained_at(lines, 50, 2) == 1);
  CHECK(chained_at(lines, 50, 8) == 0);
  CHECK(chained_at(lines, 150, 2) == 0);
  CHECK(chained_at(lines, 150, 8) == 1);
  for (int u = 0; u < 200; ++u) REQUIRE(chained_at(lines, u, 2) + chained_at(lines, u, 8) >= 1);
}

TEST_CASE("lines that are apart, or cross, are no scales of one another") {
  ScaledLines lines;
  Found fine, coarse;
  add_level(fine.points, fine.chains, 0, 100, 50, 1);
  Chain& down = fine.chains.emplace_back();
  for (int v = 60; v < 110; ++v) {
    down.push_back(static_cast<int>(fine.points.size()));
    fine.points.push_back({40, static_cast<float>(v), 1, 0, 1, 40, v});
  }
  add_level(coarse.points, coarse.chains, 0, 100, 70, 10);
  lines.add(fine.points, fine.chains, 2, 1, 1, heap());
  lines.add(coarse.points, coarse.chains, 8, 1, 1, heap());
  keep_best_scale(lines, 5, heap());
  REQUIRE(lines.chains.size() == 3);
  CHECK(lines.chains[0].size() == 100);
  CHECK(lines.chains[1].size() == 50);
  CHECK(lines.chains[2].size() == 100);
}

TEST_CASE("evidence: one course across the image outweighs as many centres in pieces") {
  const auto evidence_of = [](int pieces) {
    Found found;
    StripePath course;
    for (int k = 0; k < pieces; ++k) {
      add_level(found.points, found.chains, k * 100 / pieces, (k + 1) * 100 / pieces, 50, 3);
      course.branches.push_back({found.chains.back()});
    }
    add_level(found.points, found.chains, 0, 100, 80, 1);
    add_level(found.points, found.chains, 0, 100, 90, 2);
    return course_evidence(found.points, found.chains, course, 2, 100, heap());
  };
  const CourseEvidence whole = evidence_of(1), quarters = evidence_of(4);
  CHECK(whole.weight == Approx(600));  // 100 centres of strength 6, all across
  CHECK(quarters.weight == Approx(300));
  CHECK(whole.centres == 100);
  CHECK(whole.faint == 6);
  CHECK(whole.usual == 6);
  CHECK((whole.others == 2 || whole.others == 4));
  CHECK(course_evidence({}, {}, {}, 2, 100, heap()).weight == 0);
}
