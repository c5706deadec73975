// Speckle, shot noise and read noise, drawn once and laid over each frame from another place.
#pragma once

#include <cstdint>
#include <vector>

#include "services/cell_simulator/image/sensor_settings.hpp"
#include "services/cell_simulator/image/stripe_canvas.hpp"

namespace arcstart::cell_simulator {

class SensorNoise {
 public:
  explicit SensorNoise(const SensorSettings& settings);

  // The canvas under ambient light as the camera reads it: rounded and saturated, at 255. The
  // canvas' first pixel is the sensor's (offset_x, offset_y): a part of the sensor shows what the
  // whole shows there. gain: factor on electrons. grey: width * height bytes.
  void read_out(const StripeCanvas& canvas, double ambient_grey, double gain,
                std::uint64_t frame_seed, int offset_x, int offset_y, std::uint8_t* grey);

 private:
  std::size_t start_of_row(std::uint64_t frame_seed, int y) const;
  void make_dark(double ambient_grey, double gain);

  double read_noise_, grey_per_electron_;
  std::vector<float> normals_;                 // standard deviation 1
  std::vector<float> speckle_;                 // a square that repeats without a seam
  std::vector<std::uint8_t> dark_;             // what `normals_` make of ambient light alone
  double dark_ambient_ = -1, dark_gain_ = -1;  // for which
};

}  // namespace arcstart::cell_simulator
