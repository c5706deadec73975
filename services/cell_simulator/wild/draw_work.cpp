#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "services/cell_simulator/wild/draw_plate.hpp"
#include "services/cell_simulator/wild/drawing.hpp"
#include "services/cell_simulator/wild/plate_form.hpp"

namespace arcstart::cell_simulator {
namespace {

void draw_gap(WildWork& work, Draw& draw, double most) {
  if (draw.chance(0.5)) return;
  work.gap_begin_mm = work.gap_end_mm = draw.within(0, most);
  if (draw.chance(0.5)) work.gap_end_mm = draw.within(0, most);
}

void draw_fillet(WildWork& work, Draw& draw) {
  WildPlate &base = work.first, &upright = work.second;
  const bool tee = work.joint == "tee";
  base.thickness_mm = draw_thickness(draw);
  upright.thickness_mm = draw_thickness(draw);
  upright.away_mm = draw.within(25, 70);
  base.away_mm = draw.within(35, 70);
  work.angle_deg = draw.chance(0.75) ? 90 + draw.within(-3, 3) : draw.within(60, 120);
  const double section = tee ? draw.within(0, 1) : 1;
  if (section < 0.12) {
    make_hollow(upright, draw);
    work.angle_deg = 90;
  } else if (section < 0.22) {
    upright.section = "angle";
    upright.thickness_mm = draw.within(3, 10);
    upright.depth_mm = draw.within(25, 60);
    upright.corner_radius_mm = draw.chance(0.5) ? 0 : upright.thickness_mm * draw.within(1, 1.5);
    work.angle_deg = 90;
  } else if (section < 0.3) {
    make_hollow(base, draw);
  }
  const double foot = upright.section == "plate" ? upright.thickness_mm : upright.depth_mm;
  base.behind_mm = tee ? foot + draw.within(20, 60) : foot / std::sin(work.angle_deg * kDegree);
  draw_overhangs(base, upright, draw);
  draw_ends(base, draw);
  draw_ends(upright, draw);
  draw_gap(work, draw, 2.5);
  if (base.section == "plate") draw_openings(base, draw);
  if (upright.section != "plate") return;
  draw_openings(upright, draw);
  for (WildCut* cut : {&upright.begin, &upright.end})
    if (draw.chance(0.1) && upright.away_mm > 40) cut->cope_mm = draw.within(8, 20);
}

void draw_lap(WildWork& work, Draw& draw) {
  WildPlate &lower = work.first, &upper = work.second;
  lower.thickness_mm = draw_thickness(draw);
  upper.thickness_mm = draw.chance(0.5) ? draw.within(0.8, 3) : draw.within(3, 12);
  upper.away_mm = draw.within(35, 70);
  lower.away_mm = draw.within(35, 65);
  lower.behind_mm = draw.within(15, 50);
  draw_overhangs(lower, upper, draw);
  draw_ends(lower, draw);
  draw_ends(upper, draw);
  draw_gap(work, draw, 1.5);
  draw_openings(lower, draw);
  draw_openings(upper, draw);
}

// Butt joint, V, outside corner: both plates end at the seam.
void draw_edge_to_edge(WildWork& work, Draw& draw) {
  WildPlate &first = work.first, &second = work.second;
  const bool corner = work.joint == "outside_corner", groove = work.joint == "v";
  first.thickness_mm = groove ? draw.within(5, 20) : draw_thickness(draw);
  if (corner) first.thickness_mm = std::min(first.thickness_mm, 12.0);
  second.thickness_mm = first.thickness_mm;
  first.away_mm = draw.within(35, 65);
  second.away_mm = draw.within(35, 65);
  const auto beside = [&] {
    const double which = draw.within(0, 1);
    return which < 0.5 ? draw.within(-0.5, 0.5) : draw.within(-8, 8);
  };
  first.begin.at_mm = second.begin.at_mm + beside();
  first.end.at_mm = second.end.at_mm + beside();
  draw_ends(first, draw);
  draw_ends(second, draw);
  // Cuts turned far run across both plates, as one saw cut.
  for (const Side side : {Side::begin, Side::end}) {
    WildCut &one = side == Side::begin ? first.begin : first.end,
            &other = side == Side::begin ? second.begin : second.end;
    if (std::abs(other.turn_deg) > 3) other.turn_deg = -one.turn_deg;
  }
  keep_wide(second);
  draw_openings(first, draw);
  draw_openings(second, draw);
  if (corner) {
    work.angle_deg = draw.chance(0.7) ? 90 + draw.within(-3, 3) : draw.within(75, 105);
    draw_gap(work, draw, 1.5);
    return;
  }
  draw_gap(work, draw, 3);
  if (draw.chance(0.4)) {
    const double most = std::min(2.0, 0.4 * first.thickness_mm);
    work.mismatch_begin_mm = work.mismatch_end_mm = draw.within(-most, most);
    if (draw.chance(0.5)) work.mismatch_end_mm = draw.within(-most, most);
  }
  if (!groove) return;
  work.groove_deg = draw.within(40, 90);
  if (draw.chance(0.6)) work.root_face_mm = draw.within(0, std::min(3.0, first.thickness_mm / 2));
}

void draw_beads(WildWork& work, Draw& draw) {
  const double from =
                   std::max(foot_end(work.first, Side::begin), foot_end(work.second, Side::begin)),
               to = std::min(foot_end(work.first, Side::end), foot_end(work.second, Side::end));
  if (draw.chance(0.25)) {  // tacks
    const int count = draw.count(1, 3);
    for (int i = 0; i < count; ++i) {
      WildBead tack;
      tack.length_mm = draw.within(10, 20);
      tack.leg_mm = draw.within(2, 4);
      tack.along_mm =
          draw.chance(0.3) ? from + draw.within(0, tack.length_mm / 2) : draw.within(from, to);
      work.beads.push_back(tack);
    }
  } else if (draw.chance(0.1)) {  // a stitch weld
    const double leg = draw.within(3, 5), length = draw.within(15, 30);
    for (double at = from + draw.within(10, 40); at < to; at += 2.5 * length)
      work.beads.push_back({at, length, leg, false});
  }
  if (draw.chance(0.12))
    work.beads.push_back({(from + to) / 2, to - from - 4, draw.within(3, 6), true});
}

void draw_ribs_and_tabs(WildWork& work, Draw& draw) {
  WildPlate& base = work.first;
  if (work.joint == "tee" && base.section == "plate" && draw.chance(0.15)) {
    WildRib rib;
    rib.thickness_mm = work.second.section == "plate" ? work.second.thickness_mm : 8;
    rib.begin_mm = work.second.begin.at_mm + draw.within(-3, 3);
    rib.end_mm = work.second.end.at_mm + draw.within(-3, 3);
    if (draw.chance(0.75)) {
      const double foot = work.second.section == "plate" ? rib.thickness_mm : work.second.depth_mm;
      rib.across_mm = foot + draw.within(30, 60);
      rib.height_mm = work.second.away_mm;
      base.behind_mm = std::max(base.behind_mm, rib.across_mm + rib.thickness_mm + 10);
    } else {
      rib.across_mm = -draw.within(30, 60) - rib.thickness_mm;
      rib.height_mm = draw.within(15, 40);
      base.away_mm = std::max(base.away_mm, -rib.across_mm + 10);
    }
    base.begin.turn_deg = base.end.turn_deg = 0;
    base.holes.clear();
    work.ribs.push_back(rib);
  }
  const bool edge_to_edge = work.joint == "butt" || work.joint == "v";
  for (const bool at_begin : {true, false}) {
    if (!draw.chance(edge_to_edge ? 0.12 : 0.05)) continue;
    // A tab that goes on where the base plate decides the end would move it.
    const double ahead = at_begin ? work.second.begin.at_mm - base.begin.at_mm
                                  : base.end.at_mm - work.second.end.at_mm;
    if ((!edge_to_edge && (work.joint == "outside_corner" || ahead < 3)) || base.section != "plate")
      continue;
    WildTab tab;
    tab.at_begin = at_begin;
    tab.length_mm = draw.within(15, 40);
    tab.half_width_mm = draw.within(12, 25);
    tab.thickness_mm = base.thickness_mm;
    if (draw.chance(0.5)) tab.lower_mm = draw.within(0.3, 2);
    WildCut& cut = at_begin ? base.begin : base.end;
    cut.turn_deg = 0;
    if (edge_to_edge) {
      // Both plates end on it.
      WildCut& other = at_begin ? work.second.begin : work.second.end;
      other.turn_deg = 0;
      other.at_mm = cut.at_mm;
    }
    work.tabs.push_back(tab);
  }
}

}  // namespace

void draw_corner(WildWork& work, Draw& draw) {
  if (work.joint != "outside_corner" || draw.chance(0.4)) return;
  const double which = draw.within(0, 1);
  work.corner = which < 0.3 ? "over" : which < 0.5 ? "butted" : "open";
  WildPlate& thicker = draw.chance(0.5) ? work.first : work.second;
  thicker.thickness_mm = draw.within(thicker.thickness_mm, 12);
}

WildWork draw_work(const std::string& joint, Draw& draw, bool quiet) {
  WildWork work;
  work.joint = joint;
  const double length = draw.chance(0.7) ? draw.within(80, 160) : draw.within(50, 80);
  work.second.begin.at_mm = -length / 2;
  work.second.end.at_mm = length / 2;
  work.first.begin.at_mm = -length / 2;
  work.first.end.at_mm = length / 2;
  if (joint == "tee" || joint == "inside_corner")
    draw_fillet(work, draw);
  else if (joint == "lap")
    draw_lap(work, draw);
  else
    draw_edge_to_edge(work, draw);
  if (draw.chance(0.2)) work.bow_mm = draw.within(-1, 1);
  work.first.surface = draw_surface(draw);
  work.second.surface = draw.chance(0.6) ? work.first.surface : draw_surface(draw);
  work.position_mm[0] += draw.within(-12, 12);
  work.position_mm[1] += draw.within(-12, 12);
  const double yaw = draw.chance(0.6) ? 15 : 30, tilt = draw.chance(0.7) ? 3 : 6;
  work.yaw_deg = draw.within(-yaw, yaw);
  work.tilt_deg = draw.within(-tilt, tilt);
  work.tilt_axis_deg = draw.within(0, 360);
  if (quiet) return work;
  draw_beads(work, draw);
  draw_ribs_and_tabs(work, draw);
  return work;
}

}  // namespace arcstart::cell_simulator
