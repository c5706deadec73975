#include "services/seam_finding/planes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "services/seam_finding/components.hpp"
#include "services/seam_finding/neighbour_grid.hpp"
#include "services/seam_finding/plane_fit.hpp"

namespace arcstart {
namespace {

constexpr std::size_t kJury = 4096;      // points that judge a hypothesis
constexpr std::size_t kFirstLook = 256;  // of those, after which a poor one is given up
constexpr int kRefits = 5;

// std::uniform_int_distribution and std::shuffle differ between standard libraries; this does not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

std::optional<Plane> plane_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c, double least_height) {
  const Eigen::Vector3d ab = b - a, ac = c - a, normal = ab.cross(ac);
  const double longest = std::max({ab.norm(), ac.norm(), (c - b).norm()});
  if (!(normal.norm() > longest * least_height)) return std::nullopt;
  Plane plane;
  plane.normal = normal.normalized();
  plane.offset = -plane.normal.dot(a);
  return plane;
}

Plane refit(const std::vector<Eigen::Vector3d>& points, const Plane& plane, double tolerance) {
  PlaneSums sums(points.front());
  for (const auto& point : points)
    if (std::abs(plane.signed_distance(point)) <= tolerance) sums.add(point);
  if (sums.weight() < 3) return plane;
  const auto fit = sums.fit();
  if (!(fit.spread[0] > 1e-6)) return plane;
  return fit.plane.normal.dot(plane.normal) < 0 ? fit.plane.flipped() : fit.plane;
}

// An even sample of the points, in random order, that says how much a hypothesis is worth.
class Jury {
 public:
  Jury(const std::vector<Eigen::Vector3d>& points, const PlaneSearch& search, Dice& dice)
      : search_(search) {
    const std::size_t step = std::max<std::size_t>(1, (points.size() + kJury - 1) / kJury);
    for (std::size_t i = dice.below(step); i < points.size(); i += step)
      points_.push_back(points[i]);
    for (std::size_t i = points_.size(); i > 1; --i)
      std::swap(points_[i - 1], points_[dice.below(i)]);
    connection_ = search.connection * std::sqrt(static_cast<double>(step));
  }

  // Points of the largest connected piece on the plane; 0 where it is plain early that they are not
  // more than `most`.
  int worth(const Plane& plane, int most) const {
    std::size_t near = 0, i = 0;
    const auto count_to = [&](std::size_t end) {
      for (; i < end; ++i) near += std::abs(plane.signed_distance(points_[i])) <= search_.tolerance;
    };
    const std::size_t first = std::min(kFirstLook, points_.size());
    count_to(first);
    const double expected = static_cast<double>(most) * static_cast<double>(first) /
                            static_cast<double>(points_.size());
    if (static_cast<double>(near) + 3 * std::sqrt(expected) < expected) return 0;
    count_to(points_.size());
    if (near <= static_cast<std::size_t>(most)) return 0;
    std::vector<Eigen::Vector3d> on_it;
    for (const auto& point : points_)
      if (std::abs(plane.signed_distance(point)) <= search_.tolerance) on_it.push_back(point);
    return static_cast<int>(largest_component(on_it, connection_).size());
  }
  // What a face of so many points is worth.
  int share_of(int points, std::size_t all) const {
    return static_cast<int>(static_cast<double>(points) * static_cast<double>(points_.size()) /
                            static_cast<double>(all));
  }
  Plane better(const Plane& plane) const { return refit(points_, plane, search_.tolerance); }

 private:
  const PlaneSearch& search_;
  std::vector<Eigen::Vector3d> points_;
  double connection_;
};

// Three points drawn from one neighbourhood lie on one face far more often than three drawn from
// all.
std::optional<Plane> best_hypothesis(const std::vector<Eigen::Vector3d>& points,
                                     const PlaneSearch& search, Dice& dice) {
  const Jury jury(points, search, dice);
  const NeighbourGrid neighbourhoods(points, search.locality);
  std::optional<Plane> best;
  int most = std::max(2, jury.share_of(search.least_points, points.size()) - 1);
  const auto take = [&](const Plane& plane) {
    if (search.accept && !search.accept(plane)) return false;
    const int worth = jury.worth(plane, most);
    if (worth <= most) return false;
    most = worth;
    best = plane;
    return true;
  };
  for (int i = 0; i < search.hypotheses; ++i) {
    const Eigen::Vector3d& first = points[dice.below(points.size())];
    const auto around = neighbourhoods.points_in(neighbourhoods.cell_of(first));
    const Eigen::Vector3d& second = points[around[dice.below(around.size())]];
    const Eigen::Vector3d& third = points[around[dice.below(around.size())]];
    const auto plane = plane_through(first, second, third, 4 * search.tolerance);
    if (plane && take(*plane)) take(jury.better(*plane));
  }
  return best;
}

// The connected piece that a hypothesis stands for, and its own least-squares plane.
Face grow(const ScanCloud& cloud, const std::vector<int>& indices, Plane plane,
          const PlaneSearch& search) {
  Face face;
  for (int pass = 0; pass < kRefits; ++pass) {
    std::vector<int> near;
    std::vector<Eigen::Vector3d> points;
    for (const int i : indices)
      if (std::abs(plane.signed_distance(cloud.points[i])) <= search.tolerance)
        near.push_back(i), points.push_back(cloud.points[i]);
    face = {plane, 0, 0, {}};
    PlaneSums sums(points.empty() ? Eigen::Vector3d::Zero() : points.front());
    for (const int position : largest_component(points, search.connection)) {
      face.points.push_back(near[position]);
      if (!cloud.origins[near[position]].segment_end) sums.add(points[position]);
    }
    if (sums.weight() < 3) break;
    const auto fit = sums.fit();
    face.rms = fit.rms;
    if (!(fit.spread[0] > 1e-6) || (search.accept && !search.accept(fit.plane))) break;
    plane = fit.plane;
  }
  return face;
}

// Half of the points of a face have four neighbours nearer than this: on a grid two on each of its
// two lines.
double spacing_of(const ScanCloud& cloud, const Face& face, double connection) {
  std::vector<Eigen::Vector3d> points;
  for (const int i : face.points) points.push_back(cloud.points[i]);
  const NeighbourGrid grid(points, connection);
  std::vector<double> distances, fourth;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 64) {
    grid.nearest_distances(static_cast<int>(i), 4, distances);
    fourth.push_back(distances.size() == 4 ? distances.back() : connection);
  }
  const auto middle = fourth.begin() + static_cast<std::ptrdiff_t>(fourth.size() / 2);
  std::nth_element(fourth.begin(), middle, fourth.end());
  return *middle;
}

}  // namespace

std::vector<Face> find_faces(const ScanCloud& cloud, std::vector<int> indices,
                             const PlaneSearch& search, std::uint64_t seed) {
  std::vector<Face> faces;
  Dice dice(seed);
  while (static_cast<int>(faces.size()) < search.most_faces) {
    std::vector<Eigen::Vector3d> inside;
    for (const int i : indices)
      if (!cloud.origins[i].segment_end) inside.push_back(cloud.points[i]);
    if (static_cast<int>(inside.size()) < search.least_points) break;
    const auto hypothesis = best_hypothesis(inside, search, dice);
    if (!hypothesis) break;
    Face face = grow(cloud, indices, *hypothesis, search);
    if (static_cast<int>(face.points.size()) < search.least_points) break;
    std::vector<int> left;
    std::set_difference(indices.begin(), indices.end(), face.points.begin(), face.points.end(),
                        std::back_inserter(left));
    indices = std::move(left);
    face.spacing = spacing_of(cloud, face, search.connection);
    faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace arcstart
