// Polygons with holes in a plane, cut into triangles; mm.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace arcstart::cell_simulator {

// The outline counter-clockwise, then holes clockwise. Corners are numbered through all rings.
using Rings = std::vector<std::vector<Eigen::Vector2d>>;

// Triangles, counter-clockwise, by the corners' numbers. By clipping ears (Meisters 1975), each
// hole first bridged to the ring around it (Eberly, "Triangulation by ear clipping").
std::vector<std::array<int, 3>> triangulate(const Rings& rings);

// Twice the area, above 0 where counter-clockwise.
double twice_area(const std::vector<Eigen::Vector2d>& ring);

// A circle of so many corners that none of its chords lies farther than 0.01 mm inside.
std::vector<Eigen::Vector2d> circle(const Eigen::Vector2d& middle, double radius);

// Corners of an arc about `middle` from one angle to another (rad), both included, as finely.
std::vector<Eigen::Vector2d> arc(const Eigen::Vector2d& middle, double radius, double from,
                                 double to);

}  // namespace arcstart::cell_simulator
