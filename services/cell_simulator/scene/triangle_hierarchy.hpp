// A bounding-box tree over the triangles of a scene: what a plane cuts, and whether something
// stands in the way.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "services/cell_simulator/scene/triangle_mesh.hpp"

namespace arcstart::cell_simulator {

struct Triangle {
  Eigen::Vector3d a, b, c;
  Eigen::Vector3d normal;  // unit, outward
};

// Where a plane cuts one triangle.
struct PlaneCut {
  Eigen::Vector3d begin, end;
  int triangle;
};

class TriangleHierarchy {
 public:
  TriangleHierarchy() = default;
  // Degenerate triangles (no area) are left out. Objects are numbered as they come.
  explicit TriangleHierarchy(const std::vector<const TriangleMesh*>& meshes);

  int size() const { return static_cast<int>(triangles_.size()); }
  const Triangle& triangle(int index) const { return triangles_[index]; }
  int object_of(int index) const { return objects_[index]; }

  // Every segment in which the plane normal.dot(p) + offset = 0 cuts a triangle, appended to
  // `cuts`.
  void cut(const Eigen::Vector3d& normal, double offset, std::vector<PlaneCut>& cuts) const;

  // Does any triangle cut the segment from `from` to `to`, more than `clearance` mm before its end?
  // Triangle `but`
  // (-1 for none) is passed over.
  bool blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double clearance,
               int but) const;

  // Share of the way (0 to 1) to the first triangle on the segment, above 1 where there is none.
  // Also its index.
  double first_hit(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   int* triangle = nullptr) const;

 private:
  struct Node {
    Eigen::Vector3d low, high;
    int begin, end;  // of its triangles where it is a leaf, else begin = index of the right child
    bool leaf;       // the left child is the next node
  };
  int build(int begin, int end, std::vector<int>& order,
            const std::vector<Eigen::Vector3d>& centres);

  std::vector<Triangle> triangles_;  // in the tree's order
  std::vector<int> objects_;         // of each triangle
  std::vector<Node> nodes_;
};

}  // namespace arcstart::cell_simulator
