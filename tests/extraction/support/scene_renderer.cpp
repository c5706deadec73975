#include "tests/extraction/support/scene_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

namespace arcstart::extraction {
namespace {

constexpr double kStep = 0.5;  // of the curve along u; px

class Renderer {
 public:
  Renderer(const StripeSceneSettings& settings, std::uint64_t seed)
      : settings_(settings), random_(seed * 7919 + 17) {}

  StripeScene render() {
    draw_curve();
    stripe_ = cv::Mat::zeros(settings_.height, settings_.width, CV_32F);
    add_stripe(0, 0, settings_.width, 1);
    cv::Mat light = stripe_.mul(speckle());
    if (settings_.surroundings) add_surroundings(light);
    if (settings_.ghost) add_ghost(light);
    for (int i = 0; i < settings_.blobs; ++i) add_blob(light);
    if (settings_.arc) add_arc(light);
    return {expose(light), truth_};
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double sign() { return uniform(0, 1) < 0.5 ? -1 : 1; }
  cv::Mat white_noise() {
    cv::Mat noise(settings_.height, settings_.width, CV_32F);
    cv::RNG generator(random_());
    generator.fill(noise, cv::RNG::NORMAL, 0, 1);
    return noise;
  }
  // White noise blurred with this sigma, of unit variance again.
  cv::Mat grain(double sigma) {
    cv::Mat noise = white_noise();
    cv::GaussianBlur(noise, noise, {}, sigma);
    cv::Scalar mean, deviation;
    cv::meanStdDev(noise, mean, deviation);
    return noise / deviation[0];
  }

  // Height, slope, sine, one V and a ramp behind it; then rounded. Slopes stay below 1.5.
  void draw_curve() {
    const double width = settings_.width, height = settings_.height;
    const double base = uniform(0.35, 0.65) * height, slope = uniform(-0.15, 0.15);
    const double swing = uniform(0, 6), period = uniform(300, 600), phase = uniform(0, 6.28);
    const double half = std::min(uniform(120, 240), 0.3 * width),
                 middle = uniform(0.4, 0.6) * width;
    const double depth = sign() * std::min(uniform(80, 180), 1.1 * half);
    const double ramp = uniform(-30, 30), ramp_at = middle + half + uniform(60, 120);
    const double rounding = uniform(3, 6);
    corners_ = {middle - half, middle, middle + half, ramp_at, ramp_at + 40};
    const int count = static_cast<int>(width / kStep) + 1;
    std::vector<float> v(count);
    for (int i = 0; i < count; ++i) {
      const double u = i * kStep;
      double at = base + slope * (u - width / 2);
      at += swing * std::sin(2 * std::numbers::pi * u / period + phase);
      at += depth * std::max(0.0, 1 - std::abs(u - middle) / half);
      at += ramp * std::clamp((u - ramp_at) / 40, 0.0, 1.0);
      v[i] = static_cast<float>(at);
    }
    // Continued straight beyond the image's ends, so that rounding does not bend it there.
    const int beyond = 60;
    std::vector<float> longer;
    for (int i = -beyond; i < count + beyond; ++i) {
      const int inside = std::clamp(i, 0, count - 1);
      const float step = inside == 0 ? v[1] - v[0] : v[count - 1] - v[count - 2];
      longer.push_back(v[inside] + static_cast<float>(i - inside) * step);
    }
    cv::Mat row(1, static_cast<int>(longer.size()), CV_32F, longer.data());
    cv::GaussianBlur(row, row, {0, 1}, rounding / kStep, 1);
    for (int g = 0; g < settings_.gaps; ++g) {
      const double begin = uniform(0.05, 0.9) * width;
      gaps_.push_back({begin, begin + uniform(16, 66)});
    }
    for (int i = 0; i < count; ++i) {
      TruthPoint point{i * kStep, longer[i + beyond], true, 1e9};
      for (const auto& [begin, end] : gaps_)
        if (point.u >= begin && point.u <= end) point.visible = false;
      for (const double corner : corners_)
        point.corner = std::min(point.corner, std::abs(point.u - corner));
      truth_.push_back(point);
    }
  }

  double amplitude_at(double u) const {
    if (!settings_.modulated) return settings_.amplitude;
    return settings_.amplitude * (1 + 0.35 * std::sin(u / 97) + 0.15 * std::sin(u / 23));
  }
  double width_at(double u) const {
    return settings_.stripe_width + (settings_.modulated ? 0.9 * std::sin(u / 140) : 0);
  }

  // Gaussian of the distance to the curve moved by `shift` down the image, 3 x 3 samples a pixel.
  void add_stripe(double shift, double begin, double end, double share) {
    const double reach = 5 * (settings_.stripe_width + (settings_.modulated ? 0.9 : 0));
    const int steps = static_cast<int>(reach / kStep);
    const int count = static_cast<int>(truth_.size());
    for (int column = static_cast<int>(begin); column < static_cast<int>(end); ++column) {
      const int middle = static_cast<int>(column / kStep);
      const int first = std::max(0, middle - steps), last = std::min(count - 1, middle + steps);
      double low = 1e9, high = -1e9;
      for (int i = first; i <= last; ++i) {
        low = std::min(low, truth_[i].v);
        high = std::max(high, truth_[i].v);
      }
      const int top = std::max(0, static_cast<int>(low + shift - reach));
      const int bottom = std::min(settings_.height - 1, static_cast<int>(high + shift + reach));
      for (int row = top; row <= bottom; ++row) {
        double sum = 0;
        for (int s = 0; s < 9; ++s)
          sum += brightness(column + (s % 3 - 1) / 3.0, row - shift + (s / 3 - 1) / 3.0, first,
                            last, reach);
        stripe_.at<float>(row, column) += static_cast<float>(share * sum / 9);
      }
    }
  }
  double brightness(double u, double v, int first, int last, double reach) const {
    double nearest = reach * reach, at = -1;
    for (int i = first; i < last; ++i) {
      const TruthPoint &a = truth_[i], &b = truth_[i + 1];
      if (std::min(std::abs(v - a.v), std::abs(v - b.v)) > reach) continue;
      const double du = b.u - a.u, dv = b.v - a.v;
      const double t =
          std::clamp(((u - a.u) * du + (v - a.v) * dv) / (du * du + dv * dv), 0.0, 1.0);
      const double pu = u - a.u - t * du, pv = v - a.v - t * dv;
      if (pu * pu + pv * pv >= nearest) continue;
      nearest = pu * pu + pv * pv;
      at = a.u + t * du;
    }
    if (at < 0) return 0;
    for (const auto& [begin, end] : gaps_)
      if (at >= begin && at <= end) return 0;
    const double width = width_at(at);
    return amplitude_at(at) * std::exp(-nearest / (2 * width * width));
  }

  cv::Mat speckle() {
    cv::Mat factor = cv::Mat::ones(settings_.height, settings_.width, CV_32F);
    if (settings_.speckle > 0) factor = cv::max(factor + settings_.speckle * grain(1), 0);
    return factor;
  }

  void add_surroundings(cv::Mat& light) {
    cv::Mat halo;
    cv::GaussianBlur(light, halo, {}, 12);
    light += settings_.halo * halo + settings_.texture * grain(3);
    for (int row = 0; row < light.rows; ++row) light.row(row) += 12.0 * row / light.rows;
    cv::Mat scratches = cv::Mat::zeros(light.size(), CV_32F);
    for (int i = 0; i < 60; ++i) streak(scratches, uniform(30, 150), uniform(4, 12), 1);
    if (settings_.scratches) light += scratches;
  }

  // A straight bright line with soft sides.
  void streak(cv::Mat& image, double length, double height, double width) {
    const double u = uniform(0, image.cols), v = uniform(0, image.rows), angle = uniform(0, 6.28);
    const double cu = std::cos(angle), cv = std::sin(angle);
    const int reach = static_cast<int>(length / 2 + 5 * width);
    for (int row = std::max(0, static_cast<int>(v) - reach);
         row < std::min(image.rows, static_cast<int>(v) + reach); ++row)
      for (int column = std::max(0, static_cast<int>(u) - reach);
           column < std::min(image.cols, static_cast<int>(u) + reach); ++column) {
        const double along = (column - u) * cu + (row - v) * cv,
                     across = (row - v) * cu - (column - u) * cv;
        const double over = std::max(0.0, std::abs(along) - length / 2);
        image.at<float>(row, column) += static_cast<float>(
            height * std::exp(-(across * across + over * over) / (2 * width * width)));
      }
  }

  void add_ghost(cv::Mat& light) {
    stripe_ = 0;
    const double length = uniform(150, 300), begin = uniform(0.1, 0.7) * settings_.width;
    add_stripe(sign() * uniform(45, 95), begin, std::min(begin + length, settings_.width - 1.0),
               0.35);
    light += stripe_.mul(speckle());
  }

  void add_blob(cv::Mat& light) {
    const double u = uniform(0, light.cols), v = uniform(0, light.rows), angle = uniform(0, 3.14);
    const double a = uniform(3, 15), b = uniform(3, 11), height = uniform(60, 260);
    const int reach = static_cast<int>(4 * std::max(a, b));
    for (int row = std::max(0, static_cast<int>(v) - reach);
         row < std::min(light.rows, static_cast<int>(v) + reach); ++row)
      for (int column = std::max(0, static_cast<int>(u) - reach);
           column < std::min(light.cols, static_cast<int>(u) + reach); ++column) {
        const double x = (column - u) * std::cos(angle) + (row - v) * std::sin(angle);
        const double y = (row - v) * std::cos(angle) - (column - u) * std::sin(angle);
        light.at<float>(row, column) +=
            static_cast<float>(height * std::exp(-x * x / (2 * a * a) - y * y / (2 * b * b)));
      }
  }

  void add_arc(cv::Mat& light) {
    const double u = uniform(0.3, 0.7) * light.cols, v = uniform(0, 0.08) * light.rows;
    const double phase = uniform(0, 6.28);
    for (int row = 0; row < light.rows; ++row)
      for (int column = 0; column < light.cols; ++column) {
        const double d = std::hypot(column - u, row - v), angle = std::atan2(row - v, column - u);
        const double rays = 1 + 0.25 * std::sin(17 * angle + phase) + 0.15 * std::sin(41 * angle);
        light.at<float>(row, column) +=
            static_cast<float>(400 * std::exp(-d / 90) + 70 * rays * std::exp(-d / 420));
      }
    for (int i = 0; i < 25; ++i) streak(light, uniform(10, 70), uniform(60, 250), uniform(0.8, 2));
  }

  // Light to grey values: shot noise, read noise, 8 bits.
  cv::Mat expose(const cv::Mat& light) {
    cv::Mat level = cv::max(light + 10, 0), shot;
    if (settings_.electrons_per_grey > 0) {
      cv::sqrt(level / settings_.electrons_per_grey, shot);
      level += shot.mul(white_noise());
    }
    level += settings_.read_noise * white_noise();
    cv::Mat grey;
    level.convertTo(grey, CV_8U);
    return grey;
  }

  const StripeSceneSettings& settings_;
  std::mt19937_64 random_;
  std::vector<TruthPoint> truth_;
  std::vector<std::pair<double, double>> gaps_;
  std::vector<double> corners_;
  cv::Mat stripe_;
};

}  // namespace

const char* name_of(StripeSceneKind kind) {
  switch (kind) {
    case StripeSceneKind::kClean:
      return "clean";
    case StripeSceneKind::kTypical:
      return "typical";
    case StripeSceneKind::kGlare:
      return "glare";
    case StripeSceneKind::kSaturated:
      return "saturated";
    case StripeSceneKind::kLowContrast:
      return "low_contrast";
  }
  return "";
}

StripeSceneSettings stripe_scene_settings(StripeSceneKind kind) {
  StripeSceneSettings settings;
  if (kind == StripeSceneKind::kClean) return settings;
  settings.stripe_width = 3;
  settings.modulated = true;
  settings.speckle = 0.15;
  settings.read_noise = 2.5;
  settings.gaps = 4;
  settings.surroundings = true;
  settings.blobs = 6;
  settings.ghost = true;
  settings.amplitude = 130;
  if (kind == StripeSceneKind::kGlare) {
    settings.amplitude = 90;
    settings.speckle = 0.30;
    settings.blobs = 14;
    settings.arc = true;
  } else if (kind == StripeSceneKind::kSaturated) {
    settings.amplitude = 420;
  } else if (kind == StripeSceneKind::kLowContrast) {
    settings.amplitude = 30;
    settings.read_noise = 4;
    settings.blobs = 0;
    settings.ghost = false;
  }
  return settings;
}

StripeScene render_stripe_scene(const StripeSceneSettings& settings, std::uint64_t seed) {
  return Renderer(settings, seed).render();
}

}  // namespace arcstart::extraction
