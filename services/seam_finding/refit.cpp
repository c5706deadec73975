#include "services/seam_finding/refit.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/outliers.hpp"
#include "services/seam_finding/plane_fit.hpp"

namespace arcstart {
namespace {

constexpr int kPasses = 2;
constexpr int kLeastPoints = 20;
constexpr double kTukey = 4.685;               // standard deviations
constexpr double kMedianToDeviation = 1.4826;  // of normal noise
constexpr std::size_t kStrips = 16;
constexpr double kStripNoise = 0.25;  // of a strip's mean height, over the points' noise
constexpr double kStripDeviations = 2.5;
constexpr double kRoughness = 1.5;  // a plate's spread over the cloud's noise that is no roughness
// The stripe's centre is drawn aside so near the other plate; mm.
constexpr double kBendWidth = 1.2;
constexpr double kLeastSpread = 3;  // of a plate's points within their plane, over their noise
constexpr double kOverhang = 3;     // beyond the seam's ends; mm

std::vector<int> beside(const ScanCloud& cloud, const Joint& joint, int plate, const Refit& refit) {
  const double bend = std::max(kBendWidth, 2 * refit.tolerance);
  std::vector<int> points;
  for (const int i : joint.plates[plate].points) {
    const Eigen::Vector3d& point = cloud.points[i];
    const double t = joint.line.along(point);
    if (cloud.origins[i].segment_end || joint.line.distance(point) > refit.distance ||
        t < joint.course.begin - kOverhang || t > joint.course.end + kOverhang ||
        std::abs(joint.plates[1 - plate].plane.signed_distance(point)) < bend)
      continue;
    points.push_back(i);
  }
  return points;
}

// Stripes are far apart and their points may be dense: neighbours need not be sought so far then.
double outlier_spacing(const ScanCloud& cloud, const std::vector<int>& points, double spacing) {
  if (points.size() < 3) return spacing;
  PlaneSums sums(cloud.points[points.front()]);
  for (const int i : points) sums.add(cloud.points[i]);
  const Eigen::Vector2d spread = sums.fit().spread;
  const double area = 12 * spread[0] * spread[1];  // of a rectangle with that spread
  return std::min(spacing, 2 * std::sqrt(area / static_cast<double>(points.size())));
}

// Of the points from the plane, as their median distance tells it; mm. A plate may be rougher than
// the cloud is where it is smoothest.
double spread_about(const std::vector<Eigen::Vector3d>& points, const Plane& plane) {
  std::vector<double> distances;
  for (const auto& point : points) distances.push_back(std::abs(plane.signed_distance(point)));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return kMedianToDeviation * *middle;
}

// Least squares in which a point counts the less the farther off it lies, and beyond a limit not at
// all (Tukey's weights). The limit narrows from pass to pass, so that what agrees within the noise
// prevails over what was drawn aside.
Plane narrowed(const std::vector<Eigen::Vector3d>& points, Plane plane, double noise,
               std::initializer_list<double> limits) {
  for (const double limit : limits) {
    const double reach = limit * kTukey * noise;
    PlaneSums sums(points.front());
    for (const auto& point : points) {
      const double off = plane.signed_distance(point) / reach;
      if (std::abs(off) < 1) sums.add(point, (1 - off * off) * (1 - off * off));
    }
    if (sums.weight() < kLeastPoints / 2) return plane;
    const auto fit = sums.fit();
    if (!(fit.spread[0] > kLeastSpread * noise)) return plane;
    plane = fit.plane.normal.dot(plane.normal) < 0 ? fit.plane.flipped() : fit.plane;
  }
  return plane;
}

// A strip of a plate along the seam.
struct Strip {
  std::size_t first = 0, last = 0;  // points
  double distance = 0, height = 0;  // means; mm
};

// The points in strips of which most lie on one line, seen along the seam. The stripe's reflection
// from the other plate shifts its centre by a tenth of a millimetre over wide strips of a plate:
// far less than single points scatter, so that only their means tell.
std::vector<Eigen::Vector3d> in_line(std::vector<Eigen::Vector3d> points, const Line& line,
                                     const Plane& plane, double noise) {
  std::sort(points.begin(), points.end(), [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return line.distance(a) < line.distance(b);
  });
  std::vector<Strip> strips(kStrips);
  for (std::size_t k = 0; k < kStrips; ++k) {
    Strip& strip = strips[k];
    strip.first = points.size() * k / kStrips;
    strip.last = points.size() * (k + 1) / kStrips;
    double weight = 0;
    for (std::size_t i = strip.first; i < strip.last; ++i) {
      const double height = plane.signed_distance(points[i]);
      if (std::abs(height) > kTukey * noise) continue;
      strip.distance += line.distance(points[i]), strip.height += height, ++weight;
    }
    if (weight == 0) return points;
    strip.distance /= weight, strip.height /= weight;
  }
  const double agree =
      noise *
      std::max(kStripNoise, kStripDeviations * std::sqrt(static_cast<double>(kStrips) /
                                                         static_cast<double>(points.size())));
  std::vector<std::size_t> most;
  double best_off = 0;
  for (std::size_t a = 0; a < kStrips; ++a)
    for (std::size_t b = a + kStrips / 4; b < kStrips; ++b) {
      const double slope = (strips[b].height - strips[a].height) /
                           std::max(1e-6, strips[b].distance - strips[a].distance);
      std::vector<std::size_t> on_it;
      double off = 0;
      for (std::size_t k = 0; k < kStrips; ++k) {
        const double residual = std::abs(strips[k].height - strips[a].height -
                                         slope * (strips[k].distance - strips[a].distance));
        if (residual <= agree) on_it.push_back(k), off += residual;
      }
      if (on_it.size() > most.size() || (on_it.size() == most.size() && off < best_off))
        most = on_it, best_off = off;
    }
  if (2 * most.size() < kStrips) return points;
  std::vector<Eigen::Vector3d> kept;
  for (const std::size_t k : most)
    kept.insert(kept.end(), points.begin() + static_cast<std::ptrdiff_t>(strips[k].first),
                points.begin() + static_cast<std::ptrdiff_t>(strips[k].last));
  return kept;
}

Plane robust_plane(const std::vector<Eigen::Vector3d>& points, const Line& line, Plane plane,
                   double cloud_noise) {
  const double noise = std::max(cloud_noise, spread_about(points, plane) / kRoughness);
  plane = narrowed(points, plane, noise, {4.0, 4.0, 2.0, 2.0, 1.0, 1.0, 0.6, 0.6, 0.6, 0.6});
  const auto kept = in_line(points, line, plane, noise);
  return narrowed(kept, plane, noise, {1.0, 1.0, 0.6, 0.6, 0.6, 0.6});
}

}  // namespace

void refit_joint(const ScanCloud& cloud, Joint& joint, const Refit& refit,
                 const CourseSearch& search) {
  for (int pass = 0; pass < kPasses; ++pass) {
    std::array<Plane, 2> planes = {joint.plates[0].plane, joint.plates[1].plane};
    for (int plate = 0; plate < 2; ++plate) {
      auto chosen = beside(cloud, joint, plate, refit);
      if (refit.neighbours > 0)
        chosen = without_outliers(cloud, chosen, refit.neighbours, refit.deviations,
                                  outlier_spacing(cloud, chosen, search.spacing));
      if (static_cast<int>(chosen.size()) < kLeastPoints)
        continue;  // the face's own plane is better
      std::vector<Eigen::Vector3d> points;
      for (const int i : chosen) points.push_back(cloud.points[i]);
      planes[plate] = robust_plane(points, joint.line, planes[plate], refit.noise);
    }
    const auto line =
        intersect(planes[0], planes[1], joint.line.at((joint.course.begin + joint.course.end) / 2));
    if (!line) return;
    joint.plates[0].plane = planes[0];
    joint.plates[1].plane = planes[1];
    const bool along = line->direction.dot(joint.line.direction) > 0;
    joint.line = {line->point, along ? line->direction : Eigen::Vector3d(-line->direction)};
    joint.angle = M_PI - angle_between(planes[0].normal, planes[1].normal);
    joint.course = find_course(cloud, joint.plates, joint.line, search);
    if (joint.course.stripes == 0) return;
  }
}

}  // namespace arcstart
