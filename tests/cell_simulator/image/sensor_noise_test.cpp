#include "services/cell_simulator/image/sensor_noise.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "services/cell_simulator/image/image_renderer.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

struct Statistics {
  double count = 0, sum = 0, square = 0;
  void add(double x) { ++count, sum += x, square += x * x; }
  double mean() const { return sum / count; }
  double variance() const { return square / count - mean() * mean(); }
};

// A canvas of even light, by strokes so wide that only their middle is seen.
StripeCanvas even_light(double grey, double speckle) {
  StripeCanvas canvas(0.5);
  canvas.clear(640, 480);
  canvas.add({{-100, 240}, {740, 240}, 1e5, grey, speckle});
  return canvas;
}

}  // namespace

TEST_CASE("dark noise is read noise and the ambient light's shot noise") {
  SensorSettings settings;
  settings.read_noise_grey = 1.5;
  SensorNoise noise(settings);
  for (const double gain : {1.0, 2.0}) {
    StripeCanvas canvas(0.5);
    canvas.clear(640, 480);
    std::vector<std::uint8_t> grey(640 * 480);
    Statistics all, frames;
    for (std::uint64_t frame = 0; frame < 5; ++frame) {
      noise.read_out(canvas, 20, gain, frame, 0, 0, grey.data());
      Statistics one;
      for (const std::uint8_t value : grey) all.add(value), one.add(value);
      frames.add(one.mean());
    }
    CHECK(all.mean() == Approx(20).margin(0.02));
    CHECK(all.variance() ==
          Approx(1.5 * 1.5 * gain * gain + 20 * gain / 39 + 1.0 / 12).epsilon(0.02));
    CHECK(frames.variance() < 1e-3);
  }
}

TEST_CASE("neighbours and frames have noise of their own") {
  const SensorSettings settings;
  SensorNoise noise(settings);
  StripeCanvas canvas(0.5);
  canvas.clear(640, 480);
  std::vector<std::uint8_t> one(640 * 480), two(640 * 480);
  noise.read_out(canvas, 20, 1, 1, 0, 0, one.data());
  noise.read_out(canvas, 20, 1, 2, 0, 0, two.data());
  double frames = 0, columns = 0, rows = 0, square = 0;
  for (std::size_t i = 0; i + 640 < one.size(); ++i) {
    square += (one[i] - 20.0) * (one[i] - 20.0);
    frames += (one[i] - 20.0) * (two[i] - 20.0);
    columns += (one[i] - 20.0) * (one[i + 1] - 20.0);
    rows += (one[i] - 20.0) * (one[i + 640] - 20.0);
  }
  for (const double correlation : {frames / square, columns / square, rows / square})
    CHECK(std::abs(correlation) < 0.01);
}

TEST_CASE("shot noise grows with the light as electrons do") {
  SensorSettings settings;
  settings.read_noise_grey = 2;
  SensorNoise noise(settings);
  std::vector<std::uint8_t> grey(640 * 480);
  for (const double light : {30.0, 80.0, 150.0, 200.0}) {
    const StripeCanvas canvas = even_light(light, 0);
    Statistics seen;
    for (std::uint64_t frame = 0; frame < 3; ++frame) {
      noise.read_out(canvas, 4, 1, frame, 0, 0, grey.data());
      for (const std::uint8_t value : grey) seen.add(value);
    }
    CHECK(seen.mean() == Approx(light + 4).margin(0.1));
    CHECK(seen.variance() == Approx(4 + (light + 4) / 39 + 1.0 / 12).epsilon(0.03));
  }
}

TEST_CASE("speckle is white noise blurred with sigma 1 px, at its contrast") {
  SensorSettings settings;
  settings.electrons_per_grey = 1e9;
  settings.read_noise_grey = 0;
  SensorNoise noise(settings);
  const StripeCanvas canvas = even_light(100, 0.15);
  std::vector<std::uint8_t> grey(640 * 480);
  Statistics seen;
  double lag[5] = {};
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    noise.read_out(canvas, 0, 1, frame, 0, 0, grey.data());
    for (int row = 0; row < 470; ++row) {
      for (int column = 0; column < 630; ++column) {
        const double here = grey[row * 640 + column] - 100.0;
        seen.add(here);
        for (int k = 0; k < 3; ++k) lag[k] += here * (grey[row * 640 + column + k] - 100.0);
        lag[3] += here * (grey[(row + 1) * 640 + column] - 100.0);
        lag[4] += here * (grey[(row + 4) * 640 + column + 4] - 100.0);
      }
    }
  }
  CHECK(seen.mean() == Approx(0).margin(0.5));
  CHECK(std::sqrt(seen.variance()) == Approx(15).epsilon(0.03));
  // A Gaussian blur of sigma 1 correlates as exp(-k^2 / 4).
  CHECK(lag[1] / lag[0] == Approx(std::exp(-0.25)).margin(0.02));
  CHECK(lag[2] / lag[0] == Approx(std::exp(-1.0)).margin(0.03));
  CHECK(lag[3] / lag[0] == Approx(std::exp(-0.25)).margin(0.02));
  CHECK(std::abs(lag[4] / lag[0]) < 0.03);
}

TEST_CASE("what is too bright saturates, what is too dark is black") {
  const SensorSettings settings;
  SensorNoise noise(settings);
  std::vector<std::uint8_t> grey(640 * 480);
  noise.read_out(even_light(2000, 0.15), 4, 1, 1, 0, 0, grey.data());
  for (const std::uint8_t value : grey) REQUIRE(value == 255);
  StripeCanvas dark(0.5);
  dark.clear(640, 480);
  noise.read_out(dark, 0, 1, 1, 0, 0, grey.data());
  int black = 0;
  for (const std::uint8_t value : grey) {
    REQUIRE(value < 20);
    black += value == 0;
  }
  CHECK(black > 640 * 480 / 2);
}

TEST_CASE("strokes laid end to end make one even line") {
  StripeCanvas whole(0.5), pieces(0.5);
  whole.clear(200, 150);
  pieces.clear(200, 150);
  const Eigen::Vector2d begin(20.3, 40.7), end(180.1, 95.2);
  whole.add({begin, end, 1.7, 100, 0.15});
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2d step = (end - begin) / 30;
    pieces.add({begin + i * step, begin + (i + 1) * step, 1.7, 100, 0.15});
  }
  double worst = 0, sum = 0;
  for (int row = 0; row < 150; ++row) {
    for (int column = 0; column < 200; ++column) {
      worst =
          std::max<double>(worst, std::abs(whole.light(row)[column] - pieces.light(row)[column]));
      CHECK(whole.speckle(row)[column] == Approx(0.15 * whole.light(row)[column]).margin(1e-4));
      sum += whole.light(row)[column];
    }
  }
  CHECK(worst < 0.01);
  CHECK(sum == Approx(100 * 1.7 * std::sqrt(2 * 3.14159265) * (end - begin).norm()).epsilon(1e-3));
  CHECK(pieces.lit(100 / 32, 68 / 8));
  // Nothing is left of it afterwards, and a stroke outside or without length leaves nothing.
  whole.clear(200, 150);
  whole.add({{300, 20}, {320, 30}, 2, 100, 0});
  whole.add({{50, 20}, {50, 20}, 2, 100, 0});
  for (int row = 0; row < 150; ++row) {
    for (int column = 0; column < 200; ++column) {
      REQUIRE(whole.light(row)[column] == 0);
      REQUIRE_FALSE(whole.lit(column / 32, row / 8));
    }
  }
}
