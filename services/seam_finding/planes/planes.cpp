#include "services/seam_finding/planes/planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "common/order_statistics.hpp"
#include "services/seam_finding/cloud/connected_components.hpp"
#include "services/seam_finding/cloud/neighbour_grid.hpp"
#include "services/seam_finding/cloud/plane_points.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"
#include "services/seam_finding/planes/constants.hpp"
#include "services/seam_finding/planes/plane_hypotheses.hpp"
#include "services/seam_finding/planes/stripe_planes.hpp"

namespace arcstart::seam_finding {
namespace {

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

// Least squares through what lies near the plane.
Plane refit(const std::vector<Eigen::Vector3d>& points, const PlanePoints& side_by_side,
            const Plane& plane, double tolerance) {
  std::vector<int> near;
  side_by_side.find_near(plane, tolerance, near);
  PlaneSums sums(points.front());
  sums.add(points, near);
  if (sums.weight() < 3) return plane;
  const auto fit = sums.fit();
  if (!(fit.spread[0] > 1e-6)) return plane;
  return fit.plane.normal.dot(plane.normal) < 0 ? fit.plane.flipped() : fit.plane;
}

std::vector<Eigen::Vector3d> shuffled(std::vector<Eigen::Vector3d> points, Dice& dice) {
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[dice.below(i)]);
  return points;
}

// Points in random order that say how much a hypothesis is worth.
class Jury {
 public:
  Jury(std::vector<Eigen::Vector3d> points, const PlaneSearch& search, double connection)
      : search_(search),
        points_(std::move(points)),
        side_by_side_(points_),
        pieces_(NeighbourGrid(points_, connection)) {}

  // Points of the largest connected piece on the plane; 0 where it is plain early that they are not
  // more than `most`.
  int worth(const Plane& plane, int most) {
    const std::size_t first = std::min(kPlanes.first_look, points_.size());
    int near = side_by_side_.count_near(plane, search_.tolerance, 0, first);
    const double expected = static_cast<double>(most) * static_cast<double>(first) /
                            static_cast<double>(points_.size());
    if (near + 3 * std::sqrt(expected) < expected) return 0;
    near += side_by_side_.count_near(plane, search_.tolerance, first, points_.size());
    if (near <= most) return 0;
    side_by_side_.find_near(plane, search_.tolerance, on_it_);
    return pieces_.largest_size(on_it_);
  }
  // What a face of so many points is worth.
  int share_of(int points, std::size_t all) const {
    return static_cast<int>(static_cast<double>(points) * static_cast<double>(points_.size()) /
                            static_cast<double>(all));
  }
  Plane better(const Plane& plane) const {
    return refit(points_, side_by_side_, plane, search_.tolerance);
  }

 private:
  const PlaneSearch& search_;
  std::vector<Eigen::Vector3d> points_;
  PlanePoints side_by_side_;
  Pieces pieces_;
  std::vector<int> on_it_;
};

// From an even sample of the points. Three points drawn from one neighbourhood lie on one face far
// more often than three drawn from all.
std::optional<Plane> best_hypothesis(const std::vector<Eigen::Vector3d>& points,
                                     const PlaneSearch& search, Dice& dice) {
  const std::size_t step = jury_step(points.size());
  const std::vector<Eigen::Vector3d> sample = every(step, dice.below(step), points);
  Jury jury(shuffled(sample, dice), search,
            search.connection * std::sqrt(static_cast<double>(step)));
  const NeighbourGrid neighbourhoods(sample, search.locality);
  const std::vector<int> cells = neighbourhoods.cells_of_points();
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
    const std::size_t first = dice.below(sample.size());
    const auto around = neighbourhoods.points_in(cells[first]);
    const Eigen::Vector3d& second = sample[around[dice.below(around.size())]];
    const Eigen::Vector3d& third = sample[around[dice.below(around.size())]];
    const auto plane = plane_through(sample[first], second, third, 4 * search.tolerance);
    if (plane && take(*plane)) take(jury.better(*plane));
  }
  return best;
}

// The points among which faces are sought, and those of them that are in none yet.
struct Sought {
  const std::vector<Eigen::Vector3d>& points;
  std::vector<char> segment_ends;  // of each: it is not fitted
  Pieces pieces;
  PlanePoints left;
};

// The connected piece that a hypothesis stands for, and its own least-squares plane. Its points are
// told by their places among those sought.
Face grow(Sought& sought, Plane plane, const PlaneSearch& search) {
  Face face;
  std::vector<int> near, before, inside;
  for (int pass = 0; pass < kPlanes.growths; ++pass) {
    face.plane = plane;
    sought.left.find_near(plane, search.tolerance, near);
    if (pass > 0 && near == before) break;  // the same points have the same plane
    before = face.points = near;
    sought.pieces.keep_largest(face.points);
    PlaneSums sums(face.points.empty() ? Eigen::Vector3d::Zero()
                                       : sought.points[face.points.front()]);
    inside.clear();
    for (const int i : face.points)
      if (!sought.segment_ends[i]) inside.push_back(i);
    sums.add(sought.points, inside);
    face.rms = 0;
    if (sums.weight() < 3) break;
    const auto fit = sums.fit();
    face.rms = fit.rms;
    if (!(fit.spread[0] > 1e-6) || (search.accept && !search.accept(fit.plane))) break;
    plane = fit.plane;
  }
  return face;
}

// By three points drawn from those that are in no face yet.
std::optional<Plane> drawn_plane(const Sought& sought, const PlaneSearch& search, Dice& dice) {
  std::vector<Eigen::Vector3d> inside;
  for (const int i : sought.left.places())
    if (!sought.segment_ends[i]) inside.push_back(sought.points[i]);
  if (static_cast<int>(inside.size()) < search.least_points) return std::nullopt;
  return best_hypothesis(inside, search, dice);
}

// Squared distances from a point to the four nearest others that are chosen; infinite for none. Of
// a crowded cell 256 points are looked at.
std::array<double, 4> nearest_four(const NeighbourGrid& grid, int point,
                                   const std::vector<char>& chosen) {
  std::array<double, 4> nearest;
  nearest.fill(INFINITY);
  const Eigen::Vector3d& centre = grid.points()[static_cast<std::size_t>(point)];
  grid.for_each_around(grid.cell_of(centre), [&](int cell) {
    const auto inside = grid.points_in(cell);
    for (std::size_t k = 0; k < inside.size(); k += 1 + inside.size() / kCloud.crowd) {
      const auto other = static_cast<std::size_t>(inside[k]);
      if (!chosen[other] || inside[k] == point) continue;
      double squared = (grid.points()[other] - centre).squaredNorm();
      for (double& one : nearest)
        if (squared < one) std::swap(squared, one);
    }
  });
  return nearest;
}

// Half of the points of a face have four neighbours nearer than this: on a grid two on each of its
// two lines. points: their places in the grid, whose cells are as wide as points hang together.
double spacing_of(const NeighbourGrid& grid, const std::vector<int>& points) {
  std::vector<char> chosen(grid.points().size());
  for (const int i : points) chosen[i] = true;
  std::vector<double> fourth;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 32) {
    const double squared = nearest_four(grid, points[i], chosen).back();
    fourth.push_back(std::isinf(squared) ? grid.cell_size() : std::sqrt(squared));
  }
  return median(fourth);
}

}  // namespace

std::vector<Face> find_faces(const ScanCloud& cloud, std::vector<int> indices,
                             const PlaneSearch& search, std::uint64_t seed) {
  std::vector<Eigen::Vector3d> points;
  std::vector<char> segment_ends;
  points.reserve(indices.size()), segment_ends.reserve(indices.size());
  for (const int i : indices) {
    points.push_back(cloud.points[i]);
    segment_ends.push_back(cloud.origins[i].segment_end);
  }
  const NeighbourGrid grid(points, search.connection);
  Sought sought{points, std::move(segment_ends), Pieces(grid), PlanePoints(points)};
  PlaneHypotheses suggested(planes_of_stripes(cloud, indices, search), sought.points, sought.pieces,
                            search);
  std::vector<Face> faces;
  Dice dice(seed);
  while (static_cast<int>(faces.size()) < search.most_faces) {
    auto plane = suggested.best();
    const bool drawn = !plane;
    if (drawn) plane = drawn_plane(sought, search, dice);
    if (!plane) break;
    Face face = grow(sought, *plane, search);
    if (static_cast<int>(face.points.size()) < search.least_points) {
      if (drawn) break;
      continue;
    }
    sought.left.remove(face.points);
    suggested.remove(face.points);
    face.spacing = spacing_of(grid, face.points);
    for (int& i : face.points) i = indices[i];
    faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace arcstart::seam_finding
