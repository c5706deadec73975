#include "tests/seam_finding/support/wild_view.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::seam_finding::synthetic {
namespace {

using namespace cell_simulator;
using Eigen::Vector2d, Eigen::Vector3d;

constexpr double step_px = 8;          // between places at which it is asked what hides a line
constexpr double clearance_mm = 0.02;  // what is nearer to a lit point than this does not hide it
constexpr double least_mirror_mm = 1.5;
constexpr double margin_px = 2;  // beyond the image

class View {
 public:
  View(const Scene& scene, const TrueSensor& sensor, const RigidTransform& T_base_tool,
       const Scene* on_tool)
      : scene_(scene),
        sensor_(sensor),
        on_tool_(on_tool),
        T_base_camera_(T_base_tool * sensor.T_tool_camera),
        T_camera_base_(T_base_camera_.inverse()) {}

  LightSheet sheet() const {
    return {T_base_camera_ * sensor_.projector, T_base_camera_.linear() * sensor_.laser_normal,
            T_base_camera_.linear() * sensor_.fan_direction, sensor_.fan_half_angle};
  }
  LightSheet sheet_in_camera() const {
    return {sensor_.projector, sensor_.laser_normal, sensor_.fan_direction, sensor_.fan_half_angle};
  }

  // The parts of a line that are in sight.
  void add(const LitLine& line, std::vector<WildPiece>& pieces) const {
    const Triangle& triangle = scene_.triangles().triangle(line.triangle);
    const double light = triangle.normal.dot(line.source - triangle.a);
    if (light * triangle.normal.dot(T_base_camera_.translation() - triangle.a) <= 0) return;
    const auto first = see(sensor_, T_camera_base_ * line.begin),
               last = see(sensor_, T_camera_base_ * line.end);
    if (!first || !last || aside(*first, *last)) return;
    const auto at = [&](double share) -> Vector3d {
      return line.begin + share * (line.end - line.begin);
    };
    const auto in_sight = [&](double share) {
      const Vector3d p = at(share);
      const auto pixel = see(sensor_, T_camera_base_ * p);
      return pixel && inside(*pixel) && free(p, line);
    };
    const double length_px = (*last - *first).norm();
    constexpr double short_px = 2;  // seen as a whole or not at all
    if (length_px < short_px) {
      if (in_sight(0.5)) add(line, 0, 1, pieces);
      return;
    }
    const int steps = 2 + static_cast<int>(length_px / step_px);
    // Not at the very ends, which touch what bounds them.
    const auto share_of = [&](int i) {
      constexpr double in = 1e-4;
      return in + (1 - 2 * in) * i / steps;
    };
    const auto edge = [&](double seen, double hidden) {
      for (int i = 0; i < 9; ++i) {
        const double middle = (seen + hidden) / 2;
        (in_sight(middle) ? seen : hidden) = middle;
      }
      return seen;
    };
    double begin = -1;
    bool before = false;
    for (int i = 0; i <= steps; ++i) {
      const bool now = in_sight(share_of(i));
      if (now && !before) begin = i == 0 ? 0 : edge(share_of(i), share_of(i - 1));
      if (!now && before) add(line, begin, edge(share_of(i - 1), share_of(i)), pieces);
      before = now;
    }
    if (before) add(line, begin, 1, pieces);
  }

  void add_on_tool(const LitLine& line, std::vector<WildPiece>& pieces) const {
    const Triangle& triangle = on_tool_->triangles().triangle(line.triangle);
    if (triangle.normal.dot(-triangle.a) <= 0) return;
    const auto first = see(sensor_, line.begin), last = see(sensor_, line.end);
    if (!first || !last || !inside(*first) || !inside(*last)) return;
    pieces.push_back({T_base_camera_ * line.begin, T_base_camera_ * line.end, *first, *last, -1,
                      T_base_camera_.linear() * triangle.normal});
  }

  const TrueSensor& sensor() const { return sensor_; }

 private:
  bool inside(const Vector2d& p) const {
    return p.x() >= 0 && p.y() >= 0 && p.x() <= sensor_.width - 1 && p.y() <= sensor_.height - 1;
  }
  // Both on the far side of one of the image's edges.
  bool aside(const Vector2d& a, const Vector2d& b) const {
    return std::max(a.x(), b.x()) < -margin_px || std::max(a.y(), b.y()) < -margin_px ||
           std::min(a.x(), b.x()) > sensor_.width + margin_px ||
           std::min(a.y(), b.y()) > sensor_.height + margin_px;
  }
  bool free(const Vector3d& p, const LitLine& line) const {
    if (scene_.triangles().blocked(T_base_camera_.translation(), p, clearance_mm, line.triangle))
      return false;
    if (!on_tool_) return true;
    const Vector3d q = T_camera_base_ * p;
    return !on_tool_->triangles().blocked(Vector3d::Zero(), q, clearance_mm, -1) &&
           (line.ghost || !on_tool_->triangles().blocked(sensor_.projector, q, clearance_mm, -1));
  }
  void add(const LitLine& line, double begin, double end, std::vector<WildPiece>& pieces) const {
    const Vector3d from = line.begin + begin * (line.end - line.begin),
                   to = line.begin + end * (line.end - line.begin);
    const auto first = see(sensor_, T_camera_base_ * from),
               last = see(sensor_, T_camera_base_ * to);
    if (!first || !last) return;
    const int object = scene_.triangles().object_of(line.triangle);
    const auto& band = scene_.objects()[object].band;
    pieces.push_back({from, to, *first, *last, object,
                      scene_.triangles().triangle(line.triangle).normal, line.ghost,
                      band && band->contains((from + to) / 2)});
  }

  const Scene& scene_;
  const TrueSensor& sensor_;
  const Scene* on_tool_;
  RigidTransform T_base_camera_, T_camera_base_;
};

}  // namespace

std::vector<WildPiece> seen_pieces(const Scene& scene, const TrueSensor& sensor,
                                   const RigidTransform& T_base_tool, const Scene* on_tool,
                                   double ghost_share) {
  const View view(scene, sensor, T_base_tool, on_tool);
  std::vector<WildPiece> pieces;
  std::vector<LitLine> lines = cast(scene, view.sheet());
  for (const LitLine& line : lines) view.add(line, pieces);
  if (on_tool)
    for (const LitLine& line : cast(*on_tool, view.sheet_in_camera()))
      view.add_on_tool(line, pieces);
  if (ghost_share < 1) {
    // Flat faces throw ghosts that can be taken for stripes; what round things throw is scattered.
    std::erase_if(lines, [](const LitLine& line) {
      return (line.end - line.begin).norm() < least_mirror_mm;
    });
    for (const LitLine& line : cast_mirrored(scene, lines, ghost_share)) view.add(line, pieces);
  }
  return pieces;
}

}  // namespace arcstart::seam_finding::synthetic
