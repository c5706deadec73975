#include "services/cell_simulator/wild/draw_plate.hpp"

#include <algorithm>

#include "services/cell_simulator/wild/plate_form.hpp"

namespace arcstart::cell_simulator {
namespace {

void draw_cut(WildCut& cut, Draw& draw, double thickness) {
  if (draw.chance(0.3)) cut.turn_deg = draw.within(-30, 30);
  if (draw.chance(0.15)) cut.slant_deg = draw.within(-25, 25);
  const double dressed = draw.within(0, 1), most = std::min(2.0, 0.45 * thickness);
  if (dressed < 0.08 && most > 0.5) cut.chamfer_mm = draw.within(0.5, most);
  if (dressed > 0.92 && most > 0.5) cut.round_mm = draw.within(0.5, most);
  if (draw.chance(0.12)) {
    cut.wave_mm = draw.within(0.3, 1);
    cut.wave_pitch_mm = draw.within(3, 10);
    cut.wave_phase_deg = draw.within(0, 360);
  }
}

// Cuts that meet before the plate ends are turned outward.
void keep_wide(WildPlate& plate) {
  constexpr double least_mm = 25;
  for (const double t : {-plate.behind_mm, plate.away_mm}) {
    const auto width = [&] {
      return face_edge(plate, Side::end, t) - face_edge(plate, Side::begin, t);
    };
    for (WildCut* cut : {&plate.begin, &plate.end})
      if (width() < least_mm && t * cut->turn_deg < 0) cut->turn_deg = t > 0 ? 2 : -2;
  }
  // Turned outward on one side is inward on the other: then they stay square.
  if (face_edge(plate, Side::end, -plate.behind_mm) -
          face_edge(plate, Side::begin, -plate.behind_mm) <
      least_mm)
    plate.begin.turn_deg = plate.end.turn_deg = 0;
}

// The part of a plate in which a hole or a notch keeps off both cuts at this distance.
bool room_for(const WildPlate& plate, double away, double half_width, double& low, double& high) {
  constexpr double rim_mm = 6;
  low = std::max(face_edge(plate, Side::begin, away), face_edge(plate, Side::begin, 0)) +
        half_width + rim_mm;
  high = std::min(face_edge(plate, Side::end, away), face_edge(plate, Side::end, 0)) - half_width -
         rim_mm;
  return high > low;
}

}  // namespace

double draw_thickness(Draw& draw) {
  if (draw.chance(0.4)) return draw.within(0.8, 3);  // sheet
  return draw.chance(0.7) ? draw.within(4, 12) : draw.within(12, 20);
}

void draw_ends(WildPlate& plate, Draw& draw) {
  for (WildCut* cut : {&plate.begin, &plate.end}) draw_cut(*cut, draw, plate.thickness_mm);
  keep_wide(plate);
}

void draw_overhangs(WildPlate& plate, const WildPlate& other, Draw& draw) {
  const auto overhang = [&] {
    const double which = draw.within(0, 1);
    if (which < 0.15) return 0.0;
    return which < 0.75 ? draw.within(2, 25) : -draw.within(2, 15);
  };
  plate.begin.at_mm = other.begin.at_mm - overhang();
  plate.end.at_mm = other.end.at_mm + overhang();
}

void draw_openings(WildPlate& plate, Draw& draw) {
  const double rim = 12;  // off the seam
  if (draw.chance(0.15) && plate.away_mm > 40) {
    WildHole hole;
    hole.radius_mm = draw.within(3, 8);
    hole.away_mm = draw.within(rim + hole.radius_mm, 0.6 * plate.away_mm);
    double low, high;
    if (hole.away_mm > rim + hole.radius_mm &&
        hole.away_mm < 0.65 * plate.away_mm - hole.radius_mm &&
        room_for(plate, hole.away_mm, hole.radius_mm, low, high)) {
      hole.along_mm = draw.within(low, high);
      plate.holes.push_back(hole);
    }
  }
  if (draw.chance(0.1)) {
    WildNotch notch;
    notch.width_mm = draw.within(8, 20);
    notch.depth_mm = draw.within(4, 0.3 * plate.away_mm);
    double low, high;
    if (room_for(plate, plate.away_mm, notch.width_mm / 2, low, high)) {
      notch.along_mm = draw.within(low, high);
      plate.notches.push_back(notch);
    }
  }
}

void make_hollow(WildPlate& plate, Draw& draw) {
  plate.section = "hollow";
  plate.thickness_mm = draw.within(2, 6);
  plate.depth_mm = draw.within(30, 60);
  plate.corner_radius_mm = std::max(3.0, plate.thickness_mm * draw.within(1, 2.5));
}

}  // namespace arcstart::cell_simulator
