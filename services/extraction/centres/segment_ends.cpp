#include "services/extraction/centres/segment_ends.hpp"

#include <algorithm>
#include <cmath>

#include "services/extraction/centres/stripe_quality.hpp"

namespace arcstart::extraction {
namespace {

constexpr int kChord = 15;           // points over which an end's direction is taken
constexpr double kLongestGap = 150;  // px

struct End {
  double u, v;    // px
  double du, dv;  // unit, outwards
};

End end_of(const std::vector<RidgePoint>& points, const Branch& branch, bool last) {
  const int size = static_cast<int>(branch.points.size()), chord = std::min(kChord, size - 1);
  const RidgePoint& tip = points[branch.points[last ? size - 1 : 0]];
  const RidgePoint& inner = points[branch.points[last ? size - 1 - chord : chord]];
  const double length = std::max(1e-3f, std::hypot(tip.u - inner.u, tip.v - inner.v));
  return {tip.u, tip.v, (tip.u - inner.u) / length, (tip.v - inner.v) / length};
}

bool at_border(const GreyImage& image, const End& end, int margin) {
  const double u = end.u + 4 * end.du, v = end.v + 4 * end.dv;
  return u < margin || v < margin || u > image.width - 1 - margin || v > image.height - 1 - margin;
}

// Most of a patch ahead, as wide as the kernels, is white.
bool runs_into_white(const GreyImage& image, const End& end, double sigma) {
  int white = 0, all = 0;
  for (double ahead = 1; ahead <= 4; ahead += 0.5)
    for (double beside = -1; beside <= 1; beside += 0.5) {
      const double u = end.u + sigma * (ahead * end.du - beside * end.dv);
      const double v = end.v + sigma * (ahead * end.dv + beside * end.du);
      white += is_saturated(image, u, v);
      ++all;
    }
  return 3 * white > 2 * all;
}

bool in_line(const End& from, const End& to) {
  const double du = to.u - from.u, dv = to.v - from.v;
  const double distance = std::hypot(du, dv);
  if (distance > kLongestGap || du * from.du + dv * from.dv <= 0) return false;
  const double tolerance = 3 + 0.1 * distance;
  return std::abs(du * from.dv - dv * from.du) <= tolerance &&
         std::abs(du * to.dv - dv * to.du) <= tolerance;
}

}  // namespace

BranchEnds branch_ends(const GreyImage& image, const std::vector<RidgePoint>& points,
                       const StripePath& selection, std::size_t index, double sigma, int margin) {
  const Branch& branch = selection.branches[index];
  const auto reason = [&](bool last) {
    const End end = end_of(points, branch, last);
    if (at_border(image, end, margin)) return SegmentEnd::kBorder;
    if (runs_into_white(image, end, sigma)) return SegmentEnd::kSaturation;
    const std::size_t neighbour = last ? index + 1 : index - 1;  // the chosen ones are in order
    if (branch.chosen && neighbour < selection.branches.size() &&
        selection.branches[neighbour].chosen &&
        in_line(end, end_of(points, selection.branches[neighbour], !last)))
      return SegmentEnd::kGap;
    return SegmentEnd::kEdge;
  };
  return {reason(false), reason(true)};
}

}  // namespace arcstart::extraction
