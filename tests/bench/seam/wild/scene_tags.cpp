#include "tests/bench/seam/wild/scene_tags.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace arcstart {

using namespace cell_simulator;
using Eigen::Vector3d;
using seam_finding::synthetic::WildSeamSight;
using seam_finding::synthetic::WildSight;
namespace {

class Tags {
 public:
  void add(bool there, const std::string& tag) {
    if (there && std::find(tags_.begin(), tags_.end(), tag) == tags_.end()) tags_.push_back(tag);
  }

  void add_cut(const WildCut& cut) {
    add(std::abs(cut.turn_deg) > 3, "turn");
    add(cut.slant_deg != 0, "slant");
    add(cut.chamfer_mm > 0 || cut.round_mm > 0, "dressed");
    add(cut.wave_mm > 0, "wave");
    add(cut.cope_mm > 0, "cope");
  }

  void add_plate(const WildPlate& plate) {
    add(plate.section != "plate", plate.section);
    add(plate.thickness_mm < 3, "sheet");
    add_cut(plate.begin);
    add_cut(plate.end);
    add(!plate.holes.empty(), "hole");
    add(!plate.notches.empty(), "notch");
    add(plate.surface.specular_share > 0.3, "mirror");
    add(plate.surface.albedo < 0.1, "black");
    add(plate.ground_mm > 0, "ground_band");
  }

  void add_work(const WildWork& work) {
    add(work.second_missing, "lone_plate");
    add(work.upside_down, "upside_down");
    add_plate(work.first);
    add_plate(work.second);
    add(work.joint == "outside_corner", work.corner);
    add(std::abs(work.angle_deg - 90) > 10, "angle_off_90");
    add(std::max(work.gap_begin_mm, work.gap_end_mm) > 0.3, "gap");
    add(std::max(std::abs(work.mismatch_begin_mm), std::abs(work.mismatch_end_mm)) > 0.3,
        "mismatch");
    add(std::abs(work.bow_mm) > 0.1, "bow");
    add(std::abs(work.yaw_deg) > 10, "yaw");
    add(std::abs(work.tilt_deg) > 3, "tilt");
    add(work.second.end.at_mm - work.second.begin.at_mm < 80, "short");
    for (const WildBead& bead : work.beads) add(true, bead.other_side ? "other_bead" : "tack");
    add(!work.ribs.empty(), "rib");
    add(!work.tabs.empty(), "tab");
  }

  void add_solid(const WildSolid& solid, const WildTruth& truth) {
    add(solid.with_background && !solid.with_work, "gone");
    if (!solid.with_work) return;
    const bool bar = (solid.kind == "round" || solid.kind == "hexagon") && solid.size_mm[0] > 20;
    if (!bar || truth.seams.empty())
      return add(true, solid.kind == "hexagon" ? "nut"
                       : solid.kind == "ball"  ? "spatter"
                                               : solid.kind);
    // How near a bar's axis comes to the seam's line tells one across it from one that lies about.
    const Vector3d middle(solid.position_mm.data());
    const Eigen::Quaterniond turned(solid.quaternion[0], solid.quaternion[1], solid.quaternion[2],
                                    solid.quaternion[3]);
    const Vector3d axis = turned * Vector3d::UnitX();
    const WildSeam& seam = truth.seams[0];
    const double length = (seam.end.point - seam.start.point).norm();
    double nearest = 1e9;
    constexpr int steps = 20;
    for (int i = -steps; i <= steps; ++i) {
      const Vector3d p = middle + solid.size_mm[0] / 2 * i / steps * axis;
      const double along = std::clamp(seam.direction.dot(p - seam.start.point), 0.0, length);
      nearest = std::min(nearest, (seam.start.point + along * seam.direction - p).norm());
    }
    constexpr double near_mm = 25, in_line = 0.95;
    if (nearest > near_mm) return add(true, "bar");
    add(true, std::abs(axis.dot(seam.direction)) > in_line ? "bar_along" : "tool_across");
  }

  void add_events(const WildEvents& events) {
    add(events.wire_radius_mm > 0, "wire");
    add(events.arc_grey > 0, "arc");
    add(events.sun_grey > 0, "sun");
    add(events.flicker_grey > 0, "flicker");
    add(events.shake_mm > 0, "shake");
    add(events.spoilt_share > 0, "spoilt");
  }

  void add_scan(const WildScanGeometry& scan) {
    add(scan.lean_deg < 30, "lean_low");
    add(scan.lean_deg > 45, "lean_high");
    add(scan.pitch_mm > 5, "coarse");
    add(scan.pitch_mm < 2.5, "fine");
    add(scan.robot_wave_mm > 0, "robot_wave");
    add(scan.calibration_error > 0, "calibration");
  }

  std::vector<std::string> take() { return std::move(tags_); }

 private:
  std::vector<std::string> tags_;
};

}  // namespace

const char* name_of(WildSight::Kind kind) {
  switch (kind) {
    case WildSight::Kind::kOutside:
      return "outside";
    case WildSight::Kind::kHidden:
      return "hidden";
    case WildSight::Kind::kBounded:
      return "bounded";
    default:
      return "crossed";
  }
}

std::vector<std::string> tags_of(const WildScene& scene, const WildTruth& truth,
                                 const std::vector<WildSeamSight>& sights) {
  Tags tags;
  tags.add(truth.wrong, "wrong_part");
  if (!sights.empty()) {
    tags.add(true, std::string("start_") + name_of(sights[0].start.kind()));
    tags.add(true, std::string("end_") + name_of(sights[0].end.kind()));
  }
  tags.add(scene.solids.empty(), "no_clutter");
  tags.add(scene.works.size() > 1, "two_works");
  for (const WildWork& work : scene.works) tags.add_work(work);
  for (const WildSolid& solid : scene.solids) tags.add_solid(solid, truth);
  tags.add(scene.table.slot_pitch_mm > 0, "slots");
  tags.add_events(scene.events);
  tags.add_scan(scene.scan);
  return tags.take();
}

}  // namespace arcstart
