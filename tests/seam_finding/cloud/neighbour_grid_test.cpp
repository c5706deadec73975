#include "services/seam_finding/cloud/neighbour_grid.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

std::vector<Eigen::Vector3d> random_points(int count, double half_side) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> place(-half_side, half_side);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(engine), place(engine), place(engine));
  return points;
}

}  // namespace

TEST_CASE("every point lies in the cell it is asked for, and in no other") {
  const auto points = random_points(5000, 80);
  const NeighbourGrid grid(points, 7.3);
  std::vector<int> seen(points.size(), 0);
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    CHECK(grid.index_of(grid.cell(cell)) == cell);
    for (const int i : grid.points_in(cell)) {
      ++seen[i];
      CHECK(grid.cell_of(points[i]) == grid.cell(cell));
    }
  }
  CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  CHECK(grid.index_of({5000, 0, 0}) == -1);
  CHECK(grid.points_in(NeighbourGrid::Cell(5000, 0, 0)).empty());
}

TEST_CASE("nearest distances are those of a search through all") {
  const auto points = random_points(3000, 20);
  const NeighbourGrid grid(points, 4);
  std::vector<double> found, all;
  for (int i = 0; i < 200; ++i) {
    grid.nearest_distances(i, 6, found);
    all.clear();
    for (std::size_t j = 0; j < points.size(); ++j)
      if (static_cast<int>(j) != i) all.push_back((points[j] - points[i]).norm());
    std::sort(all.begin(), all.end());
    REQUIRE(found.size() == 6);
    // What is nearer than a cell's side lies in the cells around.
    for (int k = 0; k < 6; ++k)
      if (all[k] < 4) CHECK(found[k] == Approx(all[k]));
  }
}

TEST_CASE("points far beyond the grid's range share its outermost cells") {
  const std::vector<Eigen::Vector3d> points = {{1e30, 0, 0}, {2e30, 0, 0}, {0, -1e30, 0}};
  const NeighbourGrid grid(points, 1);
  CHECK(grid.cell_count() == 2);
  CHECK(grid.points_in(grid.cell_of({3e30, 0, 0})).size() == 2);
}

TEST_CASE("a crowd of equal points is answered from a part of it") {
  const std::vector<Eigen::Vector3d> points(200000, Eigen::Vector3d(1, 2, 3));
  const NeighbourGrid grid(points, 1);
  std::vector<double> distances;
  for (int i = 0; i < 2000; ++i) grid.nearest_distances(i, 10, distances);
  CHECK(distances == std::vector<double>(10, 0.0));
}

TEST_CASE("cells that touch are the same by the list of all and by looking each up") {
  for (const double half_side : {3.0, 30.0, 1e8}) {
    const auto points = random_points(3000, half_side);
    const NeighbourGrid grid(points, half_side < 1e6 ? 2.5 : 40);
    const auto adjacency = grid.adjacency();
    const auto cells = grid.cells_of_points();
    for (int i = 0; i < grid.cell_count(); ++i) {
      std::vector<int> around;
      grid.for_each_around(grid.cell(i), [&](int j) { around.push_back(j); });
      const auto listed = adjacency.of(i);
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
      REQUIRE(around == std::vector<int>(listed.begin(), listed.end()));
      for (const int point : grid.points_in(i)) REQUIRE(cells[point] == i);
    }
  }
}
