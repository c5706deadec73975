// What an arc that burns close by throws into the image: glare with rays, streaks of spatter in
// flight, and drops that glow on the metal.
#pragma once

#include <cstdint>
#include <vector>

#include "services/cell_simulator/image/sensor_settings.hpp"
#include "services/cell_simulator/image/stripe_canvas.hpp"

namespace arcstart::cell_simulator {

class ArcLight {
 public:
  explicit ArcLight(const SensorSettings& settings);

  // Adds it to a canvas whose first pixel is the sensor's (offset_x, offset_y); nothing where the
  // settings have no arc. The glare stands at the same place in all frames, as a torch on the same
  // robot does; the frame seed makes its flicker and the spatter. factor: on the settings' grey
  // levels, of the exposure. What hangs over the canvas' edge is cut off.
  void add(StripeCanvas& canvas, double factor, std::uint64_t frame_seed, int offset_x,
           int offset_y) const;

 private:
  SensorSettings settings_;
  std::vector<float> glare_;  // of every pixel of the sensor, over the arc's brightness
};

}  // namespace arcstart::cell_simulator
