#include "services/seam_finding/gaps/root_gap.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/order_statistics.hpp"
#include "services/seam_finding/gaps/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// The cross-section of a corner whose plate `standing` may stand off the other: p = corner +
// behind * b + up * w, with b along the plate that goes on, in under the standing one, and w along
// the standing one, away from the seam. Unit, not square to each other unless the plates are.
struct Corner {
  Plane going_on, standing;
  Eigen::Vector3d b, w;
  double rise;  // of w over the plate that goes on
  double fall;  // of b behind the standing one's face, negative
  Line line;

  double behind(const Eigen::Vector3d& p) const { return standing.signed_distance(p) / fall; }
  double up(const Eigen::Vector3d& p) const { return going_on.signed_distance(p) / rise; }

  // How far in the plate that goes on is seen under an edge 1 mm up.
  double sight(const Eigen::Vector3d& camera, double along) const {
    const Eigen::Vector3d ray = line.at(along) + w - camera;
    return -rise / going_on.normal.dot(ray) * standing.normal.dot(ray) / fall;
  }
};

Corner corner_of(const std::array<JointPlate, 2>& plates, int standing, const Line& line) {
  Corner corner{plates[1 - standing].plane, plates[standing].plane, {}, {}, 0, 0, line};
  corner.b = -away_from_seam(plates[1 - standing], plates[standing]);
  corner.w = away_from_seam(plates[standing], plates[1 - standing]);
  corner.rise = corner.w.dot(corner.going_on.normal);
  corner.fall = corner.b.dot(corner.standing.normal);
  return corner;
}

// A centre in the cross-section.
struct Place {
  double behind = 0, up = 0, along = 0;
  double step = 0;  // a pixel; mm
  bool end = false;
  double from_start() const { return behind + up; }  // rises along a stripe, in under and up
};

// The points near the corner, rising. Between plates that are not nearly one plane what lies near
// both planes lies near the line; most of a scan's points are told by one of them.
std::vector<int> points_near(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                             const Line& line) {
  std::vector<int> near;
  for (int i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    if (std::abs(plates[0].plane.signed_distance(p)) <= kGaps.reach &&
        std::abs(plates[1].plane.signed_distance(p)) <= kGaps.reach &&
        line.distance(p) <= kGaps.reach)
      near.push_back(i);
  }
  return near;
}

// The pieces of a stripe, of which these points lie near the corner, each from the plate that goes
// on to the standing one.
std::vector<std::vector<Place>> pieces_of(const ScanCloud& cloud, std::span<const int> points,
                                          const Corner& corner) {
  std::vector<std::vector<Place>> pieces;
  int last = -1;
  for (const int i : points) {
    const Eigen::Vector3d& p = cloud.points[i];
    const PointOrigin& origin = cloud.origins[i];
    if (last < 0 || last + 1 != i || cloud.origins[last].segment != origin.segment)
      pieces.emplace_back();
    pieces.back().push_back(
        {corner.behind(p), corner.up(p), corner.line.along(p), origin.step, origin.segment_end});
    last = i;
  }
  for (auto& piece : pieces) {
    if (piece.front().from_start() > piece.back().from_start())
      std::reverse(piece.begin(), piece.end());
    // Over a lap's cut the stripe turns onto the upper plate's top.
    while (piece.size() > 1 && std::abs(piece.back().behind) > kGaps.on_plate &&
           piece.back().up > kGaps.widest)
      piece.pop_back();
  }
  return pieces;
}

double distance_px(const Place& a, const Place& b) {
  return std::hypot(a.behind - b.behind, a.up - b.up) / std::max({a.step, b.step, 1e-3});
}

// Of a stripe that is thinned out, the bends may have been kept.
bool shows_bends(const std::vector<Place>& piece, double thinning_px) {
  if (thinning_px <= kGaps.fine) return true;
  for (std::size_t i = 1; i + 1 < piece.size(); ++i)
    if (std::abs(piece[i].from_start()) < kGaps.clear + kGaps.turn * piece[i].step &&
        distance_px(piece[i - 1], piece[i]) + distance_px(piece[i], piece[i + 1]) <
            kGaps.kept_steps * thinning_px)
      return true;
  return false;
}

// Behind the standing plate's face, up to `highest` on it; mm^2.
double area_behind(const std::vector<Place>& piece, double highest) {
  double area = 0;
  for (std::size_t i = 1; i < piece.size(); ++i) {
    double x0 = piece[i - 1].behind, y0 = piece[i - 1].up, x1 = piece[i].behind, y1 = piece[i].up;
    if (y0 >= highest || (x0 <= 0 && x1 <= 0)) continue;
    const auto cut = [&](double share, double& x, double& y) {
      x = x0 + share * (x1 - x0), y = y0 + share * (y1 - y0);
    };
    double xa = x0, ya = y0, xb = x1, yb = y1;
    if (x0 < 0) cut(x0 / (x0 - x1), xa, ya);
    if (x1 < 0) cut(x0 / (x0 - x1), xb, yb);
    area += (xa + xb) / 2 * (yb - ya);
  }
  return std::max(0.0, area);
}

std::optional<RootGap> through_the_corner(const std::vector<Place>& piece, double sight,
                                          double thinning_px) {
  const Place &first = piece.front(), &last = piece.back();
  const double step = piece[piece.size() / 2].step, rounding = kGaps.turn * step;
  if (first.behind > -kGaps.clear || std::abs(first.up) > kGaps.on_plate ||
      last.up < kGaps.clear + rounding || std::abs(last.behind) > kGaps.on_plate || !(step > 0) ||
      !shows_bends(piece, thinning_px))
    return std::nullopt;
  // The triangle's side along the standing plate.
  const auto side = [&](double area) { return std::sqrt(2 * std::max(0.0, area) / sight); };
  const double area = area_behind(piece, side(area_behind(piece, kGaps.widest)) + rounding);
  const double off = kGaps.area_deviation * step * step;
  return RootGap{side(area), (side(area + off) - side(area - off)) / 2};
}

// Of a stripe in two pieces: one in under the standing plate, the other from its edge up.
std::optional<RootGap> across_the_gap(const std::vector<std::vector<Place>>& pieces) {
  const auto goes_under = [](const std::vector<Place>& piece) {
    const Place& end = piece.back();
    return piece.front().behind < -kGaps.clear && end.end && end.behind > kGaps.least_behind &&
           end.behind < kGaps.widest && std::abs(end.up) < kGaps.on_plate;
  };
  const auto goes_up = [](const std::vector<Place>& piece) {
    const Place& end = piece.front();
    return end.end && end.up > 0 && end.up < kGaps.widest &&
           piece.back().up > end.up + kGaps.clear && std::abs(end.behind) < kGaps.on_plate &&
           std::abs(piece.back().behind) < kGaps.on_plate;
  };
  const auto under = std::find_if(pieces.begin(), pieces.end(), goes_under);
  const auto wall = std::find_if(pieces.begin(), pieces.end(), goes_up);
  if (under == pieces.end() || wall == pieces.end() || under == wall) return std::nullopt;
  return RootGap{wall->front().up, kGaps.parted_deviation};
}

// Between the centres of a stripe where it does not bend; the same all through a scan.
double thinning_of(const ScanCloud& cloud, const std::vector<int>& points) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < std::min(points.size(), kGaps.thinning_sample); ++i) {
    const PointOrigin &a = cloud.origins[points[i - 1]], &b = cloud.origins[points[i]];
    if (points[i] == points[i - 1] + 1 && a.stripe == b.stripe && a.segment == b.segment &&
        a.step > 0)
      steps.push_back((cloud.points[points[i]] - cloud.points[points[i - 1]]).norm() / a.step);
  }
  return quantile(steps, 0.75);
}

using Gaps = std::vector<std::optional<RootGap>>;

// near: the points near the corner.
Gaps gaps_under(const ScanCloud& cloud, const std::vector<int>& near, const Corner& corner,
                double thinning_px) {
  Gaps gaps(cloud.stripes.size());
  for (auto first = near.begin(), last = first; first != near.end(); first = last) {
    const int k = cloud.origins[*first].stripe;
    last = std::find_if(first, near.end(), [&](int i) { return cloud.origins[i].stripe != k; });
    const auto pieces = pieces_of(cloud, {first, last}, corner);
    const double sight = corner.sight(cloud.stripes[k].camera_centre, pieces.front().front().along);
    if (!(sight > kGaps.flattest)) continue;
    for (const auto& piece : pieces)
      if (const auto gap = through_the_corner(piece, sight, thinning_px)) gaps[k] = gap;
    if (!gaps[k]) gaps[k] = across_the_gap(pieces);
    if (gaps[k]) gaps[k]->width *= corner.rise, gaps[k]->deviation *= corner.rise;
  }
  return gaps;
}

double mean_width(const Gaps& gaps) {
  double sum = 0, count = 0;
  for (const auto& gap : gaps)
    if (gap) sum += gap->width, ++count;
  return count > 0 ? sum / count : -1;
}

}  // namespace

std::vector<std::optional<RootGap>> root_gaps(const ScanCloud& cloud,
                                              const std::array<JointPlate, 2>& plates,
                                              const Line& line, int standing) {
  if (!cloud.organised()) return {};
  const double thinning_px =
      std::max(thinning_of(cloud, plates[0].points), thinning_of(cloud, plates[1].points));
  const std::vector<int> near = points_near(cloud, plates, line);
  const auto gaps_of = [&](int plate) {
    return gaps_under(cloud, near, corner_of(plates, plate, line), thinning_px);
  };
  if (standing >= 0) return gaps_of(standing);
  Gaps first = gaps_of(0), second = gaps_of(1);
  return mean_width(first) > mean_width(second) ? first : second;
}

}  // namespace arcstart::seam_finding
