#include "services/cell_simulator/wild/work_form.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "services/cell_simulator/wild/joint_frame.hpp"
#include "services/cell_simulator/wild/plate_form.hpp"
#include "services/cell_simulator/wild/solid_shapes.hpp"

namespace arcstart::cell_simulator {
namespace {

using Eigen::Vector3d;

constexpr double slice_mm =
    7;  // of a bent part: at a bow of 1 mm in 100 its chords are 0.005 mm off

// Of the arc that the seam's line is bent to; mm, its ends up where above 0; infinite: straight.
double radius_of(const WildWork& work) {
  constexpr double chord_mm = 100;
  return work.bow_mm == 0 ? std::numeric_limits<double>::infinity()
                          : chord_mm * chord_mm / (8 * work.bow_mm);
}

Vector3d bent(const WildWork& work, const Vector3d& p) {
  if (work.bow_mm == 0) return p;
  const double radius = radius_of(work), angle = p.x() / radius;
  return {(radius - p.z()) * std::sin(angle), p.y(), radius - (radius - p.z()) * std::cos(angle)};
}

TriangleMesh bent(const WildWork& work, const TriangleMesh& mesh) {
  if (work.bow_mm == 0) return mesh;
  constexpr double finest_chord_mm = 0.009;
  TriangleMesh result = sliced(mesh, std::sqrt(8 * finest_chord_mm * std::abs(radius_of(work))));
  for (Vector3d& corner : result.corners) corner = bent(work, corner);
  return result;
}

TriangleMesh plate_mesh(const WildPlate& plate, const PlateFrame& frame) {
  TriangleMesh mesh = make_plate_form(plate, frame.edge);
  for (Vector3d& corner : mesh.corners) corner = frame.at(corner);
  // A frame may be a mirror.
  if (frame.along.cross(frame.away).dot(frame.depth) < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

// About the origin of the joint's line; along x.
TriangleMesh bead_mesh(const WildBead& bead, const WildWork& work) {
  TriangleMesh mesh = make_capsule(bead.length_mm, bead.leg_mm);
  Vector3d at(bead.along_mm, 0, 0);
  double flat = 1;  // how much lower than round
  if (work.joint == "butt") flat = 0.3;
  if (work.joint == "v" && !bead.other_side)
    at.z() = -0.8 * std::max(0.0, work.first.thickness_mm - work.root_face_mm), flat = 0.5;
  if (bead.other_side) {
    const double through =
        work.second.section == "plate" ? work.second.thickness_mm : work.second.depth_mm;
    if (work.joint == "tee" || work.joint == "inside_corner") at.y() = through;
    if (work.joint == "lap") at.y() = work.second.away_mm;
    if (work.joint == "butt" || work.joint == "v") at.z() = -work.first.thickness_mm;
    if (work.joint == "outside_corner")
      at.y() = work.second.thickness_mm, at.z() = -work.first.thickness_mm;
  } else if (work.joint == "outside_corner") {
    at += Vector3d(0, 0.4, -0.4) * bead.leg_mm;
    if (work.corner == "open")  // in the notch
      at = {bead.along_mm, work.second.thickness_mm, -work.first.thickness_mm};
  }
  // Weld metal goes no further into the joint than this, or it would come out of thin sheet.
  Vector3d low = Vector3d::Constant(-1e9), high = -low;
  const bool standing = work.joint == "tee" || work.joint == "inside_corner";
  if (bead.other_side) {
    if (standing || work.joint == "lap" || work.joint == "outside_corner") low.y() = at.y();
    if (work.joint == "butt" || work.joint == "v" || work.joint == "outside_corner")
      high.z() = at.z();
  } else if (standing) {
    high.y() = 0.5 * work.second.thickness_mm;
    low.z() = -0.5 * work.first.thickness_mm;
  }
  for (Vector3d& corner : mesh.corners)
    corner =
        (at + Vector3d(corner.x(), corner.y(), flat * corner.z())).cwiseMax(low).cwiseMin(high);
  return mesh;
}

TriangleMesh rib_mesh(const WildRib& rib) {
  return make_box({rib.begin_mm, rib.across_mm, 0},
                  {rib.end_mm, rib.across_mm + rib.thickness_mm, rib.height_mm});
}

TriangleMesh tab_mesh(const WildTab& tab, const WildWork& work) {
  // Against the shorter of the plates' ends at the seam.
  const double at = tab.at_begin ? work.first.begin.at_mm : work.first.end.at_mm;
  const double other = tab.at_begin ? at - tab.length_mm : at + tab.length_mm;
  const double lift = 1e-3;  // two faces in one place would be neither's
  return make_box({std::min(at, other), -tab.half_width_mm, -tab.lower_mm - tab.thickness_mm},
                  {std::max(at, other), tab.half_width_mm, -tab.lower_mm - lift});
}

// About the seam's line. It stays straight where the work is bent: nobody grinds to a millimetre.
std::optional<WorkBand> band_of(const WildPlate& plate, const PlateFrame& frame) {
  if (plate.ground_mm <= 0) return {};
  return WorkBand{frame.origin, frame.away, plate.ground_mm, plate.ground};
}

// In the work's frame, bent.
std::vector<WorkPart> unplaced_parts(const WildWork& work) {
  std::vector<WorkPart> parts;
  const auto add = [&](const std::string& name, const TriangleMesh& mesh,
                       const WildSurface& surface) {
    parts.push_back({name, bent(work, mesh), surface});
  };
  add("first plate", plate_mesh(work.first, first_frame(work)), work.first.surface);
  parts.back().band = band_of(work.first, first_frame(work));
  if (!work.second_missing) {
    add("second plate", plate_mesh(work.second, second_frame(work)), work.second.surface);
    parts.back().band = band_of(work.second, second_frame(work));
  }
  for (const WildRib& rib : work.ribs) add("rib", rib_mesh(rib), work.second.surface);
  for (const WildTab& tab : work.tabs) add("tab", tab_mesh(tab, work), work.first.surface);
  WildSurface metal = work.first.surface;  // of a weld: brighter than what it joins
  metal.albedo = 0.6;
  metal.specular_share = 0.3;
  for (const WildBead& bead : work.beads) add("bead", bead_mesh(bead, work), metal);
  return parts;
}

// How the bent work's frame is turned where the seam's line is at s.
Eigen::Matrix3d turn_at(const WildWork& work, double s) {
  return Eigen::AngleAxisd(-s / radius_of(work), Vector3d::UnitY()).toRotationMatrix();
}

struct Face {
  PlateFrame frame;
  double begin, end;  // of the plate at the seam's line
};

WildEnd end_of(const WildWork& work, const RigidTransform& T_base_work,
               const std::array<const WildPlate*, 2>& plates,
               const std::array<PlateFrame, 2>& frames, Side side, double& s) {
  constexpr double flush_mm = 0.05;
  WildEnd end;
  const double out = side == Side::begin ? -1 : 1;
  const double first = foot_end(*plates[0], side), second = foot_end(*plates[1], side);
  end.plate = std::abs(first - second) < flush_mm ? 2 : out * first < out * second ? 0 : 1;
  s = end.plate == 0 ? first : second;
  if (end.plate == 2) s = (first + second) / 2;
  const double level = work.joint == "butt" || work.joint == "v" ? mismatch_at(work, s) / 2 : 0;
  end.point = T_base_work * bent(work, {s, 0, level});
  for (int j = 0; j < 2; ++j) {
    const WildPlate& plate = *plates[j];
    const WildCut& cut = side == Side::begin ? plate.begin : plate.end;
    const auto on_edge = [&](double t) -> Vector3d {
      return T_base_work * bent(work, frames[j].at({face_edge(plate, side, t), t, 0}));
    };
    end.edge_points[j] = on_edge(0);
    end.edge_directions[j] = (on_edge(1) - on_edge(0)).normalized();
    end.edge_play_mm[j] = 2 * cut.wave_mm;
    // A groove's faces end at some distance from its middle: where a cut is turned, one of them may
    // before the seam does.
    const double aside = std::max(0.0, frames[j].edge.front().second);
    if (work.joint == "v")
      end.play_mm = std::max(end.play_mm, out * (s - face_edge(plate, side, aside)));
    if (end.plate != 2 && end.plate != j) continue;
    // Where a chamfer or a radius begins the face ends, and the metal later.
    end.play_mm = std::max({end.play_mm, 2 * cut.wave_mm, cut.chamfer_mm, cut.round_mm});
    end.play_mm = std::max(end.play_mm, std::abs(std::tan(cut.turn_deg * kDegree)) *
                                            (aside + std::max(0.0, gap_at(work, s)) / 2));
  }
  return end;
}

WildSeam seam_between(const WildWork& work, const RigidTransform& T_base_work,
                      const std::array<const WildPlate*, 2>& plates,
                      const std::array<PlateFrame, 2>& frames) {
  WildSeam seam;
  seam.joint_type = work.joint == "inside_corner" ? "corner" : work.joint;
  double from = 0, to = 0;
  seam.start = end_of(work, T_base_work, plates, frames, Side::begin, from);
  seam.end = end_of(work, T_base_work, plates, frames, Side::end, to);
  seam.direction = (seam.end.point - seam.start.point).normalized();
  const Eigen::Matrix3d turned = T_base_work.linear() * turn_at(work, from);
  for (int j = 0; j < 2; ++j) seam.normals[j] = turned * frames[j].normal();
  seam.angle = work.angle_deg * kDegree;
  if (work.joint == "outside_corner") seam.angle = 2 * std::numbers::pi - seam.angle;
  if (work.joint == "lap" || work.joint == "butt") seam.angle = std::numbers::pi;
  if (work.joint == "v") seam.angle = work.groove_deg * kDegree;
  seam.gap_start = gap_at(work, from);
  seam.gap_end = gap_at(work, to);
  seam.mismatch_start = mismatch_at(work, from);
  seam.mismatch_end = mismatch_at(work, to);
  if (work.joint == "lap")
    seam.thickness = work.second.thickness_mm + (seam.gap_start + seam.gap_end) / 2;
  if (work.bow_mm != 0) {
    const double length = to - from;
    seam.bow_mm = length * length / (8 * std::abs(radius_of(work)));
  }
  constexpr double reach_mm = 8;
  double beside = 0;  // what of the faces is cut off or round at the seam
  for (int j = 0; j < 2; ++j) {
    beside = std::max(beside, frames[j].edge.front().second);
    if (plates[j]->section != "plate") beside = std::max(beside, plates[j]->corner_radius_mm);
  }
  // Of a lap the upper plate's top lies so far above the seam, of a groove the higher plate's.
  if (work.joint == "lap") beside += work.second.thickness_mm;
  beside += std::max(std::abs(seam.mismatch_start), std::abs(seam.mismatch_end));
  seam.reach_mm = reach_mm + beside + std::max(seam.gap_start, seam.gap_end);
  seam.objects = {0, 1};
  return seam;
}

}  // namespace

Vector3d on_work(const WildWork& work, const RigidTransform& T_base_work, const Vector3d& point) {
  return T_base_work * bent(work, point);
}

RigidTransform place(const WildWork& work) {
  const Vector3d tilt_axis(std::cos(work.tilt_axis_deg * kDegree),
                           std::sin(work.tilt_axis_deg * kDegree), 0);
  RigidTransform T_base_work = RigidTransform::Identity();
  T_base_work.linear() =
      (Eigen::AngleAxisd(work.tilt_deg * kDegree, tilt_axis) *
       Eigen::AngleAxisd(work.yaw_deg * kDegree, Vector3d::UnitZ()) *
       Eigen::AngleAxisd(work.upside_down ? std::numbers::pi : 0, Vector3d::UnitX()))
          .toRotationMatrix();
  double lowest = std::numeric_limits<double>::infinity();
  for (const WorkPart& part : unplaced_parts(work)) {
    if (part.name == "bead") continue;  // weld metal would hold a work off the table, unseen
    for (const Vector3d& corner : part.mesh.corners)
      lowest = std::min(lowest, (T_base_work * corner).z());
  }
  T_base_work.translation() = Vector3d(work.position_mm.data());
  T_base_work.translation().z() -= lowest;
  return T_base_work;
}

std::vector<WorkPart> parts_of(const WildWork& work) {
  const RigidTransform T_base_work = place(work);
  std::vector<WorkPart> parts = unplaced_parts(work);
  for (WorkPart& part : parts) {
    part.mesh = transformed(part.mesh, T_base_work);
    if (!part.band) continue;
    part.band->middle = T_base_work * part.band->middle;
    part.band->across = T_base_work.linear() * part.band->across;
  }
  return parts;
}

std::vector<WildSeam> seams_of(const WildWork& work) {
  if (work.second_missing || work.upside_down) return {};
  const RigidTransform T_base_work = place(work);
  std::vector<WildSeam> seams{seam_between(work, T_base_work, {&work.first, &work.second},
                                           {first_frame(work), second_frame(work)})};
  if (work.joint != "tee" && work.joint != "inside_corner") return seams;
  // A rib is a tee like the first, on the same base plate seen from another line.
  int object = 2;
  for (const WildRib& rib : work.ribs) {
    WildWork other = work;
    other.joint = "tee";
    other.angle_deg = 90;
    other.gap_begin_mm = other.gap_end_mm = 0;
    other.second = WildPlate{};
    other.second.thickness_mm = rib.thickness_mm;
    other.second.away_mm = rib.height_mm;
    other.second.begin.at_mm = rib.begin_mm;
    other.second.end.at_mm = rib.end_mm;
    // The base plate's ends on that line.
    for (const Side side : {Side::begin, Side::end}) {
      WildCut& cut = side == Side::begin ? other.first.begin : other.first.end;
      cut.at_mm += face_edge(work.first, side, -rib.across_mm) - face_edge(work.first, side, 0);
      cut.wave_phase_deg -= 360 * rib.across_mm / cut.wave_pitch_mm;
    }
    PlateFrame base = first_frame(other), upright = second_frame(other);
    base.origin.y() += rib.across_mm;
    upright.origin.y() += rib.across_mm;
    WildSeam seam =
        seam_between(other, T_base_work, {&other.first, &other.second}, {base, upright});
    const Vector3d aside = T_base_work.linear() * Vector3d(0, rib.across_mm, 0);
    seam.start.point += aside;
    seam.end.point += aside;
    seam.objects = {0, object++};
    seams.push_back(seam);
  }
  return seams;
}

}  // namespace arcstart::cell_simulator
