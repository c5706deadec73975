#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "services/cell_simulator/scene/triangle_hierarchy.hpp"
#include "services/cell_simulator/wild/clutter/clutter_ground.hpp"
#include "services/cell_simulator/wild/clutter/draw_cable.hpp"
#include "services/cell_simulator/wild/drawing.hpp"
#include "services/cell_simulator/wild/plate_form.hpp"
#include "services/cell_simulator/wild/solid_shapes.hpp"
#include "services/cell_simulator/wild/work_form.hpp"

namespace arcstart::cell_simulator {
namespace {

using Eigen::AngleAxisd, Eigen::Vector3d;

// Does an edge of one go through a face of the other?
bool cut(const WildSolid& one, const WildSolid& other) {
  const TriangleMesh a = mesh_of(one), b = mesh_of(other);
  const auto goes_through = [](const TriangleMesh& mesh, const TriangleMesh& faces) {
    const TriangleHierarchy triangles({&faces});
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
      for (int i = 0; i < 3; ++i)
        if (triangles.first_hit(mesh.corners[t[i]], mesh.corners[t[(i + 1) % 3]]) <= 1) return true;
      return false;
    });
  };
  return goes_through(a, b) || goes_through(b, a);
}

void set_pose(WildSolid& solid, const Vector3d& at, const Eigen::Matrix3d& turned) {
  const Eigen::Quaterniond q(turned);
  solid.position_mm = {at.x(), at.y(), at.z()};
  solid.quaternion = {q.w(), q.x(), q.y(), q.z()};
}

Eigen::Matrix3d about_z(double degrees) {
  return AngleAxisd(degrees * kDegree, Vector3d::UnitZ()).toRotationMatrix();
}

WildSolid draw_bar(Draw& draw) {
  WildSolid bar;
  bar.kind = draw.chance(0.6) ? "round" : "hexagon";
  bar.size_mm = {draw.within(40, 150), draw.within(3, 12), 0};
  bar.surface = draw_surface(draw);
  return bar;
}

// On the open side, its end toward the seam; of joints without a standing plate over the seam.
void add_bar_across(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  WildSolid bar = draw_bar(draw);
  const double half = bar.size_mm[0] / 2, radius = bar.size_mm[1];
  const double along = place_along(ground, draw);
  const WildWork& work = ground.work();
  if (ground.fillet()) {
    const bool over = draw.chance(0.3);  // across the upright's top, over the seam
    const double turn = draw.within(-40, 40);
    const double lean = (90 - work.angle_deg) * kDegree, height = work.second.away_mm;
    // The end's corners come nearest; a plate that leans over the open side is kept off as well.
    const double clear = half * std::cos(turn * kDegree) + radius + apart_mm +
                         std::max(0.0, 2 * radius * std::tan(lean));
    const Vector3d at =
        over ? Vector3d(
                   along, draw.within(-0.6, 0.2) * half - height * std::sin(lean),
                   height * std::cos(lean) + std::max(work.gap_begin_mm, work.gap_end_mm) + radius)
             : Vector3d(along, -clear - draw.within(0, 12), radius);
    set_pose(bar, ground.base(at), ground.turned() * about_z(90 + turn));
  } else {
    double level = std::max({0.0, work.mismatch_begin_mm, work.mismatch_end_mm});
    if (work.joint == "lap")
      level = work.second.thickness_mm + std::max(work.gap_begin_mm, work.gap_end_mm);
    set_pose(bar, ground.base({along, draw.within(-0.4, 0.4) * half, level + radius + apart_mm}),
             ground.turned() * about_z(90 + draw.within(-50, 50)));
  }
  solids.push_back(bar);
}

// In the corner, along the seam, touching both plates.
void add_bar_in_corner(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  if (!ground.fillet()) return add_bar_across(ground, draw, solids);
  WildSolid bar = draw_bar(draw);
  bar.kind = "round";
  bar.size_mm[0] = draw.within(20, 70);
  const double angle = ground.work().angle_deg * kDegree, radius = bar.size_mm[1] + 0.05;
  const Vector3d away(0, -std::cos(angle / 2), std::sin(angle / 2));
  double along = place_along(ground, draw);
  if (draw.chance(0.4)) along = ground.begin() + draw.within(-0.5, 0.5) * bar.size_mm[0];
  set_pose(bar, ground.base(Vector3d(along, 0, 0) + radius / std::sin(angle / 2) * away),
           ground.turned());
  solids.push_back(bar);
}

void add_block_on_base(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  WildSolid block;
  block.size_mm = {draw.within(10, 30), draw.within(10, 30), draw.within(6, 40)};
  block.surface = draw_surface(draw);
  const double aside = 0.5 * std::hypot(block.size_mm[0], block.size_mm[1]) + apart_mm;
  Vector3d at(0, -aside - draw.within(1, 30), block.size_mm[2] / 2);
  if (ground.fillet() && ground.work().angle_deg < 90)  // the upright leans over it
    at.y() -= block.size_mm[2] * std::tan((90 - ground.work().angle_deg) * kDegree);
  if (ground.work().joint == "outside_corner") at.y() = -at.y();
  at.x() = place_on_first(ground, draw, at.y());
  set_pose(block, ground.base(at), ground.turned() * about_z(draw.within(0, 90)));
  solids.push_back(block);
}

// A jaw, a screw and an arm, to within 10 mm of the seam.
void add_clamp(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  const double side = ground.work().joint == "outside_corner" ? 1 : -1;
  double near = draw.within(2, 15);
  if (ground.fillet() && ground.work().angle_deg < 90)
    near += 80 * std::tan((90 - ground.work().angle_deg) * kDegree);
  const double along = place_on_first(ground, draw, side * (near + 13));
  WildSolid jaw, screw, arm;
  jaw.surface = screw.surface = arm.surface = draw_surface(draw);
  jaw.size_mm = {16, 26, 14};
  set_pose(jaw, ground.base({along, side * (near + 13), 7}), ground.turned());
  screw.kind = "round";
  screw.size_mm = {60, 6, 0};
  set_pose(screw, ground.base({along, side * (near + 13), 44}),
           ground.turned() * AngleAxisd(90 * kDegree, Vector3d::UnitY()).toRotationMatrix());
  arm.size_mm = {18, 70, 14};
  set_pose(arm, ground.base({along, side * (near + 35), 78}), ground.turned());
  for (const WildSolid& part : {jaw, screw, arm}) solids.push_back(part);
}

// A nut or a bolt's head, standing on its face.
void add_nut(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  WildSolid nut;
  nut.kind = "hexagon";
  nut.size_mm = {draw.within(5, 14), draw.within(6, 14), 0};
  nut.surface = draw_surface(draw);
  double across = nut.size_mm[1] + draw.within(1, 25);
  if (ground.fillet() && ground.work().angle_deg < 90)
    across += nut.size_mm[0] * std::tan((90 - ground.work().angle_deg) * kDegree);
  if (ground.work().joint != "outside_corner") across = -across;
  set_pose(nut, ground.base({place_on_first(ground, draw, across), across, nut.size_mm[0] / 2}),
           ground.turned() * about_z(draw.within(0, 60)) *
               AngleAxisd(90 * kDegree, Vector3d::UnitY()).toRotationMatrix());
  solids.push_back(nut);
}

// On the table before the start, behind the end or behind the work.
void add_on_table(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  WildSolid solid;
  const double which = draw.within(0, 1);
  double half_length = 0, lift = 0;
  if (which < 0.5) {
    solid.size_mm = {draw.within(10, 40), draw.within(15, 80), draw.within(8, 45)};
    half_length = 0.5 * std::hypot(solid.size_mm[0], solid.size_mm[1]);
    lift = solid.size_mm[2] / 2;
  } else if (which < 0.7) {
    solid = draw_bar(draw);
    half_length = solid.size_mm[0] / 2;
    lift = solid.size_mm[1];
  } else {
    solid.kind = draw.chance(0.5) ? "hammer" : "pliers";
    half_length = solid.kind == "hammer" ? 190 : 135;
  }
  solid.surface = draw_surface(draw);
  const WildWork& work = ground.work();
  const double before = std::min(work.first.begin.at_mm, work.second.begin.at_mm),
               after = std::max(work.first.end.at_mm, work.second.end.at_mm);
  Vector3d at(0, draw.within(-40, 40), 0);
  const double where = draw.within(0, 1), gap = draw.within(3, 30);
  double turn = draw.within(-180, 180);
  if (where < 0.5)
    at.x() = before - gap - half_length;
  else if (where < 0.7)
    at.x() = after + gap + half_length;
  else
    at = Vector3d(draw.within(before, after),
                  std::max({work.first.behind_mm, work.second.away_mm, 40.0}) + gap + half_length,
                  0);
  Vector3d in_base = ground.base(at);
  in_base.z() = lift;
  set_pose(solid, in_base, about_z(turn));
  solid.with_background = draw.chance(0.3);
  solids.push_back(solid);
}

void add_spatter(const Ground& ground, Draw& draw, std::vector<WildSolid>& solids) {
  const int count = draw.count(3, 15);
  for (int i = 0; i < count; ++i) {
    WildSolid ball;
    ball.kind = "ball";
    const double radius = draw.within(0.5, 2);
    ball.size_mm = {radius, 0, 0};
    ball.surface = {0.3, 0.1, 0.2, 0.02, 0.15, 0};
    const Vector3d at =
        ground.base({draw.within(ground.begin() - 10, ground.end() + 10), draw.within(-35, 35), 0});
    const Vector3d p(at.x(), at.y(), ground.height(at.x(), at.y()) + 0.3 * radius);
    if (ground.distance_to_seam(p) < radius + apart_mm) continue;
    set_pose(ball, p, Eigen::Matrix3d::Identity());
    solids.push_back(ball);
  }
}

}  // namespace

std::vector<WildSolid> draw_clutter(const WildScene& scene, Draw& draw) {
  std::vector<WildSolid> solids;
  const WildWork none;
  const Ground ground(scene.works.empty() ? none : scene.works[0]);
  const int count = draw.count(1, 4);
  for (int i = 0; i < count; ++i) {
    const double which = draw.within(0, 1);
    const std::size_t before = solids.size();
    if (scene.works.empty() || which < 0.3) {
      add_on_table(ground, draw, solids);
    } else if (which < 0.45) {
      add_bar_across(ground, draw, solids);
    } else if (which < 0.55) {
      add_bar_in_corner(ground, draw, solids);
    } else if (which < 0.67) {
      add_block_on_base(ground, draw, solids);
    } else if (which < 0.75) {
      add_clamp(ground, draw, solids);
    } else if (which < 0.85) {
      add_nut(ground, draw, solids);
    } else if (which < 0.93) {
      add_cable(ground, draw, solids);
    } else {
      add_spatter(ground, draw, solids);
    }
    // Two things are not in one place.
    const auto added = solids.begin() + static_cast<std::ptrdiff_t>(before);
    if (std::any_of(added, solids.end(), [&](const WildSolid& one) {
          return std::any_of(solids.begin(), added,
                             [&](const WildSolid& other) { return cut(one, other); });
        }))
      solids.resize(before);
    // Gone when the work came.
    if (draw.chance(0.06))
      for (std::size_t k = before; k < solids.size(); ++k)
        solids[k].with_work = false, solids[k].with_background = true;
  }
  return solids;
}

}  // namespace arcstart::cell_simulator
