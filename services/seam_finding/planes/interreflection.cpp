#include "services/seam_finding/planes/interreflection.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "services/seam_finding/planes/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// The one by which the strips lie on a line best, in least squares.
InterreflectionShift interreflection_shift(const StripMeans& strips) {
  InterreflectionShift best;
  double least = std::numeric_limits<double>::infinity();
  for (double at = kPlanes.nearest_shift; at < kPlanes.farthest_shift * strips.back().distance;
       at *= kPlanes.shift_step) {
    const InterreflectionShift shape{1, at};
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d products = Eigen::Vector3d::Zero();
    for (const Strip& strip : strips) {
      const Eigen::Vector3d terms(1, strip.distance, shape(strip.distance));
      squares += strip.points * terms * terms.transpose();
      products += strip.points * strip.height * terms;
    }
    const Eigen::Vector3d shares = squares.inverse() * products;
    // What is left of the heights' squares, but for a constant.
    if (const double left = -shares.dot(products); left < least)
      least = left, best = {shares[2], at};
  }
  return best;
}

struct InLine {
  std::bitset<kStrips> strips;
  double off = kStrips;  // how far all are off it: each a share, 1 where it does not lie on it
};

// A strip lies on a line that it agrees with so well; mm.
InLine in_line(const StripMeans& strips, double agree) {
  const auto about = [&](double height, double slope) {
    InLine line{{}, 0};
    for (std::size_t k = 0; k < kStrips; ++k) {
      const double off = (strips[k].height - height - slope * strips[k].distance) / agree;
      if (off * off <= 1) line.strips.set(k);
      line.off += std::min(1.0, off * off);
    }
    return line;
  };
  InLine best;
  for (std::size_t a = 0; a < kStrips; ++a)
    for (std::size_t b = a + kStrips / 4; b < kStrips; ++b) {
      const double slope = (strips[b].height - strips[a].height) /
                           std::max(1e-6, strips[b].distance - strips[a].distance);
      const InLine line = about(strips[a].height - slope * strips[a].distance, slope);
      if (line.off < best.off) best = line;
    }
  // Two strips are off themselves; by all that lie on their line it is a better one.
  for (bool better = best.strips.any(); better;) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t k = 0; k < kStrips; ++k)
      if (best.strips[k]) {
        const auto& [distance, height, count] = strips[k];
        n += 1, x += distance, y += height, xx += distance * distance, xy += distance * height;
      }
    const double slope = (n * xy - x * y) / std::max(1e-9, n * xx - x * x);
    const InLine line = about((y - slope * x) / n, slope);
    better = line.off < best.off;
    if (better) best = line;
  }
  return best;
}

}  // namespace

ConsistentStrips consistent_strips(const StripMeans& strips, double noise) {
  double points = 0;
  for (const Strip& strip : strips) points += strip.points;
  const double agree =
      noise * std::max(kPlanes.strip_noise, kPlanes.strip_deviations * std::sqrt(kStrips / points));
  ConsistentStrips agreed;
  InLine line = in_line(strips, agree);
  if (line.off > kPlanes.shift_shown) {
    const InterreflectionShift shift = interreflection_shift(strips);
    StripMeans lowered = strips;
    for (Strip& strip : lowered) strip.height -= shift(strip.distance);
    const InLine without_shift = in_line(lowered, agree);
    if (without_shift.off + kPlanes.shift_shown < line.off)
      line = without_shift, agreed.shift = shift;
  }
  agreed.strips = 2 * line.strips.count() < kStrips ? line.strips.set() : line.strips;
  return agreed;
}

}  // namespace arcstart::seam_finding
