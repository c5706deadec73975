#include "services/seam_finding/ends/edge_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/ends/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// Which way a stripe runs there, out of the plate; from points far enough apart for their noise.
Eigen::Vector3d direction_at_end(const ScanCloud& cloud, const std::vector<int>& run,
                                 bool at_back) {
  const Eigen::Vector3d& last = cloud.points[at_back ? run.back() : run.front()];
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < run.size() && way.norm() < kEnds.direction_base; ++i)
    way = last - cloud.points[at_back ? run[run.size() - 1 - i] : run[i]];
  return way.norm() > 1e-6 ? way.normalized() : way;
}

// The edge over which a stripe turns: what it shows next lies on one straight piece, a cut or a
// chamfer, that begins at the plate.
struct Turn {
  Eigen::Vector3d place;
  double longer;  // its deviation over that of a point
};
std::optional<Turn> turn_beyond(const ScanCloud& cloud, const PlateStripes& stripes, int last,
                                bool at_back, double noise) {
  const int step = at_back ? 1 : -1, next = last + step;
  const Eigen::Vector3d& first = cloud.points[next];
  const double depth = -height_over(stripes, first);
  std::optional<Turn> turn;
  for (int k = 1; k < kEnds.most_on_cut; ++k) {
    const int i = next + k * step;
    if (i < 0 || i >= cloud.size() || cloud.origins[i].stripe != cloud.origins[last].stripe ||
        cloud.origins[i].segment != cloud.origins[last].segment)
      break;
    const Eigen::Vector3d way = cloud.points[i] - first;
    for (int j = next + step; j != i; j += step)
      if ((cloud.points[j] - first).cross(way.normalized()).norm() > kFit.outlier * noise)
        return turn;
    const double drop = -height_over(stripes, cloud.points[i]) - depth;
    if (drop * depth <= 0 || std::abs(drop) < kEnds.least_drop) continue;
    const double back = depth / drop;
    turn = Turn{first - back * way, std::hypot(1 + back, back)};
  }
  return turn;
}

// Where the light at a segment's end lies. Of a stripe that is cut off at a slant the last of the
// light lies beside the laser's plane, but on the plate it does lie: where the line of sight meets
// it, unless it runs along the plate.
Eigen::Vector3d on_plate(const ScanCloud& cloud, const PlateStripes& stripes, int i) {
  const Eigen::Vector3d sight = (cloud.points[i] - cloud.seen_from(i)).normalized();
  const double toward = -stripes.plate.plane.normal.dot(sight);
  if (toward < kVisibility.least_sight) return cloud.points[i];
  return cloud.points[i] + sight * (height_over(stripes, cloud.points[i]) / toward);
}

// Way along the seam that shifts an edge square to it by a pixel in the image; mm. A pixel is known
// from the centre next to the segment's end: so many pixels lie between as steps.
double pixel_along(const ScanCloud& cloud, int end, int next, const Line& line,
                   const Eigen::Vector3d& away) {
  const Eigen::Vector3d& eye = cloud.seen_from(end);
  const Eigen::Vector3d sight = cloud.points[end] - eye, beside = cloud.points[next] - eye;
  const double way = (beside - sight).norm();
  if (!(way > 0)) return 0;
  const double angle =
      std::atan2(sight.cross(beside).norm(), sight.dot(beside)) * cloud.origins[end].step / way;
  const double across = std::abs(sight.cross(away).normalized().dot(line.direction));
  return across > kVisibility.least_sight ? angle * sight.norm() / across : 0;
}

}  // namespace

std::optional<EdgeCrossing> edge_crossing(const ScanCloud& cloud, const std::vector<int>& run,
                                          const PlateStripes& stripes, bool at_back,
                                          const Scales& scales) {
  if (run.size() < 3) return std::nullopt;
  const JointPlate& plate = stripes.plate;
  const Line& line = stripes.line;
  const int last = at_back ? run.back() : run.front();
  const int beyond = at_back ? last + 1 : last - 1;
  const ScanStripe& stripe = cloud.stripes[cloud.origins[last].stripe];
  const bool more = beyond >= stripe.first && beyond < stripe.first + stripe.count;
  const bool joined = more && cloud.origins[beyond].segment == cloud.origins[last].segment;
  if (joined && std::abs(height_over(stripes, cloud.points[beyond])) <= scales.tolerance)
    return std::nullopt;  // the plate goes on
  // Through the seam to the other plate.
  if (joined &&
      std::binary_search(stripes.other.points.begin(), stripes.other.points.end(), beyond))
    return std::nullopt;

  const Eigen::Vector3d direction = direction_at_end(cloud, run, at_back);
  EdgeCrossing place;
  place.way_along = direction.dot(line.direction), place.way_away = direction.dot(stripes.away);
  const int inner = at_back ? run[run.size() - 2] : run[1];
  place.pixel = pixel_along(cloud, last, inner, line, stripes.away);
  if (place.pixel == 0) return std::nullopt;
  if (cloud.origins[last].segment_end) {
    // Known to a centre.
    const Eigen::Vector3d point = on_plate(cloud, stripes, last);
    place.along = line.along(point);
    place.away = stripes.away.dot(point - line.point);
    place.deviation = kVisibility.beam * scales.noise;
    place.ended = true;
  } else {
    // A segment that runs on turns at the plate's edge, if what it turns to is in sight; else the
    // plate ends between two of the points that are left.
    if (!joined) return std::nullopt;
    const Eigen::Vector3d way = cloud.points[beyond] - cloud.points[last];
    // Where the stripe leaves the plane gently, the plate is bent.
    if (std::abs(height_over(stripes, cloud.points[beyond])) < kEnds.least_turn * way.norm())
      return std::nullopt;
    const Eigen::Vector3d between = way - plate.plane.normal.dot(way) * plate.plane.normal;
    const auto turn = turn_beyond(cloud, stripes, last, at_back, scales.noise);
    const Eigen::Vector3d point = turn ? turn->place : cloud.points[last] + 0.5 * between;
    place.along = line.along(point);
    place.away = stripes.away.dot(point - line.point);
    if (turn)
      place.deviation = turn->longer * std::hypot(kEnds.cut_noise, kVisibility.beam * scales.noise);
    else
      place.spread = between.norm() / std::sqrt(12.0);
  }
  if (!more) return place;
  const double height = height_over(stripes, cloud.points[beyond]);
  place.occluded = height > 2 * scales.tolerance;
  // Not behind a shadow that is longer than the plate's own edge throws: of something before it.
  if (const auto through = seen_through(cloud, stripes, beyond, 2 * scales.tolerance))
    place.falls = (*through - cloud.points[last]).norm() <=
                  kVisibility.hidden_beside - kVisibility.hidden_slope * height;
  return place;
}

}  // namespace arcstart::seam_finding
