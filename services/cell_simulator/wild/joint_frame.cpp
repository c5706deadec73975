#include "services/cell_simulator/wild/joint_frame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "services/cell_simulator/scene/scene_object.hpp"

namespace arcstart::cell_simulator {
namespace {

using Eigen::Vector3d;

// What changes along the seam: its value at s = 0 and its slope, from the second plate's ends.
struct Linear {
  Linear(const WildWork& work, double begin, double end) {
    const double from = work.second.begin.at_mm, to = work.second.end.at_mm;
    slope = to > from ? (end - begin) / (to - from) : 0;
    zero = begin - slope * from;
  }
  double at(double s) const { return zero + slope * s; }
  double zero, slope;
};

Linear gap_of(const WildWork& work) { return {work, work.gap_begin_mm, work.gap_end_mm}; }

Linear mismatch_of(const WildWork& work) {
  return {work, work.mismatch_begin_mm, work.mismatch_end_mm};
}

void shift(PlateFrame& frame, const Vector3d& direction, const Linear& by, double share = 1) {
  frame.origin += share * by.zero * direction;
  frame.along += share * by.slope * direction;
}

SeamEdge straight(const WildPlate& plate, double t) { return {{0, t}, {plate.thickness_mm, t}}; }

// Root face below, slant above; of a butt joint the slant is 0.
SeamEdge groove_edge(const WildPlate& plate, const WildWork& work) {
  if (work.joint == "butt") return straight(plate, 0);
  const double slanted = std::max(0.0, plate.thickness_mm - work.root_face_mm);
  return {{0, slanted * std::tan(work.groove_deg / 2 * kDegree)},
          {slanted, 0},
          {plate.thickness_mm, 0}};
}

// Of an outside corner both plates' edges, first and second. Each is square to its plate's face,
// but for a mitre; the second plate leans about the seam by `lean`.
std::pair<SeamEdge, SeamEdge> corner_edges(const WildWork& work) {
  const double first = work.first.thickness_mm, second = work.second.thickness_mm;
  if (work.corner == "mitred") return {{{0, 0}, {first, first}}, {{0, 0}, {second, second}}};
  const double lean = (90 - work.angle_deg) * kDegree, sine = std::sin(lean),
               cosine = std::cos(lean);
  // Where the first plate's underside meets the second's inner face, from the line in which the
  // outer faces meet: down the second plate, and along the first.
  const double down = (first + second * sine) / cosine, along = down * sine + second * cosine;
  if (work.corner == "open") return {straight(work.first, along), straight(work.second, down)};
  // No corner of the edge below reaches through the face above it.
  if (work.corner == "over")
    return {straight(work.first, 0), straight(work.second, std::max(down, first / cosine))};
  if (work.corner == "butted")
    return {straight(work.first, std::max(along, second / cosine)), straight(work.second, 0)};
  throw SceneError("corner " + work.corner + " is none of mitred, over, butted, open");
}

}  // namespace

Vector3d PlateFrame::normal() const {
  const Vector3d across = along.cross(away).normalized();
  return across.dot(depth) > 0 ? Vector3d(-across) : across;
}

double gap_at(const WildWork& work, double s) { return gap_of(work).at(s); }
double mismatch_at(const WildWork& work, double s) { return mismatch_of(work).at(s); }

PlateFrame first_frame(const WildWork& work) {
  PlateFrame frame{Vector3d::Zero(), Vector3d::UnitX(), -Vector3d::UnitY(), -Vector3d::UnitZ(),
                   straight(work.first, -work.first.behind_mm)};
  if (work.joint == "outside_corner") {
    frame.away = Vector3d::UnitY();
    frame.edge = corner_edges(work).first;
  } else if (work.joint == "butt" || work.joint == "v") {
    frame.edge = groove_edge(work.first, work);
    shift(frame, frame.away, gap_of(work), 0.5);
  }
  return frame;
}

PlateFrame second_frame(const WildWork& work) {
  PlateFrame frame{Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), -Vector3d::UnitZ(),
                   straight(work.second, 0)};
  // A standing plate leans about the seam.
  const Eigen::AngleAxisd lean((90 - work.angle_deg) * kDegree, Vector3d::UnitX());
  if (work.joint == "tee" || work.joint == "inside_corner") {
    frame.away = lean * Vector3d::UnitZ();
    frame.depth = lean * Vector3d::UnitY();
    shift(frame, frame.away, gap_of(work));
  } else if (work.joint == "outside_corner") {
    frame.away = lean * -Vector3d::UnitZ();
    frame.depth = lean * Vector3d::UnitY();
    frame.edge = corner_edges(work).second;
    shift(frame, frame.away, gap_of(work));
  } else if (work.joint == "lap") {
    frame.origin.z() = work.second.thickness_mm;
    shift(frame, Vector3d::UnitZ(), gap_of(work));
  } else if (work.joint == "butt" || work.joint == "v") {
    frame.edge = groove_edge(work.second, work);
    shift(frame, frame.away, gap_of(work), 0.5);
    shift(frame, Vector3d::UnitZ(), mismatch_of(work));
  } else {
    throw SceneError("joint " + work.joint +
                     " is none of tee, inside_corner, outside_corner, lap, butt, v");
  }
  return frame;
}

}  // namespace arcstart::cell_simulator
