#include "services/cell_simulator/scene/triangle_hierarchy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace arcstart::cell_simulator {
namespace {

constexpr int leaf_size = 4;

// Where the edge from p to q, at signed distances dp and dq of unlike sign, meets the plane. Both
// neighbours of an edge must come to the same point bit by bit, whichever way round they hold it.
Eigen::Vector3d crossing(const Eigen::Vector3d& p, double dp, const Eigen::Vector3d& q, double dq) {
  const bool swap = std::lexicographical_compare(q.data(), q.data() + 3, p.data(), p.data() + 3);
  const Eigen::Vector3d &from = swap ? q : p, &to = swap ? p : q;
  const double d_from = swap ? dq : dp, d_to = swap ? dp : dq;
  return from + (to - from) * (d_from / (d_from - d_to));
}

// Share of the way along `ray` from `from` to the triangle (Moeller and Trumbore 1997), infinite
// where it misses.
double meet(const Triangle& triangle, const Eigen::Vector3d& from, const Eigen::Vector3d& ray) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d ab = triangle.b - triangle.a, ac = triangle.c - triangle.a;
  const Eigen::Vector3d p = ray.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return nowhere;
  const Eigen::Vector3d to_from = from - triangle.a;
  const double u = to_from.dot(p) / determinant;
  if (u < 0 || u > 1) return nowhere;
  const Eigen::Vector3d q = to_from.cross(ab);
  const double v = ray.dot(q) / determinant;
  if (v < 0 || u + v > 1) return nowhere;
  const double share = ac.dot(q) / determinant;
  return share > 0 ? share : nowhere;
}

// Does the ray, as far as `longest` of its length, touch the box?
bool touches(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Eigen::Vector3d& from,
             const Eigen::Vector3d& inverse_ray, double longest) {
  double enter = 0, leave = longest;
  for (int axis = 0; axis < 3; ++axis) {
    const double t1 = (low[axis] - from[axis]) * inverse_ray[axis];
    const double t2 = (high[axis] - from[axis]) * inverse_ray[axis];
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  return enter <= leave * (1 + 1e-12) + 1e-15;
}

}  // namespace

TriangleHierarchy::TriangleHierarchy(const std::vector<const TriangleMesh*>& meshes) {
  std::vector<Triangle> triangles;
  std::vector<int> objects;
  for (std::size_t object = 0; object < meshes.size(); ++object) {
    for (const auto& [a, b, c] : meshes[object]->triangles) {
      const auto& corners = meshes[object]->corners;
      Triangle triangle{corners[a], corners[b], corners[c], {}};
      triangle.normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
      const double length = triangle.normal.norm();
      if (!(length > 1e-12)) continue;
      triangle.normal /= length;
      triangles.push_back(triangle);
      objects.push_back(static_cast<int>(object));
    }
  }
  std::vector<Eigen::Vector3d> centres;
  for (const auto& t : triangles) centres.push_back((t.a + t.b + t.c) / 3);
  std::vector<int> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  triangles_ = triangles;
  if (!order.empty()) build(0, static_cast<int>(order.size()), order, centres);
  for (std::size_t i = 0; i < order.size(); ++i) {
    triangles_[i] = triangles[order[i]];
    objects_.push_back(objects[order[i]]);
  }
}

int TriangleHierarchy::build(int begin, int end, std::vector<int>& order,
                             const std::vector<Eigen::Vector3d>& centres) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(infinity), high = -low;
  Eigen::Vector3d low_centre = low, high_centre = high;
  for (int i = begin; i < end; ++i) {
    const Triangle& t = triangles_[order[i]];
    low = low.cwiseMin(t.a).cwiseMin(t.b).cwiseMin(t.c);
    high = high.cwiseMax(t.a).cwiseMax(t.b).cwiseMax(t.c);
    low_centre = low_centre.cwiseMin(centres[order[i]]);
    high_centre = high_centre.cwiseMax(centres[order[i]]);
  }
  // A little larger than it is: flat boxes have no face that a ray could run in, where 0 * infinity
  // is no number.
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(1e-7);
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({low - margin, high + margin, begin, end, true});
  if (end - begin <= leaf_size) return node;
  int axis;
  (high_centre - low_centre).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(
      order.begin() + begin, order.begin() + middle, order.begin() + end, [&](int left, int right) {
        return std::pair(centres[left][axis], left) < std::pair(centres[right][axis], right);
      });
  build(begin, middle, order, centres);
  const int right = build(middle, end, order, centres);
  nodes_[node].leaf = false;
  nodes_[node].begin = right;
  return node;
}

void TriangleHierarchy::cut(const Eigen::Vector3d& normal, double offset,
                            std::vector<PlaneCut>& cuts) const {
  if (nodes_.empty()) return;
  const Eigen::Vector3d size = normal.cwiseAbs();
  std::array<int, 64> waiting;
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const int index = waiting[--count];
    const Node& node = nodes_[index];
    const double middle = normal.dot(node.low + node.high) / 2 + offset;
    if (std::abs(middle) > size.dot(node.high - node.low) / 2 + 1e-9) continue;
    if (!node.leaf) {
      waiting[count++] = node.begin;
      waiting[count++] = index + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const Triangle& t = triangles_[i];
      const double a = normal.dot(t.a) + offset, b = normal.dot(t.b) + offset,
                   c = normal.dot(t.c) + offset;
      // A corner in the plane counts as above it, so that every cut triangle has two crossed edges.
      const bool above_a = a >= 0, above_b = b >= 0, above_c = c >= 0;
      if (above_a == above_b && above_b == above_c) continue;
      std::array<Eigen::Vector3d, 2> ends;
      int found = 0;
      if (above_a != above_b) ends[found++] = crossing(t.a, a, t.b, b);
      if (above_b != above_c) ends[found++] = crossing(t.b, b, t.c, c);
      if (above_c != above_a) ends[found++] = crossing(t.c, c, t.a, a);
      cuts.push_back({ends[0], ends[1], i});
    }
  }
}

bool TriangleHierarchy::blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                double clearance, int but) const {
  if (nodes_.empty()) return false;
  const Eigen::Vector3d ray = to - from, inverse = ray.cwiseInverse();
  const double longest = 1 - clearance / ray.norm();
  std::array<int, 64> waiting;
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const int index = waiting[--count];
    const Node& node = nodes_[index];
    if (!touches(node.low, node.high, from, inverse, longest)) continue;
    if (!node.leaf) {
      waiting[count++] = node.begin;
      waiting[count++] = index + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i)
      if (i != but && meet(triangles_[i], from, ray) < longest) return true;
  }
  return false;
}

double TriangleHierarchy::first_hit(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                    int* triangle) const {
  double nearest = std::numeric_limits<double>::infinity();
  if (nodes_.empty()) return nearest;
  const Eigen::Vector3d ray = to - from, inverse = ray.cwiseInverse();
  std::array<int, 64> waiting;
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const int index = waiting[--count];
    const Node& node = nodes_[index];
    if (!touches(node.low, node.high, from, inverse, std::min(nearest, 1.0))) continue;
    if (!node.leaf) {
      waiting[count++] = node.begin;
      waiting[count++] = index + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const double share = meet(triangles_[i], from, ray);
      if (share > nearest) continue;
      nearest = share;
      if (triangle) *triangle = i;
    }
  }
  return nearest;
}

}  // namespace arcstart::cell_simulator
