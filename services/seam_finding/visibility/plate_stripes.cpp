#include "services/seam_finding/visibility/plate_stripes.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/visibility/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// Leaves out short stretches of neighbours that rise from the plane all the way.
void drop_askew(const ScanCloud& cloud, const PlateStripes& stripes, double noise,
                std::vector<int>& run) {
  auto kept = run.begin();
  for (auto begin = run.begin(), end = begin; begin != run.end(); begin = end) {
    for (++end; end != run.end() && *end == end[-1] + 1 &&
                cloud.origins[*end].segment == cloud.origins[*begin].segment;)
      ++end;
    const Eigen::Vector3d &first = cloud.points[*begin], way = cloud.points[end[-1]] - first;
    bool askew = false;
    if (end - begin > 2 && way.norm() < kVisibility.long_piece) {
      const Eigen::Vector3d direction = way.normalized();
      double n = 0, s = 0, h = 0, ss = 0, sh = 0;
      for (auto i = begin; i != end; ++i) {
        const double along = direction.dot(cloud.points[*i] - first);
        const double height = height_over(stripes, cloud.points[*i]);
        n += 1, s += along, h += height, ss += along * along, sh += along * height;
      }
      const double spread = ss - s * s / n;
      askew = std::abs(sh - s * h / n) >
              kVisibility.rise * spread + kVisibility.sure_rise * noise * std::sqrt(spread);
    }
    kept = askew ? kept : std::move(begin, end, kept);
  }
  run.erase(kept, run.end());
}

// Half of the stripes that show the plate reach so far.
double usual_reach(const ScanCloud& cloud, const PlateStripes& stripes) {
  std::vector<double> reaches;
  for (const auto& run : stripes.runs) {
    double reach = 0;
    for (const int i : run)
      reach = std::max(reach, stripes.away.dot(cloud.points[i] - stripes.line.point));
    if (reach > 0) reaches.push_back(reach);
  }
  return median(reaches);
}

// Where the sight to a point so deep behind a plane meets it.
std::optional<Eigen::Vector3d> through(const ScanCloud& cloud, const Plane& plane, int point,
                                       double depth) {
  const Eigen::Vector3d sight = cloud.points[point] - cloud.seen_from(point);
  const double toward = -plane.normal.dot(sight);
  if (toward <= 0 ||
      toward * toward < kVisibility.least_sight * kVisibility.least_sight * sight.squaredNorm())
    return std::nullopt;
  return cloud.points[point] - sight * (depth / toward);
}

}  // namespace

std::optional<Eigen::Vector3d> seen_through(const ScanCloud& cloud, const PlateStripes& stripes,
                                            int point, double tolerance) {
  const double depth = -height_over(stripes, cloud.points[point]);
  if (depth <= tolerance) return std::nullopt;
  return through(cloud, stripes.plate.plane, point, depth);
}

std::optional<Eigen::Vector3d> seen_through(const ScanCloud& cloud, const Plane& plane, int point,
                                            double tolerance) {
  const double depth = -plane.signed_distance(cloud.points[point]);
  if (depth <= tolerance) return std::nullopt;
  return through(cloud, plane, point, depth);
}

PlateStripes plate_stripes(const ScanCloud& cloud, const JointPlate& plate, const JointPlate& other,
                           const Line& line, const Scales& scales) {
  PlateStripes stripes{plate, other, line, away_from_seam(plate, other),
                       std::vector<std::vector<int>>(cloud.stripes.size())};
  if (!cloud.organised()) return stripes;
  stripes.bend = plate_bend(cloud, plate, line, stripes.away, scales);
  const auto reach = [&](const Eigen::Vector3d& p) { return stripes.away.dot(p - line.point); };
  const auto add = [&](int i, std::vector<int>& run) {
    if (reach(cloud.points[i]) > scales.tolerance &&
        std::abs(height_over(stripes, cloud.points[i])) <= scales.tolerance)
      run.push_back(i);
  };
  auto point = plate.points.begin();
  for (std::size_t k = 0; k < stripes.runs.size(); ++k) {
    const ScanStripe& stripe = cloud.stripes[k];
    const int end = stripe.first + stripe.count;
    std::vector<int>& run = stripes.runs[k];
    const auto next = std::lower_bound(point, plate.points.end(), end);
    // A bent plate's own points are those in its plane alone.
    if (stripes.bend.bent())
      for (int i = stripe.first; i < end; ++i) add(i, run);
    else
      for (auto i = point; i != next; ++i) add(*i, run);
    drop_askew(cloud, stripes, scales.noise, run);
    point = next;
  }

  for (std::size_t k = 0; k < stripes.runs.size(); ++k) {
    std::vector<int>& run = stripes.runs[k];
    const auto parted = std::adjacent_find(run.begin(), run.end(), [&](int a, int b) {
      return b > a + 1 &&
             std::abs(reach(cloud.points[b]) - reach(cloud.points[a])) > kModel.piece_gap;
    });
    if (parted == run.end()) continue;
    std::vector<double> reaches, behind;
    for (const int i : run) reaches.push_back(reach(cloud.points[i]));
    std::sort(reaches.begin(), reaches.end());
    const ScanStripe& stripe = cloud.stripes[k];
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i)
      if (const auto through = seen_through(cloud, stripes, i, scales.tolerance))
        behind.push_back(reach(*through));
    for (std::size_t j = 1; j < reaches.size(); ++j) {
      const double from = reaches[j - 1], to = reaches[j];
      if (to - from <= kModel.piece_gap ||
          std::count_if(behind.begin(), behind.end(),
                        [&](double r) { return r > from && r < to; }) < kModel.sure_off_plate)
        continue;
      std::erase_if(run, [&](int i) { return reach(cloud.points[i]) >= to; });
      break;
    }
  }
  stripes.reach = usual_reach(cloud, stripes);
  return stripes;
}

}  // namespace arcstart::seam_finding
