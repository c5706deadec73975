#include "tests/extraction/support/steel_scene.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <random>
#include <utility>
#include <vector>

#include "tests/extraction/support/steel_surface.hpp"

namespace arcstart::extraction {
namespace {

constexpr int kWidth = 1600, kHeight = 1200;  // px
constexpr double kBlackLevel = 10;            // grey values
constexpr double kElectronsPerGrey = 39, kReadNoise = 2;

class SteelRenderer {
 public:
  SteelRenderer(SteelSceneKind kind, std::uint64_t seed)
      : kind_(kind), seed_(seed), random_(seed * 6151 + 7 * static_cast<std::uint64_t>(kind) + 1) {}

  SteelScene render() {
    draw_course();
    draw_profile();
    cv::Mat laser = stripe(course_, 1, 1, 0, kWidth, true);
    if (kind_ == SteelSceneKind::kNeighbour) add_reflection(laser);
    SurfaceLight surface =
        render_surface(surface_kind(), {kWidth, kHeight}, uniform(0, CV_PI), random_());
    if (kind_ == SteelSceneKind::kPrint)
      surface.reflectance = surface.reflectance.mul(render_print(
          {kWidth, kHeight}, uniform(25, 90), uniform(0, CV_PI / 2), uniform(0.12, 0.35)));
    const cv::Mat lamp = uniform(15, 60) * (surface.reflectance + surface.glints);
    cv::Mat halo;  // of the lens
    cv::Mat thrown = laser.mul(surface.reflectance);
    cv::blur(thrown, halo, {41, 41});
    thrown += 0.1 * halo;
    SteelScene scene{{expose(lamp + thrown.mul(speckle())), truth()}, expose(lamp), seed_ % 2 == 1};
    if (scene.turned)
      for (cv::Mat* image : {&scene.lit.grey, &scene.unlit}) cv::transpose(*image, *image);
    return scene;
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double sign() { return uniform(0, 1) < 0.5 ? -1 : 1; }
  cv::Mat white_noise() {
    cv::Mat noise(kHeight, kWidth, CV_32F);
    cv::RNG(random_()).fill(noise, cv::RNG::NORMAL, 0, 1);
    return noise;
  }

  SteelSurface surface_kind() {
    constexpr auto kCount = std::size(kAllSteelSurfaces);
    if (kind_ == SteelSceneKind::kPrint) return SteelSurface::kPrimer;
    return kAllSteelSurfaces[(seed_ - 1) % kCount];
  }

  // A slope, a V or a ramp, corners rounded by 2 to 5 px; gaps.
  void draw_course() {
    const double base = uniform(0.35, 0.65) * kHeight, slope = uniform(-0.2, 0.2);
    foot_ = uniform(0.3, 0.7) * kWidth;
    const double half = uniform(150, 350), depth = sign() * uniform(0.2, 0.7) * half;
    const bool ramp = uniform(0, 1) < 0.4;
    course_.resize(kWidth);
    for (int u = 0; u < kWidth; ++u) {
      const double off = u - foot_, bent = ramp ? std::clamp(off / half, -1.0, 1.0)
                                                : std::max(0.0, 1 - std::abs(off) / half);
      course_[u] = static_cast<float>(base + slope * (u - kWidth / 2.0) + depth * bent);
    }
    cv::Mat row(1, kWidth, CV_32F, course_.data());
    cv::GaussianBlur(row, row, {0, 1}, uniform(2, 5), 1, cv::BORDER_REFLECT_101);
    for (int gaps = static_cast<int>(uniform(0, 3)); gaps > 0; --gaps) {
      const double begin = uniform(0.05, 0.9) * kWidth;
      gaps_.push_back({begin, begin + uniform(16, 60)});
    }
  }

  // Width and height of the stripe along the image.
  void draw_profile() {
    const double width = uniform(1.5, 6), amplitude = uniform(80, 300), phase = uniform(0, 6.28),
                 waves = uniform(0.6, 1.6);
    widths_.resize(kWidth);
    heights_.resize(kWidth);
    for (int u = 0; u < kWidth; ++u) {
      const double wave = std::sin(phase + 2 * CV_PI * waves * u / kWidth);
      if (kind_ ==
          SteelSceneKind::kMixedWidth) {  // from 1 to 8, the light the same where it is wide
        widths_[u] = static_cast<float>(std::exp(std::log(8.0) / 2 * (1 + wave)));
        heights_[u] = static_cast<float>(amplitude * std::sqrt(2 / widths_[u]));
      } else {
        widths_[u] = static_cast<float>(width * (1 + 0.15 * wave));
        heights_[u] = static_cast<float>(amplitude * (1 + 0.3 * std::sin(u / 97.0 + phase)));
      }
    }
  }

  bool in_gap(double u) const {
    return std::any_of(gaps_.begin(), gaps_.end(),
                       [&](const auto& gap) { return u >= gap.first && u <= gap.second; });
  }

  // Gaussian across; the distance to the course is that to its tangent. Three samples a pixel.
  cv::Mat stripe(const std::vector<float>& course, double width, double height, int begin, int end,
                 bool gaps) const {
    cv::Mat light = cv::Mat::zeros(kHeight, kWidth, CV_32F);
    for (int u = std::max(0, begin); u < std::min(kWidth, end); ++u) {
      if (gaps && in_gap(u)) continue;
      const double slope = (course[std::min(u + 1, kWidth - 1)] - course[std::max(u - 1, 0)]) /
                           static_cast<double>(std::min(u + 1, kWidth - 1) - std::max(u - 1, 0));
      const double sigma = width * widths_[u] * std::hypot(1, slope), reach = 6 * sigma + 1;
      for (int v = std::max(0, static_cast<int>(course[u] - reach));
           v <= std::min(kHeight - 1, static_cast<int>(course[u] + reach)); ++v) {
        double sum = 0;
        for (const double within : {-1 / 3.0, 0.0, 1 / 3.0})
          sum += std::exp(-0.5 * std::pow((v + within - course[u]) / sigma, 2));
        light.at<float>(v, u) = static_cast<float>(height * heights_[u] * sum / 3);
      }
    }
    return light;
  }

  // From 30 to 120 px beside a joint on, mirrored at a line through it, shifted away from the
  // stripe, over 200 to 600 px.
  void add_reflection(cv::Mat& laser) {
    const double side = sign(), shift = sign(), tilt = uniform(0.1, 0.6);
    const int from = static_cast<int>(foot_ + side * uniform(30, 120)),
              to = static_cast<int>(from + side * uniform(200, 600));
    const double broader = uniform(1.8, 3), fainter = uniform(0.3, 0.8);
    const double apart = 4 * (1 + broader) * widths_[static_cast<int>(foot_)] + uniform(0, 40);
    std::vector<float> course(kWidth);
    for (int u = 0; u < kWidth; ++u)
      course[u] = static_cast<float>(course_[u] + shift * (apart + tilt * std::abs(u - from)));
    laser += stripe(course, broader, fainter, std::min(from, to), std::max(from, to), false);
  }

  cv::Mat speckle() {
    cv::Mat grain = white_noise();
    cv::GaussianBlur(grain, grain, {}, 1);
    // A blur of sigma 1 leaves 1 / (2 sqrt(pi)) of white noise's deviation.
    return cv::max(1 + uniform(0.05, 0.2) * 2 * std::sqrt(CV_PI) * grain, 0);
  }

  cv::Mat expose(const cv::Mat& light) {
    cv::Mat level = light + kBlackLevel, shot;
    cv::sqrt(level / kElectronsPerGrey, shot);
    level += shot.mul(white_noise()) + kReadNoise * white_noise();
    cv::Mat grey;
    level.convertTo(grey, CV_8U);
    return grey;
  }

  std::vector<TruthPoint> truth() const {
    std::vector<TruthPoint> points;
    for (int i = 0; i + 1 < 2 * kWidth; ++i) {
      const float v = (course_[i / 2] + course_[(i + 1) / 2]) / 2;
      points.push_back({i / 2.0, v, !in_gap(i / 2.0), std::abs(i / 2.0 - foot_)});
    }
    return points;
  }

  SteelSceneKind kind_;
  std::uint64_t seed_;
  std::mt19937_64 random_;
  std::vector<float> course_, widths_, heights_;  // of each column
  double foot_ = 0;                               // of the joint, along u; px
  std::vector<std::pair<double, double>> gaps_;
};

}  // namespace

const char* name_of(SteelSceneKind kind) {
  constexpr const char* kNames[] = {"texture", "neighbour", "print", "mixed_width"};
  return kNames[static_cast<int>(kind)];
}

SteelScene render_steel_scene(SteelSceneKind kind, std::uint64_t seed) {
  return SteelRenderer(kind, seed).render();
}

}  // namespace arcstart::extraction
