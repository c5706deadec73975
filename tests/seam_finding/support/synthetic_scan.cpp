#include "tests/seam_finding/support/synthetic_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/geometry.hpp"
#include "tests/seam_finding/support/synthetic_random.hpp"

namespace arcstart::seam_finding::synthetic {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double table_height(const Scene& scene, double x, double y) {
  return scene.table_waves * 0.5 * (std::sin(x / 17 + 0.6) + std::sin(y / 23 + x / 61));
}

// Way along the unit ray to the box's surface from outside, infinite where it misses.
double meet(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Isometry3d T_box_base = box.T_base_box.inverse();
  const Eigen::Vector3d o = T_box_base * origin, d = T_box_base.linear() * direction;
  double enter = -kInfinity, leave = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    double a = (-box.half_size[axis] - o[axis]) / d[axis],
           b = (box.half_size[axis] - o[axis]) / d[axis];
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a);
    leave = std::min(leave, b);
  }
  for (const Plane& cut : box.cuts) {
    const double height = cut.signed_distance(o), rise = cut.normal.dot(d);
    if (rise == 0 && height > 0) return kInfinity;
    if (rise < 0) enter = std::max(enter, -height / rise);
    if (rise > 0) leave = std::min(leave, -height / rise);
  }
  return enter <= leave && enter > 1e-6 ? enter : kInfinity;
}

double meet_table(const Scene& scene, const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& direction) {
  if (!scene.table || direction.z() > -0.05) return kInfinity;
  double way = -origin.z() / direction.z();
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d p = origin + way * direction;
    way += (table_height(scene, p.x(), p.y()) - p.z()) / direction.z();
  }
  return way;
}

struct Lit {
  Eigen::Vector3d point;
  Truth truth;
};
std::optional<Lit> lit_and_seen(const Scene& scene, const Eigen::Vector3d& laser,
                                const Eigen::Vector3d& direction, const Eigen::Vector3d& camera) {
  double way = meet_table(scene, laser, direction);
  Truth truth = Truth::kTable;
  for (const Box& box : scene.boxes)
    if (const double to_box = meet(box, laser, direction); to_box < way)
      way = to_box, truth = Truth::kBox;
  if (!std::isfinite(way)) return std::nullopt;
  const Eigen::Vector3d point = laser + way * direction;
  const Eigen::Vector3d back = point - camera;
  for (const Box& box : scene.boxes)
    if (meet(box, camera, back.normalized()) < back.norm() - 1e-4) return std::nullopt;
  return Lit{point, truth};
}

constexpr double kStandOff = 300;

// Where it looks, by the tool's place along the search.
struct Sensor {
  Eigen::Vector3d search = Eigen::Vector3d::UnitX(), lateral, laser_axis;
  Eigen::Vector3d axis;  // of the camera, downward over the open side

  explicit Sensor(double lean_deg)
      : axis(0, -std::sin(lean_deg * kDegree), -std::cos(lean_deg * kDegree)) {
    lateral = axis.cross(search).normalized();
    laser_axis = Eigen::AngleAxisd(22 * kDegree, lateral) * axis;
  }
  Eigen::Vector3d aim(double x) const { return x * search + Eigen::Vector3d(0, 10, 15); }
  Eigen::Vector3d camera(double x) const { return aim(x) - kStandOff * axis; }
  Eigen::Vector3d laser(double x) const { return aim(x) - kStandOff * laser_axis; }
};

}  // namespace

bool start_in_sight(const Scene& scene, const ScanChoice& choice) {
  const Sensor sensor(choice.lean_deg);
  const Eigen::Vector3d along = (scene.end - scene.start).normalized();
  const auto lit_at = [&](const Eigen::Vector3d& point) {
    // The tool's place from which the sheet falls on the point.
    const Eigen::Vector3d normal = sensor.laser_axis.cross(sensor.lateral);
    const double x = normal.dot(point - sensor.aim(0)) / normal.dot(sensor.search);
    const Eigen::Vector3d laser = sensor.laser(x), ray = (point - laser).normalized();
    const auto lit = lit_and_seen(scene, laser, ray, sensor.camera(x));
    return lit && (lit->point - point).norm() < 0.1;
  };
  // Of the plates, in each away from the other.
  for (const double r : {2.0, 3.0, 4.0})
    for (const int plate : {0, 1}) {
      const Eigen::Vector3d& n = scene.normals[plate];
      const Eigen::Vector3d other = scene.normals[1 - plate];
      const Eigen::Vector3d away = (other - other.dot(n) * n).normalized();
      if (!lit_at(scene.start + 0.05 * along + r * away)) return false;
    }
  return true;
}

SyntheticScan make_scan(const Scene& scene, const ScanChoice& choice, std::uint64_t seed) {
  Random random{std::mt19937_64(seed * 104729 + 5)};
  const Sensor sensor(choice.lean_deg);
  const Eigen::Vector3d &search = sensor.search, &lateral = sensor.lateral,
                        &laser_axis = sensor.laser_axis;
  constexpr int kHalf = 800;
  const double step = 0.125 / kStandOff;

  SyntheticScan scan;
  ScanCloud& cloud = scan.cloud;
  const double phase = random.between(0, choice.pitch);
  for (double x = choice.from + phase; x < choice.to; x += choice.pitch) {
    const Eigen::Vector3d camera = sensor.camera(x), laser = sensor.laser(x);
    const Eigen::Vector3d shift(random.normal(choice.stripe_noise),
                                random.normal(choice.stripe_noise),
                                random.normal(choice.stripe_noise));
    const auto seen = [&](double ray) -> std::optional<Lit> {
      const auto lit =
          lit_and_seen(scene, laser, (laser_axis + ray * step * lateral).normalized(), camera);
      if (!lit || std::abs((lit->point - camera).normalized().dot(lateral)) > 800.0 / 2400)
        return std::nullopt;
      return lit;
    };
    const auto joined = [](const Lit& a, const Lit& b) {
      return (a.point - b.point).norm() <= 1.5;
    };
    const auto turns = [](const Lit& before, const Lit& at, const Lit& after) {
      return angle_between(at.point - before.point, after.point - at.point) > 20 * kDegree;
    };
    std::vector<std::vector<Lit>> segments;
    std::vector<int> first_rays;
    for (int i = -kHalf; i < kHalf; ++i) {
      const auto lit = seen(i);
      if (!lit) continue;
      const bool runs_on = !segments.empty() &&
                           first_rays.back() + std::ssize(segments.back()) == i &&
                           joined(segments.back().back(), *lit);
      if (!runs_on) segments.emplace_back(), first_rays.push_back(i);
      segments.back().push_back(*lit);
    }
    // Where the light on the surface of the last ray ends before the next, which meets another.
    const auto light_end = [&](const Lit& before, Lit last, double ray, double next) {
      const Eigen::Vector3d way = last.point - before.point;
      for (int halving = 0; halving < 8; ++halving) {
        const double middle = (ray + next) / 2;
        const auto lit = seen(middle);
        if (lit && joined(*lit, last) &&
            way.normalized().cross(lit->point - before.point).norm() < 0.05)
          last = *lit, ray = middle;
        else
          next = middle;
      }
      last.point += random.normal(choice.end_noise) * way;
      return last;
    };
    int number = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      auto& segment = segments[s];
      if (segment.size() < 5) continue;
      const int first = first_rays[s], last = first + static_cast<int>(segment.size()) - 1;
      segment.front() = light_end(segment[1], segment.front(), first, first - 1);
      segment.back() = light_end(segment[segment.size() - 2], segment.back(), last, last + 1);
      for (std::size_t i = 0; i < segment.size(); ++i) {
        const bool end = i == 0 || i + 1 == segment.size();
        const bool kept = end || i % static_cast<std::size_t>(choice.downsample) == 0 ||
                          (choice.bends && turns(segment[i - 1], segment[i], segment[i + 1]));
        if (!kept) continue;
        // A centre that is off across the stripe lies elsewhere in the laser's plane.
        const Eigen::Vector3d beam = (segment[i].point - laser).normalized();
        const bool outlier = random.between(0, 1) < choice.outliers;
        const double off = outlier ? random.between(-20, 20) : random.normal(choice.noise);
        cloud.points.push_back(segment[i].point + off * beam + shift);
        scan.truth.push_back(outlier ? Truth::kOutlier : segment[i].truth);
        // From whole pixels' rays.
        const std::size_t at = std::clamp<std::size_t>(i, 1, segment.size() - 3);
        cloud.origins.push_back(
            {static_cast<int>(cloud.stripes.size()), number, end, static_cast<float>(choice.noise),
             static_cast<float>((segment[at + 1].point - segment[at].point).norm())});
      }
      ++number;
    }
    const bool any = !cloud.origins.empty() &&
                     cloud.origins.back().stripe == static_cast<int>(cloud.stripes.size());
    end_stripe(cloud, any ? ScanStripe::Seen::kSeen : ScanStripe::Seen::kEmpty, camera + shift,
               x * search + shift);
  }
  return scan;
}

}  // namespace arcstart::seam_finding::synthetic
