#include "services/extraction/centres/ray_edge.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "services/extraction/centres/stripe_quality.hpp"

namespace arcstart::extraction {
namespace {

// Sigma of the bend: the smaller, the less the line's error and other light count, and the more
// speckle does.
constexpr double kBlur = 0.7;
// In widths of the stripe.
constexpr double kReach = 5;          // from the end the light is as before, or gone
constexpr double kDark = 4;           // so long at least it is, behind the end
constexpr double kFarthestMoved = 6;  // an end
constexpr int kPlateau = 20;          // px that tell the brightness before the end
constexpr double kGone = 0.25;        // share of it that is left at most
constexpr double kMostWhite = 0.25;   // share of those px at 255

// A Gaussian and its derivatives about a place between pixels.
struct Taps {
  static constexpr int kMost = 64;
  static constexpr double kReachOfTaps = 3.5;

  Taps(double centre, double sigma)
      : first(static_cast<int>(std::ceil(centre - kReachOfTaps * sigma))),
        count(static_cast<int>(std::floor(centre + kReachOfTaps * sigma)) - first + 1) {
    for (int i = 0; i < count; ++i) {
      const double t = (first + i - centre) / sigma;
      const double g = std::exp(-t * t / 2) / (std::sqrt(2 * std::numbers::pi) * sigma);
      smooth[i] = static_cast<float>(g);
      slope[i] = static_cast<float>(t / sigma * g);
      bend[i] = static_cast<float>((t * t - 1) / (sigma * sigma) * g);
    }
  }

  int first, count;
  std::array<float, kMost> smooth, slope, bend;
};

// How much the grey values, smoothed, bend across the ray, t px along it; grey values / px^2.
std::optional<double> bend_at(const GreyImage& image, const StripeRay& ray, double t,
                              double sigma) {
  const Taps columns(ray.u + t * ray.du, sigma), rows(ray.v + t * ray.dv, sigma);
  if (columns.first < 0 || rows.first < 0 || columns.first + columns.count > image.width ||
      rows.first + rows.count > image.height)
    return std::nullopt;
  double uu = 0, uv = 0, vv = 0;
  for (int j = 0; j < rows.count; ++j) {
    const std::uint8_t* greys = image.row(rows.first + j) + columns.first;
    float smooth = 0, slope = 0, bend = 0;
    for (int i = 0; i < columns.count; ++i) {
      const float grey = greys[i];
      smooth += columns.smooth[i] * grey;
      slope += columns.slope[i] * grey;
      bend += columns.bend[i] * grey;
    }
    uu += rows.smooth[j] * bend;
    uv += rows.slope[j] * slope;
    vv += rows.bend[j] * smooth;
  }
  return -(ray.dv * ray.dv * uu - 2 * ray.du * ray.dv * uv + ray.du * ray.du * vv);
}

// Brightness along a ray, at whole px.
class Brightness {
 public:
  Brightness(const GreyImage& image, const StripeRay& ray, double width)
      : reach_(static_cast<int>(std::ceil(kReach * width))),
        farthest_(static_cast<int>(std::lround(kFarthestMoved * width))),
        dark_(static_cast<int>(std::ceil(kDark * width))) {
    for (int t = -farthest_ - reach_ - kPlateau; t <= farthest_ + reach_; ++t) {
      const auto bend = bend_at(image, ray, t, kBlur * width);
      if (!bend) return;
      values_[index(t)] = *bend;
      white_[index(t)] = is_saturated(image, ray.u + t * ray.du, ray.v + t * ray.dv);
    }
    whole_ = true;
  }

  // Where the light is half as bright as before, and gone soon after.
  std::optional<RayEdge> end(int length_before) const {
    if (!whole_) return std::nullopt;
    RayEdge end;
    for (int pass = 0; pass < 2; ++pass) {
      const int before = static_cast<int>(std::floor(end.at)) - reach_;
      if (kPlateau - before > length_before) return std::nullopt;
      double light = 0;
      int white = 0;
      for (int t = before - kPlateau + 1; t <= before; ++t)
        light += values_[index(t)] / kPlateau, white += white_[index(t)];
      if (!(light > 0) || white > kMostWhite * kPlateau) return std::nullopt;
      // A dark spot of the stripe is shorter than what is dark behind an edge.
      int t = -farthest_, dark = 0;
      for (; t <= farthest_ && dark < dark_; ++t)
        dark = values_[index(t)] < light / 2 ? dark + 1 : 0;
      t -= dark;
      if (dark < dark_ || t == -farthest_) return std::nullopt;
      for (int beyond = t + reach_; beyond < t + reach_ + dark_; ++beyond)
        if (values_[index(beyond)] > kGone * light) return std::nullopt;
      const double inner = values_[index(t - 1)], outer = values_[index(t)];
      end.at = t - 1 + (inner - light / 2) / (inner - outer);
      int last_bright = t - 1, first_dim = t;
      while (values_[index(last_bright)] < (1 - kGone) * light) --last_bright;
      while (values_[index(first_dim)] > kGone * light) ++first_dim;
      end.fading = first_dim - last_bright - 1;
    }
    return end;
  }

 private:
  static constexpr std::size_t kMost =
      2 * static_cast<std::size_t>((kFarthestMoved + kReach) * kLargestWidth + 2) + kPlateau + 1;
  std::size_t index(int t) const {
    return static_cast<std::size_t>(t + farthest_ + reach_ + kPlateau);
  }

  int reach_, farthest_, dark_;
  std::array<double, kMost> values_;
  std::array<bool, kMost> white_;
  bool whole_ = false;
};

}  // namespace

std::optional<RayEdge> ray_edge(const GreyImage& image, const StripeRay& ray, double width,
                                int length_before) {
  return Brightness(image, ray, width).end(length_before);
}

}  // namespace arcstart::extraction
