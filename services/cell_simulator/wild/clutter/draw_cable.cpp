#include "services/cell_simulator/wild/clutter/draw_cable.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/geometry.hpp"

namespace arcstart::cell_simulator {

using Eigen::Vector3d;

void add_cable(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  constexpr double step_mm = 5;
  constexpr int reach = 3;  // points on either side that a hill lifts
  WildSolid cable;
  cable.kind = "cable";
  const double radius = draw.within(2.5, 6);
  cable.size_mm = {radius, 0, 0};
  cable.surface = {0.08, 0.1, 0.05, 0.03, 0.25, 0.02};  // black rubber
  const Vector3d middle = ground.base(
      {draw.chance(0.5) ? ground.begin() + draw.within(-30, 20) : place_along(ground, draw),
       draw.within(-40, 20), 0});
  const double heading = draw.within(0, 360) * kDegree, bend = draw.within(-0.006, 0.006);
  constexpr int half = 16;
  std::vector<Eigen::Vector2d> way(2 * half + 1);
  way[half] = middle.head<2>();
  for (const int sense : {-1, 1})
    for (int i = 1; i <= half; ++i) {
      const double angle = heading + sense * bend * step_mm * i;
      way[half + sense * i] = way[half + sense * (i - 1)] +
                              sense * step_mm * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
  const int count = static_cast<int>(way.size());
  std::vector<double> ground_height, top(way.size());
  for (const auto& p : way) {
    double high = 0;  // under the cable's whole width
    for (const auto& [dx, dy] :
         {std::pair(0.0, 0.0), {1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}})
      high = std::max(high, ground.height(p.x() + dx * radius, p.y() + dy * radius));
    ground_height.push_back(high);
  }
  for (int i = 0; i < count; ++i)
    for (int k = std::max(0, i - 2 * reach); k <= std::min(count - 1, i + 2 * reach); ++k)
      top[i] = std::max(top[i], ground_height[k]);
  for (int i = 0; i < count; ++i) {
    double sum = 0, number = 0;
    for (int k = std::max(0, i - reach); k <= std::min(count - 1, i + reach); ++k)
      sum += top[k], ++number;
    cable.points_mm.push_back(
        {way[i].x(), way[i].y(), std::max(sum / number, ground_height[i]) + radius + apart_mm});
  }
  // Not through the metal at the seam's ends: lifted there until it is clear.
  for (const double along : {ground.begin(), ground.end()}) {
    const Vector3d end = ground.base({along, 0, 0});
    const auto nearest = [&] {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i + 1 < cable.points_mm.size(); ++i) {
        const Vector3d a(cable.points_mm[i].data()), b(cable.points_mm[i + 1].data());
        const double share = std::clamp((end - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        least = std::min(least, (a + share * (b - a) - end).norm());
      }
      return least;
    };
    while (nearest() < radius + apart_mm)
      for (auto& p : cable.points_mm)
        if ((Vector3d(p.data()) - end).norm() < 4 * step_mm) p[2] += apart_mm;
  }
  solids.push_back(cable);
}

}  // namespace arcstart::cell_simulator
