#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/scene/scene_parts.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint64_t kTableStream = 1;  // of the random stream
constexpr double rough_share = 0.12;       // of the unevenness
constexpr int wave_count = 10;

}  // namespace

SceneObject make_table(const SceneSettings& settings, std::uint64_t seed) {
  RandomStream random(seed, kTableStream);
  struct Wave {
    Eigen::Vector2d number;
    double phase, height;
  };
  std::vector<Wave> waves(wave_count);
  for (Wave& wave : waves) {
    const double direction = random.uniform(0, 2 * std::numbers::pi),
                 length_mm = random.uniform(35, 250);
    wave.number = 2 * std::numbers::pi / length_mm *
                  Eigen::Vector2d(std::cos(direction), std::sin(direction));
    wave.phase = random.uniform(0, 2 * std::numbers::pi);
    wave.height = std::sqrt(length_mm);  // long waves are high, short ones low
  }
  const int cells =
      std::max(1, static_cast<int>(std::lround(settings.table_size_mm / settings.table_pitch_mm)));
  const double pitch = settings.table_size_mm / cells;
  const int corners = cells + 1;
  std::vector<double> heights;
  double highest = 0;
  for (int row = 0; row < corners; ++row) {
    for (int column = 0; column < corners; ++column) {
      const Eigen::Vector2d at(column * pitch, row * pitch);
      double height = 0;
      for (const Wave& wave : waves)
        height += wave.height * std::sin(wave.number.dot(at) + wave.phase);
      highest = std::max(highest, std::abs(height));
      heights.push_back(height);
    }
  }
  const double smooth = (1 - rough_share) * settings.table_unevenness_mm / highest;
  const double rough = rough_share * settings.table_unevenness_mm;
  const Eigen::Vector3d first(settings.work_position_mm[0] - settings.table_size_mm / 2,
                              settings.work_position_mm[1] - settings.table_size_mm / 2,
                              settings.work_position_mm[2]);
  TriangleMesh mesh;
  for (int row = 0; row < corners; ++row)
    for (int column = 0; column < corners; ++column)
      mesh.corners.push_back(first + Eigen::Vector3d(column * pitch, row * pitch,
                                                     smooth * heights[row * corners + column] +
                                                         random.uniform(-rough, rough)));
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const int a = row * corners + column, b = a + 1, c = b + corners, d = a + corners;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return {"table", std::move(mesh), {settings.table_albedo, 0.25, 1, 0, 0}};
}

}  // namespace arcstart::cell_simulator
