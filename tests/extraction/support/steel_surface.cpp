#include "tests/extraction/support/steel_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace arcstart::extraction {
namespace {

class SurfaceRenderer {
 public:
  SurfaceRenderer(cv::Size size, double angle, std::uint64_t seed)
      : size_(size), angle_(angle), random_(seed) {}

  SurfaceLight render(SteelSurface surface) {
    cv::Mat relief = cv::Mat::zeros(size_, CV_32F);  // logarithm of the reflectance
    cv::Mat glints = cv::Mat::zeros(size_, CV_32F);
    switch (surface) {
      case SteelSurface::kGround:
        relief = uniform(0.10, 0.18) * grain(uniform(40, 150), uniform(0.8, 1.5));
        add_scratches(glints, 250, 60, 400, 0.03);
        break;
      case SteelSurface::kMilled:
        relief = uniform(0.10, 0.22) * feed_marks(uniform(6, 25)) + 0.05 * grain(20, 1);
        add_scratches(glints, 40, 30, 150, 0.05);
        break;
      case SteelSurface::kBrushed:
        relief = uniform(0.08, 0.15) * grain(uniform(20, 60), uniform(0.7, 1.2));
        add_scratches(glints, 120, 30, 120, 0.10);
        break;
      case SteelSurface::kShotBlasted:
        relief = uniform(0.12, 0.25) * grain_of(uniform(1.5, 3));
        add_specks(glints, 3000);
        break;
      case SteelSurface::kScale:
        relief = 0.10 * grain_of(2) + uniform(0.10, 0.25) * flakes(uniform(15, 40));
        break;
      case SteelSurface::kRust:
        relief = uniform(0.10, 0.20) * grain_of(uniform(2, 5)) + 0.20 * grain_of(40);
        break;
      case SteelSurface::kPrimer:
        relief = uniform(0.03, 0.07) * grain_of(1);
        break;
      case SteelSurface::kOil:
        relief = 0.06 * grain_of(2) + 0.20 * flakes(60);
        add_sheen(glints, 8);
        break;
      case SteelSurface::kGalvanised:
        relief = uniform(0.10, 0.20) * spangles(uniform(20, 60)) + 0.03 * grain_of(1);
        break;
    }
    SurfaceLight light;
    cv::exp(relief, light.reflectance);
    light.reflectance /= cv::mean(light.reflectance)[0];
    light.glints = glints;
    return light;
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  cv::Mat white_noise(cv::Size size) {
    cv::Mat noise(size, CV_32F);
    cv::RNG(random_()).fill(noise, cv::RNG::NORMAL, 0, 1);
    return noise;
  }
  static cv::Mat of_unit_variance(const cv::Mat& noise) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(noise, mean, deviation);
    return (noise - mean[0]) / deviation[0];
  }

  // Noise of a grain of these sigmas along and across the lay, of unit variance. Drawn coarser
  // along the lay, then stretched and turned.
  cv::Mat grain(double along, double across) {
    const double stretch = std::max(1.0, along / 4),
                 diagonal = std::hypot(size_.width, size_.height);
    cv::Mat noise =
        white_noise({static_cast<int>(diagonal / stretch) + 8, static_cast<int>(diagonal) + 8});
    cv::GaussianBlur(noise, noise, {}, along / stretch, across);
    // From a place in the image to one in the noise.
    const double c = std::cos(angle_), s = std::sin(angle_), u0 = size_.width / 2.0,
                 v0 = size_.height / 2.0;
    const cv::Matx23d place(c / stretch, s / stretch,
                            noise.cols / 2.0 - (c * u0 + s * v0) / stretch, -s, c,
                            noise.rows / 2.0 - (-s * u0 + c * v0));
    cv::Mat turned;
    cv::warpAffine(noise, turned, place, size_, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REFLECT_101);
    return of_unit_variance(turned);
  }
  // The same in all directions; drawn smaller where it is coarse.
  cv::Mat grain_of(double sigma) {
    const double scale = std::max(1.0, sigma / 4);
    cv::Mat noise = white_noise(
        {static_cast<int>(size_.width / scale) + 1, static_cast<int>(size_.height / scale) + 1});
    cv::GaussianBlur(noise, noise, {}, sigma / scale);
    cv::resize(noise, noise, size_, 0, 0, cv::INTER_CUBIC);
    return of_unit_variance(noise);
  }
  // Patches of two kinds with sharp borders.
  cv::Mat flakes(double sigma) {
    cv::Mat noise = grain_of(sigma), flakes;
    noise.forEach<float>([](float& value, const int*) { value = std::tanh(4 * value); });
    cv::GaussianBlur(noise, flakes, {}, 0.8);
    return flakes;
  }
  // Arcs of a face mill of a radius of 1500 px, a tooth every `period` px.
  cv::Mat feed_marks(double period) {
    cv::Mat marks(size_, CV_32F);
    const double u0 = size_.width / 2.0 - 1500 * std::sin(angle_),
                 v0 = size_.height / 2.0 + 1500 * std::cos(angle_);
    const cv::Mat uneven = grain_of(30);
    marks.forEach<float>([&](float& value, const int* at) {
      const double radius = std::hypot(at[1] - u0, at[0] - v0);
      const double phase = 2 * CV_PI * radius / period + 0.5 * uneven.at<float>(at[0], at[1]);
      value = static_cast<float>(1.2 * std::sin(phase) + 0.4 * std::sin(2 * phase));
    });
    return marks;
  }
  // Crystals of zinc: the nearest of points strewn over the image gives its own shade.
  cv::Mat spangles(double size) {
    const int columns = static_cast<int>(size_.width / size) + 3,
              rows = static_cast<int>(size_.height / size) + 3;
    std::vector<cv::Point2d> seeds;
    std::vector<float> shades;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        seeds.emplace_back((i - 1 + uniform(0, 1)) * size, (j - 1 + uniform(0, 1)) * size);
        shades.push_back(static_cast<float>(uniform(-1.7, 1.7)));
      }
    cv::Mat crystals(size_, CV_32F);
    crystals.forEach<float>([&](float& value, const int* at) {
      const int i0 = static_cast<int>(at[1] / size) + 1, j0 = static_cast<int>(at[0] / size) + 1;
      double nearest = std::numeric_limits<double>::max();
      for (int j = std::max(0, j0 - 1); j <= std::min(rows - 1, j0 + 1); ++j)
        for (int i = std::max(0, i0 - 1); i <= std::min(columns - 1, i0 + 1); ++i) {
          const auto seed = static_cast<std::size_t>(j * columns + i);
          const double distance = std::hypot(seeds[seed].x - at[1], seeds[seed].y - at[0]);
          if (distance >= nearest) continue;
          nearest = distance;
          value = shades[seed];
        }
    });
    cv::GaussianBlur(crystals, crystals, {}, 0.7);
    return crystals;
  }

  // Bright lines of 60 to 400 px and the like, within `spread` radians of the lay.
  void add_scratches(cv::Mat& glints, int count, double shortest, double longest, double spread) {
    for (int i = 0; i < count; ++i)
      add_mark(glints, angle_ + uniform(-spread, spread), uniform(shortest, longest) / 2,
               uniform(0.6, 1.2), uniform(0.2, 1.2));
  }
  void add_specks(cv::Mat& glints, int count) {
    for (int i = 0; i < count; ++i) add_mark(glints, 0, 0, uniform(0.7, 1.5), uniform(0.3, 2));
  }
  void add_sheen(cv::Mat& glints, int count) {
    for (int i = 0; i < count; ++i)
      add_mark(glints, uniform(0, CV_PI), uniform(10, 80), uniform(5, 25), uniform(0.3, 1.5));
  }
  // A soft line of half this length, this sigma and this height.
  void add_mark(cv::Mat& glints, double angle, double half, double sigma, double height) {
    const double u0 = uniform(0, size_.width), v0 = uniform(0, size_.height);
    const double c = std::cos(angle), s = std::sin(angle), far = 4 * sigma;
    const int low = std::max(0, static_cast<int>(v0 - half * std::abs(s) - far)),
              high = std::min(size_.height - 1, static_cast<int>(v0 + half * std::abs(s) + far));
    for (int v = low; v <= high; ++v) {
      // Where the row meets the mark, far enough to both sides.
      const double left = u0 - half * std::abs(c) - far, right = u0 + half * std::abs(c) + far;
      double begin = left, end = right;
      if (std::abs(s) > 0.05) {
        const double at = u0 + (v - v0) * c / s, reach = far / std::abs(s);
        begin = std::max(begin, at - reach), end = std::min(end, at + reach);
      }
      for (int u = std::max(0, static_cast<int>(begin));
           u <= std::min(size_.width - 1, static_cast<int>(end)); ++u) {
        const double along = (u - u0) * c + (v - v0) * s, across = (v - v0) * c - (u - u0) * s;
        const double over = std::max(0.0, std::abs(along) - half);
        glints.at<float>(v, u) += static_cast<float>(
            height * std::exp(-(across * across + over * over) / (2 * sigma * sigma)));
      }
    }
  }

  cv::Size size_;
  double angle_;
  std::mt19937_64 random_;
};

}  // namespace

const char* name_of(SteelSurface surface) {
  constexpr const char* kNames[] = {"ground", "milled", "brushed", "shot_blasted", "scale",
                                    "rust",   "primer", "oil",     "galvanised"};
  return kNames[static_cast<int>(surface)];
}

SurfaceLight render_surface(SteelSurface surface, cv::Size size, double angle, std::uint64_t seed) {
  return SurfaceRenderer(size, angle, seed).render(surface);
}

cv::Mat render_print(cv::Size size, double field, double angle, double dark) {
  cv::Mat print(size, CV_32F);
  const double c = std::cos(angle), s = std::sin(angle);
  print.forEach<float>([&](float& value, const int* at) {
    const auto i = static_cast<long>(std::floor((at[1] * c + at[0] * s) / field)),
               j = static_cast<long>(std::floor((at[0] * c - at[1] * s) / field));
    value = ((i + j) & 1) != 0 ? static_cast<float>(dark) : 1.0f;
  });
  cv::GaussianBlur(print, print, {}, 0.8);  // of the lens
  return print;
}

}  // namespace arcstart::extraction
