#include "services/seam_finding/ends/edge_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/fit/order_statistics.hpp"

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

// The usual way between the points that are left of a stripe.
double thinned_step(const ScanCloud& cloud, const std::vector<int>& run) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < run.size(); i += 1 + run.size() / kEnds.step_sample)
    steps.push_back((cloud.points[run[i]] - cloud.points[run[i - 1]]).norm());
  return median(steps);
}

// Where along the seam the cut is over whose edge the stripe turns, from its next points: a cut is
// square to the plate, so that what lies on it lies at the edge.
std::optional<double> cut_beyond(const ScanCloud& cloud, const JointPlate& plate, const Line& line,
                                 int last, bool at_back, const Scales& scales) {
  const int step = at_back ? 1 : -1;
  double sum = 0, first_along = 0, first_depth = 0;
  for (int k = 1; k <= kEnds.most_on_cut; ++k) {
    const int i = last + k * step;
    if (i < 0 || i >= cloud.size() || cloud.origins[i].stripe != cloud.origins[last].stripe ||
        cloud.origins[i].segment != cloud.origins[last].segment)
      break;
    const double along = line.along(cloud.points[i]);
    const double depth = -plate.plane.signed_distance(cloud.points[i]);
    if (k == 1) first_along = along, first_depth = depth;
    sum += along;
    const double drop = depth - first_depth;
    if (drop < kEnds.least_drop) continue;
    if (std::abs(along - first_along) >
        kEnds.cut_slant * drop + kFit.outlier * kVisibility.beam * scales.noise)
      break;
    return sum / k;
  }
  return std::nullopt;
}

// Where the light at a segment's end lies. Of a stripe that is cut off at a slant the last of the
// light lies beside the laser's plane, but on the plate it does lie: where the line of sight meets
// it.
std::optional<Eigen::Vector3d> on_plate(const ScanCloud& cloud, const PlateStripes& stripes,
                                        int i) {
  const Eigen::Vector3d& eye = cloud.seen_from(i);
  const Eigen::Vector3d sight = cloud.points[i] - eye;
  const double toward = -stripes.plate.plane.normal.dot(sight.normalized());
  if (toward < kVisibility.least_sight) return std::nullopt;
  return cloud.points[i] + sight.normalized() * (height_over(stripes, cloud.points[i]) / toward);
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
                                          const PlateStripes& stripes, SeamSide side,
                                          const Scales& scales,
                                          const SeamFindingSettings& settings) {
  if (run.size() < 3) return std::nullopt;
  const JointPlate& plate = stripes.plate;
  const Line& line = stripes.line;
  const bool rising = line.along(cloud.points[run.back()]) > line.along(cloud.points[run.front()]);
  const bool at_back = rising == (side == SeamSide::kEnd);
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
  const double slant = std::abs(direction.dot(line.direction));
  if (slant < kEnds.least_slant) return std::nullopt;
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  EdgeCrossing place;
  if (cloud.origins[last].segment_end) {
    // Known to a centre.
    const auto point = on_plate(cloud, stripes, last);
    if (!point) return std::nullopt;
    const int inner = at_back ? run[run.size() - 2] : run[1];
    place.pixel = pixel_along(cloud, last, inner, line, stripes.away);
    place.along = line.along(*point) + outward * settings.edge_shortening_px * place.pixel;
    place.away = stripes.away.dot(*point - line.point);
    const double end =
        kEnds.light_deviation + kEnds.flat_deviation * std::max(0.0, kEnds.flat_crossing - slant);
    place.deviation = std::hypot(end * place.pixel, kVisibility.beam * scales.noise);
    place.sharp = true;
  } else {
    // A segment that runs on turns at the plate's edge into the cut, if the cut is in sight; else
    // the plate ends between two of the points that are left.
    const double step = thinned_step(cloud, run);
    const auto cut = cut_beyond(cloud, plate, line, last, at_back, scales);
    const Eigen::Vector3d point = cloud.points[last] + 0.5 * step * direction;
    place.along = cut ? *cut : line.along(point);
    place.away = stripes.away.dot(point - line.point);
    if (cut) {
      place.deviation = std::hypot(kEnds.cut_noise, kVisibility.beam * scales.noise);
    } else {
      // Where the stripe leaves the plane gently, the plate is bent.
      if (joined && std::abs(height_over(stripes, cloud.points[beyond])) <
                        kEnds.least_turn * (cloud.points[beyond] - cloud.points[last]).norm())
        return std::nullopt;
      place.deviation = slant * step / std::sqrt(12.0);
      place.deviation_away = direction.dot(stripes.away) * step / std::sqrt(12.0);
    }
    place.sharp = cut.has_value();
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
