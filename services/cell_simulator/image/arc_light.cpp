#include "services/cell_simulator/image/arc_light.hpp"

#include <cmath>
#include <numbers>

#include "services/cell_simulator/base/random_stream.hpp"

namespace arcstart::cell_simulator {
namespace {

// Sizes are of an image 1600 px wide; px.
constexpr double kFullWidth = 1600;
constexpr double kCore = 90, kHalo = 420;  // over which the light falls to 1/e
constexpr double kHaloShare = 0.175;       // of the core's brightness
constexpr double kFlicker = 0.3;           // of the arc between frames, up and down

// Over the whole sensor, as shares of the arc's brightness.
std::vector<float> glare_of(const SensorSettings& settings) {
  std::vector<float> glare;
  if (settings.arc_grey <= 0) return glare;
  const double scale = settings.image_width_px / kFullWidth;
  const double u = settings.arc_place_share[0] * settings.image_width_px;
  const double v = settings.arc_place_share[1] * settings.image_height_px;
  for (int row = 0; row < settings.image_height_px; ++row)
    for (int column = 0; column < settings.image_width_px; ++column) {
      const double distance = std::hypot(column - u, row - v) / scale;
      const double angle = std::atan2(row - v, column - u);
      const double rays = 1 + 0.25 * std::sin(17 * angle) + 0.15 * std::sin(41 * angle);
      glare.push_back(static_cast<float>(std::exp(-distance / kCore) +
                                         kHaloShare * rays * std::exp(-distance / kHalo)));
    }
  return glare;
}

}  // namespace

ArcLight::ArcLight(const SensorSettings& settings)
    : settings_(settings), glare_(glare_of(settings)) {}

void ArcLight::add(StripeCanvas& canvas, double factor, std::uint64_t frame_seed, int offset_x,
                   int offset_y) const {
  RandomStream random(frame_seed, 61);
  const double scale = settings_.image_width_px / kFullWidth;
  if (!glare_.empty()) {
    const auto grey = static_cast<float>(settings_.arc_grey * factor *
                                         random.uniform(1 - kFlicker, 1 + kFlicker));
    const auto stride = static_cast<std::size_t>(settings_.image_width_px);
    const auto place = [&](int column, int row) {
      return static_cast<std::size_t>(row + offset_y) * stride +
             static_cast<std::size_t>(column + offset_x);
    };
    canvas.add_field([&](int column, int row) { return grey * glare_[place(column, row)]; });
  }
  const auto somewhere = [&] {
    return Eigen::Vector2d(random.uniform(0, settings_.image_width_px) - offset_x,
                           random.uniform(0, settings_.image_height_px) - offset_y);
  };
  for (int i = 0; i < settings_.spatter_streaks; ++i) {
    const Eigen::Vector2d begin = somewhere();
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double length = random.uniform(10, 70) * scale;
    const double grey = random.uniform(60, 250) * factor, sigma = random.uniform(0.8, 2) * scale;
    canvas.add({begin, begin + length * Eigen::Vector2d(std::cos(angle), std::sin(angle)), sigma,
                grey, 0});
  }
  for (int i = 0; i < settings_.glowing_drops; ++i) {
    const Eigen::Vector2d middle = somewhere();
    const double radius = random.uniform(3, 15) * scale;
    const Eigen::Vector2d half(radius, 0);
    canvas.add({middle - half, middle + half, random.uniform(3, 11) * scale,
                random.uniform(60, 260) * factor, 0});
  }
}

}  // namespace arcstart::cell_simulator
