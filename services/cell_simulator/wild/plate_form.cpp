#include "services/cell_simulator/wild/plate_form.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/wild/polygon.hpp"
#include "services/cell_simulator/wild/solid_shapes.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr double pi = std::numbers::pi;

double tangent(double degrees) { return std::tan(degrees * pi / 180); }

const WildCut& cut_of(const WildPlate& plate, Side side) {
  return side == Side::begin ? plate.begin : plate.end;
}

double outward(Side side) { return side == Side::begin ? -1 : 1; }

double wave_at(const WildCut& cut, double t) {
  if (cut.wave_mm == 0) return 0;
  return cut.wave_mm * std::sin(2 * pi * t / cut.wave_pitch_mm + cut.wave_phase_deg * pi / 180);
}

// How far a chamfer or a radius takes the end back at a depth.
double taken_back(const WildCut& cut, double d) {
  if (cut.round_mm > 0)
    return d >= cut.round_mm ? 0
                             : cut.round_mm - std::sqrt(cut.round_mm * cut.round_mm -
                                                        (cut.round_mm - d) * (cut.round_mm - d));
  return std::max(0.0, cut.chamfer_mm - d);
}

double end_at(const WildCut& cut, Side side, double t, double d, double wave) {
  const double out = outward(side);
  return cut.at_mm +
         out * (t * tangent(cut.turn_deg) + d * tangent(cut.slant_deg) + wave - taken_back(cut, d));
}

// A corner of the outline: on an end (then s follows from t), on the edge along the seam (then t
// follows from the depth), or where it stands.
struct Corner {
  double s = 0, t = 0, wave = 0;
  enum class On { neither, begin, end } on = On::neither;
  bool at_seam = false;
};

double edge_at(const SeamEdge& edge, double d) {
  for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
    const auto& [d0, t0] = edge[i];
    const auto& [d1, t1] = edge[i + 1];
    if (d <= d1) return t0 + (t1 - t0) * (d - d0) / std::max(d1 - d0, 1e-9);
  }
  return edge.back().second;
}

// An end from the seam outward: a cope's arc, then the cut with its waves.
void add_end(const WildPlate& plate, Side side, double low, std::vector<Corner>& corners) {
  const WildCut& cut = cut_of(plate, side);
  const auto on = side == Side::begin ? Corner::On::begin : Corner::On::end;
  const double high = plate.away_mm, cope = cut.cope_mm;
  if (cope > 0) {
    const auto quarter = arc({0, 0}, cope, 0, pi / 2);
    for (std::size_t i = 0; i + 1 < quarter.size(); ++i) {
      const double c = quarter[i].x(), t = quarter[i].y();
      corners.push_back({cut.at_mm + outward(side) * (t * tangent(cut.turn_deg) - c), t, 0,
                         Corner::On::neither, i == 0});
    }
    corners.push_back({0, cope, 0, on, false});
    low = cope;
  } else {
    corners.push_back({0, low, wave_at(cut, low), on, true});
  }
  if (cut.wave_mm > 0) {
    constexpr int steps = 8;  // a wave
    const double step = cut.wave_pitch_mm / steps;
    for (double t = (std::floor(low / step + 0.5) + 1) * step; t < high - step / 2; t += step)
      corners.push_back({0, t, wave_at(cut, t), on, false});
  }
  corners.push_back({0, high, wave_at(cut, high), on, false});
}

std::vector<Corner> outline_of(const WildPlate& plate, double low) {
  std::vector<Corner> begin, corners;
  add_end(plate, Side::begin, low, begin);
  add_end(plate, Side::end, low, corners);
  std::vector<WildNotch> notches = plate.notches;
  std::sort(notches.begin(), notches.end(),
            [](const WildNotch& a, const WildNotch& b) { return a.along_mm > b.along_mm; });
  for (const WildNotch& notch : notches)
    for (const auto& [s, t] : {std::pair(0.5, 0.0), {0.5, 1.0}, {-0.5, 1.0}, {-0.5, 0.0}})
      corners.push_back({notch.along_mm + s * notch.width_mm, plate.away_mm - t * notch.depth_mm, 0,
                         Corner::On::neither, false});
  corners.insert(corners.end(), begin.rbegin(), begin.rend());
  return corners;
}

Eigen::Vector3d place_of(const Corner& corner, const WildPlate& plate, const SeamEdge& edge,
                         double d) {
  const double t = corner.at_seam ? edge_at(edge, d) : corner.t;
  if (corner.on == Corner::On::neither) return {corner.s, t, d};
  const Side side = corner.on == Corner::On::begin ? Side::begin : Side::end;
  return {end_at(cut_of(plate, side), side, t, d, corner.wave), t, d};
}

// Depths at which the plate's outline is given: between them its walls are straight.
std::vector<double> depths_of(const WildPlate& plate, const SeamEdge& edge) {
  std::vector<double> depths{0, plate.thickness_mm};
  for (const auto& [d, t] : edge) depths.push_back(d);
  for (const WildCut* cut : {&plate.begin, &plate.end}) {
    if (cut->round_mm > 0)
      for (const auto& p : arc({0, 0}, cut->round_mm, 0, pi / 2))
        depths.push_back(cut->round_mm - p.y());
    else
      depths.push_back(cut->chamfer_mm);
  }
  std::sort(depths.begin(), depths.end());
  std::vector<double> result;
  for (const double d : depths)
    if (d >= 0 && d <= plate.thickness_mm && (result.empty() || d > result.back() + 1e-6))
      result.push_back(d);
  return result;
}

TriangleMesh make_flat(const WildPlate& plate, const SeamEdge& edge) {
  std::vector<std::vector<Corner>> rings{outline_of(plate, edge.front().second)};
  for (const WildHole& hole : plate.holes) {
    rings.emplace_back();
    for (const auto& p : circle({hole.along_mm, hole.away_mm}, hole.radius_mm))
      rings.back().push_back({p.x(), p.y(), 0, Corner::On::neither, false});
    std::reverse(rings.back().begin(), rings.back().end());
  }
  Rings section;
  for (const auto& ring : rings) {
    section.emplace_back();
    for (const Corner& corner : ring)
      section.back().push_back(place_of(corner, plate, edge, 0).head<2>());
  }
  if (twice_area(section[0]) <= 0)
    throw SceneError(
        fmt::format("a plate's cuts from {:.1f} to {:.1f} mm leave nothing of it; away {:.1f} mm, "
                    "turned {:.1f} and {:.1f} deg",
                    plate.begin.at_mm, plate.end.at_mm, plate.away_mm, plate.begin.turn_deg,
                    plate.end.turn_deg));
  std::vector<std::vector<Eigen::Vector3d>> layers;
  for (const double d : depths_of(plate, edge)) {
    layers.emplace_back();
    for (const auto& ring : rings)
      for (const Corner& corner : ring) layers.back().push_back(place_of(corner, plate, edge, d));
  }
  return loft(section, layers);
}

using Ring = std::vector<Eigen::Vector2d>;  // (t, d)

Ring rounded_rectangle(double t0, double t1, double d0, double d1, double radius) {
  Ring ring;
  const auto corner = [&](double t, double d, double from) {
    for (const auto& p : arc({t, d}, radius, from, from + pi / 2)) ring.push_back(p);
  };
  corner(t1 - radius, d1 - radius, 0);
  corner(t0 + radius, d1 - radius, pi / 2);
  corner(t0 + radius, d0 + radius, pi);
  corner(t1 - radius, d0 + radius, 3 * pi / 2);
  return ring;
}

Rings hollow_section(const WildPlate& plate, double low) {
  const double wall = plate.thickness_mm, radius = std::max(plate.corner_radius_mm, 0.5);
  Ring inner = rounded_rectangle(low + wall, plate.away_mm - wall, wall, plate.depth_mm - wall,
                                 std::max(radius - wall, 0.3));
  std::reverse(inner.begin(), inner.end());
  return {rounded_rectangle(low, plate.away_mm, 0, plate.depth_mm, radius), inner};
}

// A cold-formed angle, its heel at the seam.
Rings angle_section(const WildPlate& plate) {
  const double wall = plate.thickness_mm, radius = std::max(plate.corner_radius_mm, 0.05),
               inside = std::max(radius - wall, 0.05);
  Ring ring{{plate.away_mm, 0}, {plate.away_mm, wall}};
  for (const auto& p : arc({wall + inside, wall + inside}, inside, 3 * pi / 2, pi))
    ring.push_back(p);
  ring.push_back({wall, plate.depth_mm});
  ring.push_back({0, plate.depth_mm});
  for (const auto& p : arc({radius, radius}, radius, pi, 3 * pi / 2)) ring.push_back(p);
  return {ring};
}

}  // namespace

TriangleMesh make_plate_form(const WildPlate& plate, const SeamEdge& edge) {
  if (plate.section == "plate") return make_flat(plate, edge);
  if (plate.section != "angle" && plate.section != "hollow")
    throw SceneError("section " + plate.section + " is none of plate, angle, hollow");
  const Rings rings =
      plate.section == "hollow" ? hollow_section(plate, edge.front().second) : angle_section(plate);
  std::vector<std::vector<Eigen::Vector3d>> layers(2);
  for (const auto& ring : rings)
    for (const auto& p : ring) {
      layers[0].emplace_back(end_at(plate.begin, Side::begin, p.x(), p.y(), 0), p.x(), p.y());
      layers[1].emplace_back(end_at(plate.end, Side::end, p.x(), p.y(), 0), p.x(), p.y());
    }
  return loft(rings, layers);
}

double foot_end(const WildPlate& plate, Side side) {
  const WildCut& cut = cut_of(plate, side);
  if (plate.section != "plate") return end_at(cut, side, 0, 0, 0);  // sawn, without all this
  if (cut.cope_mm > 0) return cut.at_mm - outward(side) * cut.cope_mm;
  return end_at(cut, side, 0, 0, wave_at(cut, 0));
}

double face_edge(const WildPlate& plate, Side side, double t) {
  const WildCut& cut = cut_of(plate, side);
  const double cope =
      cut.cope_mm > 0 && plate.section == "plate" ? cut.cope_mm - taken_back(cut, 0) : 0;
  return end_at(cut, side, t, 0, 0) - outward(side) * cope;
}

}  // namespace arcstart::cell_simulator
