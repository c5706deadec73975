#include "services/cell_simulator/image/sensor_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "services/cell_simulator/base/random_stream.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint64_t noise_seed =
    0x6c61736572ull;                      // the frame's own seed chooses places in these fields
constexpr std::size_t starts = 1u << 20;  // of rows in the normals
constexpr std::size_t longest_row = 4096;
constexpr int speckle_size = 1024;  // a power of two

std::uint64_t hash(std::uint64_t seed, std::uint64_t number) {
  return RandomStream(seed, number + 1).next();
}

std::vector<float> make_normals() {
  RandomStream random(noise_seed, 1);
  std::vector<float> normals(starts + longest_row);
  for (float& value : normals) value = static_cast<float>(random.normal());
  return normals;
}

// White noise blurred with sigma 1 px, along rows and then along columns, made to mean 0 and
// deviation 1.
std::vector<float> make_speckle() {
  constexpr int n = speckle_size, reach = 5;
  RandomStream random(noise_seed, 2);
  std::vector<float> field(std::size_t(n) * n), blurred(field.size());
  std::array<double, 2 * reach + 1> weights;
  for (int k = -reach; k <= reach; ++k) weights[k + reach] = std::exp(-0.5 * k * k);
  for (float& value : field) value = static_cast<float>(random.normal());
  const auto blur = [&](const std::vector<float>& from, std::vector<float>& to, int step_x,
                        int step_y) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        double sum = 0;
        for (int k = -reach; k <= reach; ++k)
          sum += weights[k + reach] *
                 from[((y + k * step_y) & (n - 1)) * n + ((x + k * step_x) & (n - 1))];
        to[y * n + x] = static_cast<float>(sum);
      }
    }
  };
  blur(field, blurred, 1, 0);
  blur(blurred, field, 0, 1);
  double mean = 0, square = 0;
  for (const float value : field) mean += value;
  mean /= static_cast<double>(field.size());
  for (const float value : field) square += (value - mean) * (value - mean);
  const double deviation = std::sqrt(square / static_cast<double>(field.size()));
  for (float& value : field) value = static_cast<float>((value - mean) / deviation);
  return field;
}

std::uint8_t rounded(float grey) {
  return static_cast<std::uint8_t>(std::min(std::max(grey, 0.0f), 255.0f) + 0.5f);
}

}  // namespace

SensorNoise::SensorNoise(const SensorSettings& settings)
    : read_noise_(settings.read_noise_grey),
      grey_per_electron_(1 / settings.electrons_per_grey),
      normals_(make_normals()),
      speckle_(make_speckle()) {}

std::size_t SensorNoise::start_of_row(std::uint64_t frame_seed, int y) const {
  return hash(frame_seed, static_cast<std::uint64_t>(y)) % starts;
}

void SensorNoise::make_dark(double ambient_grey, double gain) {
  if (dark_ambient_ == ambient_grey && dark_gain_ == gain) return;
  dark_ambient_ = ambient_grey;
  dark_gain_ = gain;
  const double read_noise = read_noise_ * gain;
  const auto deviation = static_cast<float>(
      std::sqrt(read_noise * read_noise + ambient_grey * gain * grey_per_electron_));
  dark_.resize(normals_.size());
  for (std::size_t i = 0; i < dark_.size(); ++i)
    dark_[i] = rounded(static_cast<float>(ambient_grey) + deviation * normals_[i]);
}

void SensorNoise::read_out(const StripeCanvas& canvas, double ambient_grey, double gain,
                           std::uint64_t frame_seed, int offset_x, int offset_y,
                           std::uint8_t* grey) {
  make_dark(ambient_grey, gain);
  const auto read_variance = static_cast<float>(read_noise_ * read_noise_ * gain * gain);
  const auto shot_variance = static_cast<float>(gain * grey_per_electron_);  // of one grey level
  const auto ambient = static_cast<float>(ambient_grey);
  const std::uint64_t speckle_place = hash(frame_seed, 1u << 20);  // no row has this number
  const int speckle_x = offset_x + static_cast<int>(speckle_place & 0xffff);
  const int speckle_y = offset_y + static_cast<int>((speckle_place >> 16) & 0xffff);
  for (int row = 0; row < canvas.height(); ++row) {
    const int y = row + offset_y;
    const float* speckle_row =
        &speckle_[std::size_t((row + speckle_y) & (speckle_size - 1)) * speckle_size];
    const std::size_t start = start_of_row(frame_seed, y) + static_cast<std::size_t>(offset_x);
    std::uint8_t* out = grey + std::size_t(row) * canvas.width();
    std::memcpy(out, &dark_[start], static_cast<std::size_t>(canvas.width()));
    const std::span<const float> light = canvas.light(row), light_speckle = canvas.speckle(row);
    for (int block = 0; block < canvas.blocks_across(); ++block) {
      if (!canvas.lit(block, row / StripeCanvas::block_height)) continue;
      const int begin = block * StripeCanvas::block_width;
      const int end = std::min(begin + StripeCanvas::block_width, canvas.width());
      float grain[StripeCanvas::block_width];
      for (int x = begin; x < end; ++x)
        grain[x - begin] = speckle_row[(x + speckle_x) & (speckle_size - 1)];
      for (int x = begin; x < end; ++x) {
        const float mean = ambient + std::max(0.0f, light[x] + light_speckle[x] * grain[x - begin]);
        out[x] =
            rounded(mean + std::sqrt(read_variance + shot_variance * mean) * normals_[start + x]);
      }
    }
  }
}

}  // namespace arcstart::cell_simulator
