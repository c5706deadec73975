#include "services/cell_simulator/image/laser_fan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "services/cell_simulator/base/interval.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr double nearest_mm = 1;      // before the source nothing is lit
constexpr double shortest_mm = 1e-6;  // shorter lines are rounding

// The sheet's plane with the source at the origin, x along its direction. Seen from the source a
// point lies at the tangent t = y / x, at the closeness w = 1 / x; in (t, w) a straight segment is
// straight again.
struct SheetFrame {
  explicit SheetFrame(const LightSheet& sheet)
      : source(sheet.source), x(sheet.direction), y(sheet.normal.cross(sheet.direction)) {}
  Eigen::Vector2d flat(const Eigen::Vector3d& p) const {
    return {x.dot(p - source), y.dot(p - source)};
  }
  Eigen::Vector3d at(double t, double w) const { return source + (x + t * y) / w; }
  Eigen::Vector3d source, x, y;
};

// A segment seen from the source, from tangent t0 to t1 > t0.
struct Sight {
  double t0, t1, w0, slope;
  int triangle;
  double w(double t) const { return w0 + slope * (t - t0); }
};

// A part of a sight that nothing stands before.
struct Seen {
  double begin, end;  // tangents
  const Sight* sight;
};

std::vector<Sight> sights(const std::vector<PlaneCut>& cuts, const SheetFrame& frame, double t_low,
                          double t_high) {
  std::vector<Sight> result;
  for (const PlaneCut& cut : cuts) {
    const Eigen::Vector2d a = frame.flat(cut.begin), b = frame.flat(cut.end);
    Interval part;
    part.keep(a.x() - nearest_mm, b.x() - nearest_mm);
    part.keep(a.y() - t_low * a.x(), b.y() - t_low * b.x());
    part.keep(t_high * a.x() - a.y(), t_high * b.x() - b.y());
    if (part.empty()) continue;
    const Eigen::Vector2d p = a + part.begin * (b - a), q = a + part.end * (b - a);
    double t0 = p.y() / p.x(), t1 = q.y() / q.x(), w0 = 1 / p.x(), w1 = 1 / q.x();
    if (t1 < t0) std::swap(t0, t1), std::swap(w0, w1);
    if (t1 - t0 < 1e-12) continue;  // edge-on
    result.push_back({t0, t1, w0, (w1 - w0) / (t1 - t0), cut.triangle});
  }
  return result;
}

// The upper envelope of the closenesses: in every direction the nearest sight. Segments may cross.
std::vector<Seen> nearest(std::vector<Sight>& all) {
  std::sort(all.begin(), all.end(), [](const Sight& a, const Sight& b) { return a.t0 < b.t0; });
  std::vector<double> stops;
  for (const Sight& sight : all) stops.insert(stops.end(), {sight.t0, sight.t1});
  std::sort(stops.begin(), stops.end());

  std::vector<Seen> result;
  std::vector<const Sight*> active;
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double end = stops[i + 1];
    double t = stops[i];
    if (end - t < 1e-13) continue;
    while (next < all.size() && all[next].t0 <= t) active.push_back(&all[next++]);
    std::erase_if(active, [t](const Sight* sight) { return sight->t1 <= t; });
    while (!active.empty() && t < end) {
      const double just_after = t + 1e-6 * (end - t);  // where sights that touch at t have parted
      const Sight* first = *std::max_element(
          active.begin(), active.end(),
          [&](const Sight* a, const Sight* b) { return a->w(just_after) < b->w(just_after); });
      double until = end;
      for (const Sight* other : active) {
        if (other->slope <= first->slope) continue;
        const double meets = t + (first->w(t) - other->w(t)) / (other->slope - first->slope);
        if (meets > just_after && meets < until) until = meets;
      }
      if (!result.empty() && result.back().sight == first && result.back().end == t)
        result.back().end = until;
      else
        result.push_back({t, until, first});
      t = until;
    }
  }
  return result;
}

// The line in parts that are each within a band of its object or outside of it.
void append_parted(const Scene& scene, const LitLine& line, std::vector<LitLine>& lines) {
  const auto& band = scene.objects()[scene.triangles().object_of(line.triangle)].band;
  std::vector<double> shares{0};  // of the way along it
  if (band) {
    const double from = band->off_middle(line.begin), to = band->off_middle(line.end);
    for (const double border : {-band->half_width, band->half_width})
      if ((from < border) != (to < border)) shares.push_back((border - from) / (to - from));
    std::sort(shares.begin(), shares.end());
  }
  shares.push_back(1);
  const Eigen::Vector3d way = line.end - line.begin;
  for (std::size_t i = 1; i < shares.size(); ++i) {
    LitLine part = line;
    if (i > 1) part.begin = line.begin + shares[i - 1] * way;
    if (i + 1 < shares.size()) part.end = line.begin + shares[i] * way;
    lines.push_back(part);
  }
}

}  // namespace

std::vector<LitLine> cast(const Scene& scene, const LightSheet& sheet) {
  const SheetFrame frame(sheet);
  std::vector<PlaneCut> cuts;
  scene.triangles().cut(sheet.normal, -sheet.normal.dot(sheet.source), cuts);
  const double t_high = std::tan(sheet.half_angle);
  std::vector<Sight> all = sights(cuts, frame, -t_high, t_high);
  std::vector<LitLine> lines;
  for (const Seen& seen : nearest(all)) {
    const Eigen::Vector3d begin = frame.at(seen.begin, seen.sight->w(seen.begin));
    const Eigen::Vector3d end = frame.at(seen.end, seen.sight->w(seen.end));
    if ((end - begin).norm() < shortest_mm) continue;
    append_parted(scene,
                  {begin, end, sheet.normal, sheet.source, seen.sight->triangle, 1, 0, 0, false},
                  lines);
  }
  return lines;
}

std::vector<LitLine> cast_mirrored(const Scene& scene, const std::vector<LitLine>& direct,
                                   double least_share) {
  std::vector<LitLine> lines;
  std::vector<PlaneCut> cuts;
  for (const LitLine& lit : direct) {
    const Surface& surface = scene.surface_at(lit.triangle, (lit.begin + lit.end) / 2);
    const double share = lit.share * surface.specular_share;
    if (share <= 0 || share < least_share) continue;
    const Triangle& mirror = scene.triangles().triangle(lit.triangle);
    const auto mirrored = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
      return v - 2 * mirror.normal.dot(v) * mirror.normal;
    };
    LightSheet sheet;
    sheet.source = lit.begin + mirrored(lit.source - lit.begin);
    sheet.normal = mirrored(lit.sheet_normal);
    const Eigen::Vector3d middle = (lit.begin + lit.end) / 2;
    sheet.direction = (middle - sheet.source).normalized();
    const SheetFrame frame(sheet);
    const Eigen::Vector2d a = frame.flat(lit.begin), b = frame.flat(lit.end);
    double t0 = a.y() / a.x(), t1 = b.y() / b.x(), w0 = 1 / a.x(), w1 = 1 / b.x();
    if (t1 < t0) std::swap(t0, t1), std::swap(w0, w1);
    if (t1 - t0 < 1e-12) continue;
    const Sight window{t0, t1, w0, (w1 - w0) / (t1 - t0), lit.triangle};

    cuts.clear();
    scene.triangles().cut(sheet.normal, -sheet.normal.dot(sheet.source), cuts);
    std::vector<Sight> beyond;
    for (const Sight& sight : sights(cuts, frame, t0, t1)) {
      // Light comes from the mirror: only what lies beyond it counts.
      constexpr double less = 1 - 1e-6;
      Interval part;
      part.keep(less * window.w(sight.t0) - sight.w(sight.t0),
                less * window.w(sight.t1) - sight.w(sight.t1));
      if (part.empty()) continue;
      const double from = sight.t0 + part.begin * (sight.t1 - sight.t0);
      const double to = sight.t0 + part.end * (sight.t1 - sight.t0);
      if (to - from < 1e-12) continue;
      beyond.push_back({from, to, sight.w(from), sight.slope, sight.triangle});
    }
    for (const Seen& seen : nearest(beyond)) {
      const auto point = [&](double t) { return frame.at(t, seen.sight->w(t)); };
      const auto spread = [&](double t) {
        return surface.gloss_spread_rad * (point(t) - frame.at(t, window.w(t))).norm();
      };
      LitLine line{point(seen.begin),  point(seen.end),      sheet.normal,
                   sheet.source,       seen.sight->triangle, share,
                   spread(seen.begin), spread(seen.end),     true};
      if ((line.end - line.begin).norm() >= shortest_mm) lines.push_back(line);
    }
  }
  return lines;
}

}  // namespace arcstart::cell_simulator
