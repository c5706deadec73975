#include "tests/seam_finding/synthetic_scan.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <random>

namespace arcstart::synthetic {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Random {
  std::mt19937_64 engine;
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double normal(double deviation) {
    return std::normal_distribution<double>(0, 1)(engine) * deviation;
  }
};

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

Box standing_box(const Eigen::Isometry3d& frame, const Eigen::Vector3d& corner,
                 const Eigen::Vector3d& size) {
  Box box;
  box.half_size = size / 2;
  box.T_base_box = frame * Eigen::Translation3d(corner + size / 2);
  return box;
}

// Takes away what lies before a plane through a point, both in the frame of standing_box().
void cut(Box& box, const Eigen::Isometry3d& frame, const Eigen::Vector3d& point,
         const Eigen::Vector3d& normal) {
  const Eigen::Vector3d at = box.T_base_box.inverse() * (frame * point);
  box.cuts.push_back({normal.normalized(), -normal.normalized().dot(at)});
}

// The work's frame: x along the seam, which runs in the first plate's top; the open side is +y.
struct Sizes {
  double length, width, height, base, thickness;
};
void add_other_joint(Scene& scene, const std::string& joint, const Eigen::Isometry3d& work,
                     const Sizes& s) {
  using Vector = Eigen::Vector3d;
  const auto at = [&](double x, double y, double z) { return Vector(x, y, z); };
  Eigen::Isometry3d top = work * Eigen::Translation3d(0, 0, s.base);  // of the first plate
  Vector second = Vector::UnitZ();
  if (joint == "lap") {
    scene.boxes.push_back(standing_box(work, at(-5, -s.width / 2, 0), {s.length, s.width, s.base}));
    scene.boxes.push_back(
        standing_box(top, at(0, -s.height, 0), {s.length, s.height, s.thickness}));
  } else if (joint == "outside_corner") {
    top = top * Eigen::Translation3d(0, 0, s.height);
    Box flat = standing_box(top, at(-5, -s.width / 2, -s.base), {s.length, s.width / 2, s.base});
    cut(flat, top, at(0, 0, 0), at(0, 1, -1));
    Box wall = standing_box(top, at(0, -s.thickness, -s.height), {s.length, s.thickness, s.height});
    cut(wall, top, at(0, 0, 0), at(0, -1, 1));
    scene.boxes.push_back(flat);
    scene.boxes.push_back(wall);
    second = Vector::UnitY();
  } else {
    const double slant = joint == "v" ? 30 * kDegree : 0, root = joint == "v" ? 1 : 0.5;
    Box near = standing_box(top, at(-5, root, -s.base), {s.length, s.width / 2, s.base});
    Box far = standing_box(top, at(0, -root - s.height, -s.base), {s.length, s.height, s.base});
    cut(near, top, at(0, root, -s.base), at(0, -std::cos(slant), std::sin(slant)));
    cut(far, top, at(0, -root, -s.base), at(0, std::cos(slant), std::sin(slant)));
    scene.boxes.push_back(near);
    scene.boxes.push_back(far);
  }
  scene.joint_type = joint;
  scene.start = top * at(0, 0, 0);
  scene.end = top * at(s.length - 5, 0, 0);
  scene.normals[0] = work.linear() * Vector::UnitZ();
  scene.normals[1] = work.linear() * second;
}

Eigen::Isometry3d placed(double x, double y, double yaw) {
  return Eigen::Translation3d(x, y, 0) *
         Eigen::Isometry3d(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
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

Scene make_scene(const SceneChoice& choice, std::uint64_t seed) {
  Random random{std::mt19937_64(seed * 7919 + 17)};
  Scene scene;
  const double length = random.between(80, 120), width = random.between(88, 132),
               height = random.between(36, 54);
  const double base = random.between(8, 12), thickness = random.between(6.5, 9.5);
  Eigen::Isometry3d work =
      placed(random.between(-12, 12), random.between(-12, 12), random.between(-15, 15) * kDegree);
  work = work * Eigen::AngleAxisd(random.between(-3, 3) * kDegree, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(random.between(-3, 3) * kDegree, Eigen::Vector3d::UnitY());
  work.translation().z() += 2;  // what is tilted would dip into the table
  if (choice.workpiece && choice.joint != "tee") {
    add_other_joint(scene, choice.joint, work, {length, width, height, base, thickness});
  } else if (choice.workpiece) {
    const double before = choice.base_overhang;
    scene.boxes.push_back(
        standing_box(work, {-before, -width / 2, 0}, {length + 2 * before, width, base}));
    if (!choice.lone_plate) {
      // The upright's face toward +y stands on the seam; it leans by turning about it.
      const Eigen::Isometry3d foot =
          work * Eigen::Translation3d(0, 0, base) *
          Eigen::Isometry3d(
              Eigen::AngleAxisd((90 - choice.tilt_deg) * kDegree * -1, Eigen::Vector3d::UnitX()));
      scene.boxes.push_back(standing_box(foot, {0, -thickness, 0}, {length, thickness, height}));
      const double first = std::max(0.0, -before), last = length + std::min(0.0, before);
      scene.start = work * Eigen::Vector3d(first, 0, base);
      scene.end = work * Eigen::Vector3d(last, 0, base);
      scene.normals[0] = work.linear() * Eigen::Vector3d::UnitZ();
      scene.normals[1] = foot.linear() * Eigen::Vector3d::UnitY();
    }
  }
  if (choice.box_on_base) {
    const Eigen::Isometry3d on_base =
        work * Eigen::Translation3d(random.between(-5, 25), random.between(4, 35), base) *
        Eigen::AngleAxisd(random.between(-40, 40) * kDegree, Eigen::Vector3d::UnitZ());
    scene.boxes.push_back(
        standing_box(on_base, {0, 0, 0},
                     {random.between(12, 25), random.between(12, 25), random.between(8, 25)}));
  }
  if (choice.tool) {  // handle and head of a hammer
    const auto lying =
        placed(random.between(0, 70), random.between(62, 75), random.between(-40, 40) * kDegree);
    scene.boxes.push_back(standing_box(lying, {0, 0, 0}, {80, 14, 14}));
    scene.boxes.push_back(standing_box(lying, {80, -20, 0}, {20, 54, 22}));
  }
  if (choice.big_box)
    scene.boxes.push_back(standing_box(
        placed(random.between(-20, 0), random.between(66, 72), random.between(-8, 8) * kDegree),
        {0, 0, 0}, {random.between(120, 150), 70, random.between(30, 45)}));
  return scene;
}

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
        if (!end && i % static_cast<std::size_t>(choice.thin) != 0) continue;
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

}  // namespace arcstart::synthetic
