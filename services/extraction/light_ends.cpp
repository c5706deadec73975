#include "services/extraction/light_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "services/extraction/stripe_quality.hpp"

namespace arcstart {
namespace {

// In widths of the stripe. The last centres turn aside where an edge cuts the stripe at a slant,
// the more of them the flatter it does, and the longer the light fades: the line is taken from
// those before, no farther from the end than it takes, for a stripe may be curved.
constexpr std::array kSkipped{6.0, 10.0, 14.0};
constexpr double kTurnedAside = 4.5, kNotTurned = 2;  // of the fading's length; widths off that
constexpr double kFitted = 10;
constexpr int kFewestFitted = 15;
constexpr double kMostOff = 0.15;  // a line's centres, in the root of the mean square; px
// Sigma of the bend: the smaller, the less the line's error and other light count, and the more
// speckle does.
constexpr double kBlur = 0.7;
constexpr double kReach = 5;          // from the end the light is as before, or gone
constexpr double kDark = 4;           // so long at least it is, behind the end
constexpr double kFarthestMoved = 6;  // an end
constexpr double kNearAnother = 4;
constexpr int kPlateau = 20;         // px that tell the brightness before the end
constexpr double kGone = 0.25;       // share of it that is left at most
constexpr double kMostWhite = 0.25;  // share of those px at 255
constexpr double kLeastStep = 0.5;   // px from the centre before
constexpr std::int16_t kDropped = -1;
constexpr double kLeastWidth = 0.8, kLargestWidth = 12;  // px

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

// From a point of the stripe on, in the direction it has there.
struct Ray {
  double u, v;    // px
  double du, dv;  // unit, outwards
};

// How much the grey values, smoothed, bend across the ray, t px along it; grey values / px^2.
std::optional<double> bend_at(const GreyImage& image, const Ray& ray, double t, double sigma) {
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

// Of one segment, from the end in question inwards.
class Segment {
 public:
  Segment(const std::vector<StripeCentre>& centres, std::size_t begin, std::size_t end, bool last)
      : centres_(centres), begin_(begin), end_(end), last_(last) {}

  int size() const { return static_cast<int>(end_ - begin_); }
  std::size_t index(int i) const {
    return last_ ? end_ - 1 - static_cast<std::size_t>(i) : begin_ + static_cast<std::size_t>(i);
  }
  const StripeCentre& operator[](int i) const { return centres_[index(i)]; }

  double width() const {  // near the end; px, 0 where not known
    double sum = 0;
    int count = 0;
    for (int i = 0; i < std::min(size(), 2 * kFewestFitted); ++i)
      if ((*this)[i].width > 0) sum += (*this)[i].width, ++count;
    return count < kFewestFitted ? 0 : std::clamp(sum / count, kLeastWidth, kLargestWidth);
  }

  // The line of centres from the one `skipped` before the last on, as many as lie on one, from the
  // point of it that is nearest to the last.
  std::optional<Ray> ray(int skipped, double stripe_width) const {
    const int fewest =
                  std::max(kFewestFitted, static_cast<int>(std::lround(kFitted * stripe_width))),
              most = std::min(size() - skipped, 4 * fewest);
    std::optional<Ray> best;
    for (int count = fewest; count <= most; count += count / 2) {
      Ray ray{};
      if (!fit(skipped, count, ray)) break;
      best = ray;
    }
    return best;
  }

 private:
  // False where they do not lie on a line.
  bool fit(int from, int count, Ray& ray) const {
    const StripeCentre &near = (*this)[from], &far = (*this)[from + count - 1];
    const double length = std::hypot(near.u - far.u, near.v - far.v);
    const double du = (near.u - far.u) / length, dv = (near.v - far.v) / length;
    // Off that chord, against the way along it.
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (int i = from; i < from + count; ++i) {
      const double u = (*this)[i].u - near.u, v = (*this)[i].v - near.v;
      const double along = u * du + v * dv, off = v * du - u * dv;
      x += along, y += off, xx += along * along, xy += along * off, yy += off * off;
    }
    const double slope = (count * xy - x * y) / (count * xx - x * x),
                 at_0 = (y - slope * x) / count;
    if (yy - at_0 * y - slope * xy > kMostOff * kMostOff * count) return false;
    const double scale = 1 / std::hypot(1, slope);
    ray = {near.u - at_0 * dv, near.v + at_0 * du, scale * (du - slope * dv),
           scale * (dv + slope * du)};
    const StripeCentre& tip = (*this)[0];
    const double t = (tip.u - ray.u) * ray.du + (tip.v - ray.v) * ray.dv;
    ray.u += t * ray.du, ray.v += t * ray.dv;
    return true;
  }

  const std::vector<StripeCentre>& centres_;
  std::size_t begin_, end_;
  bool last_;
};

struct LightEnd {
  double at = 0;   // px along the ray
  int fading = 0;  // px over which the light goes from three quarters to one
};

// Brightness along a ray, at whole px.
class Brightness {
 public:
  Brightness(const GreyImage& image, const Ray& ray, double width)
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
  std::optional<LightEnd> end(int length_before) const {
    if (!whole_) return std::nullopt;
    LightEnd end;
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

bool near_another(const std::vector<StripeCentre>& centres, const StripeCentre& tip,
                  double distance) {
  return std::any_of(centres.begin(), centres.end(), [&](const StripeCentre& centre) {
    return centre.segment != tip.segment && std::abs(centre.u - tip.u) < distance &&
           std::hypot(centre.u - tip.u, centre.v - tip.v) < distance;
  });
}

struct MovedEnd {
  float u, v;   // px
  int dropped;  // centres that lie there or beyond
};

std::optional<MovedEnd> moved_end(const GreyImage& image, const std::vector<StripeCentre>& centres,
                                  const Segment& segment) {
  const double width = segment.width();
  const StripeCentre& tip = segment[0];
  if (width == 0 || near_another(centres, tip, kNearAnother * width)) return std::nullopt;
  std::optional<MovedEnd> moved;
  for (const double skipped : kSkipped) {
    const auto ray = segment.ray(static_cast<int>(std::lround(skipped * width)), width);
    const auto end = ray ? Brightness(image, *ray, width).end(segment.size()) : std::nullopt;
    if (!end) continue;
    moved = MovedEnd{static_cast<float>(ray->u + end->at * ray->du),
                     static_cast<float>(ray->v + end->at * ray->dv), 0};
    const auto before_end = [&](const StripeCentre& centre) {
      return (moved->u - centre.u) * ray->du + (moved->v - centre.v) * ray->dv;
    };
    while (before_end(segment[moved->dropped]) < kLeastStep) ++moved->dropped;
    if (kTurnedAside * end->fading <= (skipped + kNotTurned) * width) break;
  }
  return moved;
}

}  // namespace

void end_at_light(const GreyImage& image, std::vector<StripeCentre>& centres) {
  for (std::size_t begin = 0, end; begin < centres.size(); begin = end) {
    for (end = begin; end < centres.size() && centres[end].segment == centres[begin].segment;)
      ++end;
    if (!centres[begin].chosen) continue;
    for (const bool last : {false, true}) {
      const Segment segment(centres, begin, end, last);
      const SegmentEnd why = segment[0].end;
      if (why != SegmentEnd::kEdge && why != SegmentEnd::kGap) continue;
      const auto moved = moved_end(image, centres, segment);
      if (!moved) continue;
      StripeCentre& tip = centres[segment.index(0)];
      tip.u = moved->u, tip.v = moved->v;
      for (int i = 1; i < moved->dropped; ++i) centres[segment.index(i)].segment = kDropped;
    }
  }
  std::erase_if(centres, [](const StripeCentre& centre) { return centre.segment == kDropped; });
}

}  // namespace arcstart
