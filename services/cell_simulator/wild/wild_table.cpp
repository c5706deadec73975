#include "services/cell_simulator/wild/wild_table.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/geometry.hpp"
#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/scene/scene_settings.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint64_t purpose = 11;  // of the random stream
constexpr double cell_mm = 14;         // of the plate's mesh

// Long waves whose sum stays within the table's unevenness.
class Unevenness {
 public:
  Unevenness(double highest, std::uint64_t seed) {
    RandomStream random(seed, purpose);
    for (Wave& wave : waves_) {
      const double direction = random.uniform(0, 2 * std::numbers::pi);
      const double number = 2 * std::numbers::pi / random.uniform(60, 300);
      wave = {number * std::cos(direction), number * std::sin(direction),
              random.uniform(0, 2 * std::numbers::pi)};
    }
    height_ = highest / std::size(waves_);
  }
  double operator()(double x, double y) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.kx * x + wave.ky * y + wave.phase);
    return height_ * sum;
  }

 private:
  struct Wave {
    double kx, ky, phase;
  };
  Wave waves_[6];
  double height_;
};

TriangleMesh make_even_table(const WildTable& table) {
  const Unevenness height(table.unevenness_mm, table.seed);
  const int cells = std::max(1, static_cast<int>(std::lround(table.size_mm / cell_mm)));
  const double pitch = table.size_mm / cells;
  TriangleMesh mesh;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const double x = column * pitch - table.size_mm / 2, y = row * pitch - table.size_mm / 2;
      mesh.corners.emplace_back(x, y, height(x, y));
    }
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const int a = row * (cells + 1) + column, b = a + 1, c = b + cells + 1, d = c - 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

// Planks along x with channels between them.
TriangleMesh make_slotted_table(const WildTable& table) {
  const double half = table.size_mm / 2, depth = table.slot_depth_mm;
  TriangleMesh mesh = make_box({-half, -half, -depth - 10}, {half, half, -depth});
  for (double y = -half + table.slot_offset_mm - table.slot_pitch_mm; y < half;
       y += table.slot_pitch_mm) {
    const double low = std::max(-half, y + table.slot_width_mm / 2),
                 high = std::min(half, y + table.slot_pitch_mm - table.slot_width_mm / 2);
    if (high > low) append(mesh, make_box({-half, low, -depth}, {half, high, 0}));
  }
  RigidTransform turn = RigidTransform::Identity();
  turn.linear() =
      Eigen::AngleAxisd(table.slot_turn_deg * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return transformed(mesh, turn);
}

}  // namespace

TriangleMesh make_wild_table(const WildScene& wild) {
  RigidTransform place = RigidTransform::Identity();
  place.translation() = Eigen::Vector3d(SceneSettings{}.work_position_mm.data());
  return transformed(
      wild.table.slot_pitch_mm > 0 ? make_slotted_table(wild.table) : make_even_table(wild.table),
      place);
}

}  // namespace arcstart::cell_simulator
