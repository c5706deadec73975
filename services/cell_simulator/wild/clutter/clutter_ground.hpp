// The ground on which things lie about: the work and the table under it.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "services/cell_simulator/scene/triangle_hierarchy.hpp"
#include "services/cell_simulator/wild/drawing.hpp"
#include "services/cell_simulator/wild/plate_form.hpp"
#include "services/cell_simulator/wild/work_form.hpp"

namespace arcstart::cell_simulator {

inline constexpr double apart_mm = 0.3;  // what lies about keeps so far off the seam's line

// How high things lie there, and where the seam runs.
class Ground {
 public:
  explicit Ground(const WildWork& work) : work_(work), T_base_work_(place(work)) {
    for (WorkPart& part : parts_of(work)) meshes_.push_back(std::move(part.mesh));
    std::vector<const TriangleMesh*> pointers;
    for (const TriangleMesh& mesh : meshes_) pointers.push_back(&mesh);
    triangles_ = TriangleHierarchy(pointers);
    begin_ = std::max(foot_end(work.first, Side::begin), foot_end(work.second, Side::begin));
    end_ = std::min(foot_end(work.first, Side::end), foot_end(work.second, Side::end));
  }

  double begin() const { return begin_; }
  double end() const { return end_; }
  const WildWork& work() const { return work_; }
  bool fillet() const { return work_.joint == "tee" || work_.joint == "inside_corner"; }

  // Of the work or the table under a place in base.
  double height(double x, double y) const {
    constexpr double above_mm = 300;
    const Eigen::Vector3d from(x, y, above_mm), to(x, y, 0);
    const double share = triangles_.first_hit(from, to);
    return share <= 1 ? above_mm * (1 - share) : 0;
  }
  Eigen::Vector3d base(const Eigen::Vector3d& in_work) const {
    return on_work(work_, T_base_work_, in_work);
  }
  Eigen::Matrix3d turned() const { return T_base_work_.linear(); }
  double distance_to_seam(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d a = base({begin_, 0, 0}), b = base({end_, 0, 0});
    const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + share * (b - a) - p).norm();
  }

 private:
  const WildWork& work_;
  RigidTransform T_base_work_;
  std::vector<TriangleMesh> meshes_;
  TriangleHierarchy triangles_;
  double begin_, end_;
};

// At the seam's start, its end, or anywhere along it.
inline double place_along(const Ground& ground, Draw& draw) {
  const double which = draw.within(0, 1);
  if (which < 0.35) return ground.begin() + draw.within(-10, 15);
  if (which < 0.55) return ground.end() + draw.within(-15, 10);
  return draw.within(ground.begin(), ground.end());
}

// The same, but over the first plate at that distance from the seam.
inline double place_on_first(const Ground& ground, Draw& draw, double across) {
  constexpr double rim_mm = 4;
  const WildPlate& plate = ground.work().first;
  const double away = ground.work().joint == "outside_corner" ? across : -across;
  const double t = std::min(away, plate.away_mm);
  const double low = face_edge(plate, Side::begin, t) + rim_mm,
               high = face_edge(plate, Side::end, t) - rim_mm;
  const double along = place_along(ground, draw);
  return low < high ? std::clamp(along, low, high) : (low + high) / 2;
}

}  // namespace arcstart::cell_simulator
