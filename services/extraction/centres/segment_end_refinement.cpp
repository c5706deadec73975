#include "services/extraction/centres/segment_end_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "services/extraction/centres/ray_edge.hpp"

namespace arcstart::extraction {
namespace {

// In widths of the stripe. The last centres turn aside where an edge cuts the stripe at a slant,
// the more of them the flatter it does, and the longer the light fades: the line is taken from
// those before, no farther from the end than it takes, for a stripe may be curved.
constexpr std::array kSkipped{6.0, 10.0, 14.0};
constexpr double kTurnedAside = 4.5, kNotTurned = 2;  // of the fading's length; widths off that
constexpr double kFitted = 10;
constexpr int kFewestFitted = 15;
constexpr double kMostOff = 0.15;  // a line's centres, in the root of the mean square; px
constexpr double kNearAnother = 4;
constexpr double kFarthestBeyond = 3;  // of the light's end; kernels of 1.3 widths see no farther
constexpr double kLeastStep = 0.5;     // px from the centre before
constexpr std::int16_t kDropped = -1;

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
  std::optional<StripeRay> ray(int skipped, double stripe_width) const {
    const int fewest =
                  std::max(kFewestFitted, static_cast<int>(std::lround(kFitted * stripe_width))),
              most = std::min(size() - skipped, 4 * fewest);
    std::optional<StripeRay> best;
    for (int count = fewest; count <= most; count += count / 2) {
      StripeRay ray{};
      if (!fit(skipped, count, ray)) break;
      best = ray;
    }
    return best;
  }

 private:
  // False where they do not lie on a line.
  bool fit(int from, int count, StripeRay& ray) const {
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
    const auto end = ray ? ray_edge(image, *ray, width, segment.size()) : std::nullopt;
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

// Centres at an end that cannot be measured whose strength is below half of that farther in: on the
// stripe's middle line it is half where the light ends, so that these lie beyond.
int beyond_light(const Segment& segment) {
  const double width = segment.width();
  const int farthest = static_cast<int>(std::ceil(kFarthestBeyond * width));
  if (width == 0 || segment.size() < farthest + 2 * kFewestFitted) return 0;
  std::array<float, kFewestFitted> inner;
  for (int i = 0; i < kFewestFitted; ++i) inner[i] = segment[farthest + i].strength;
  std::nth_element(inner.begin(), inner.begin() + kFewestFitted / 2, inner.end());
  int beyond = 0;
  while (beyond < farthest && 2 * segment[beyond].strength < inner[kFewestFitted / 2]) ++beyond;
  return beyond;
}

}  // namespace

void refine_segment_ends(const GreyImage& image, std::vector<StripeCentre>& centres) {
  for (std::size_t begin = 0, end; begin < centres.size(); begin = end) {
    for (end = begin; end < centres.size() && centres[end].segment == centres[begin].segment;)
      ++end;
    if (!centres[begin].chosen) continue;
    for (const bool last : {false, true}) {
      const Segment segment(centres, begin, end, last);
      const SegmentEnd why = segment[0].end;
      if (why != SegmentEnd::kEdge && why != SegmentEnd::kGap) continue;
      const auto moved = moved_end(image, centres, segment);
      if (!moved) {
        const int beyond = beyond_light(segment);
        centres[segment.index(beyond)].end = why;
        for (int i = 0; i < beyond; ++i) centres[segment.index(i)].segment = kDropped;
        if (!last) begin += beyond;
        continue;
      }
      StripeCentre& tip = centres[segment.index(0)];
      tip.u = moved->u, tip.v = moved->v;
      for (int i = 1; i < moved->dropped; ++i) centres[segment.index(i)].segment = kDropped;
    }
  }
  std::erase_if(centres, [](const StripeCentre& centre) { return centre.segment == kDropped; });
}

}  // namespace arcstart::extraction
