#include "services/cell_simulator/wild/solid_shapes.hpp"

#include <catch2/catch.hpp>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "tests/cell_simulator/wild/winding.hpp"

namespace arcstart::cell_simulator {
namespace {

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (mesh.corners[b] - mesh.corners[a]).cross(mesh.corners[c] - mesh.corners[a]).norm() / 2;
  return sum;
}

}  // namespace

TEST_CASE("A sliced solid is the same solid, in triangles no longer than the step") {
  const TriangleMesh box = make_box({-30, 0, 0}, {41, 10, 5}), slices = sliced(box, 7);
  CHECK(area(slices) == Approx(area(box)));
  for (const auto& [a, b, c] : slices.triangles) {
    const auto [low, high] =
        std::minmax({slices.corners[a].x(), slices.corners[b].x(), slices.corners[c].x()});
    CHECK(high - low <= 7 + 1e-9);
  }
  CHECK(winding(slices, {0.5, 5, 2}) == Approx(1));
  CHECK(winding(slices, {0.5, 11, 2}) == Approx(0).margin(1e-9));
}

TEST_CASE("A loft is not inside out, whichever way its layers run") {
  const Rings square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  const auto layer = [&](double z) {
    std::vector<Eigen::Vector3d> places;
    for (const auto& p : square[0]) places.emplace_back(p.x(), p.y(), z);
    return places;
  };
  CHECK(winding(loft(square, {layer(0), layer(4), layer(5)}), {5, 5, 2}) == Approx(1));
  CHECK(winding(loft(square, {layer(5), layer(0)}), {5, 5, 2}) == Approx(1));
}

TEST_CASE("What lies about has the size and the place that is told") {
  WildSolid bar;
  bar.kind = "round";
  bar.size_mm = {40, 5, 0};
  bar.position_mm = {900, 10, 5};
  bar.quaternion = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // along y
  const TriangleMesh mesh = mesh_of(bar);
  CHECK(winding(mesh, {904.9, 29.9, 5}) == Approx(1).margin(1e-6));
  CHECK(winding(mesh, {905.1, 29.9, 5}) == Approx(0).margin(1e-6));
  CHECK(winding(mesh, {900, 30.1, 5}) == Approx(0).margin(1e-6));

  WildSolid cable;
  cable.kind = "cable";
  cable.size_mm = {4, 0, 0};
  cable.points_mm = {{0, 0, 4}, {20, 0, 4}, {20, 20, 10}};
  CHECK(winding(mesh_of(cable), {10, 3.8, 4}) > 0.9);
  CHECK(winding(mesh_of(cable), {10, 10, 4}) == Approx(0).margin(1e-6));
  bar.kind = "spoon";
  CHECK_THROWS_AS(mesh_of(bar), SceneError);
}

}  // namespace arcstart::cell_simulator
