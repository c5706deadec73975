#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "services/cell_simulator/wild/drawing.hpp"
#include "services/cell_simulator/wild/work_form.hpp"

namespace arcstart::cell_simulator {

WildSurface draw_surface(Draw& draw) {
  // albedo, mottling, specular share, gloss, noise across a stripe in px, dropouts.
  const WildSurface rust{0.25, 0.5, 0, 0, 0.2, 0.005};
  const WildSurface primer{0.6, 0.05, 0.02, 0.02, 0.05, 0};
  const WildSurface black{0.06, 0.2, 0.05, 0.02, 0.3, 0.05};
  const WildSurface mirror{0.15, 0.05, 0.6, 0.003, 0.15, 0.02};
  const double which = draw.within(0, 1);
  if (which < 0.4) return ground_steel;
  if (which < 0.6) return mill_scale;
  if (which < 0.72) return rust;
  if (which < 0.84) return primer;
  return which < 0.92 ? black : mirror;
}

void draw_ground_bands(WildWork& work, Draw& draw) {
  if (draw.chance(0.5)) return;
  for (WildPlate* plate : {&work.first, &work.second})
    if (plate->surface == mill_scale) plate->ground_mm = draw.within(10, 30);
}

WildTable draw_table(Draw& draw) {
  WildTable table;
  table.unevenness_mm = draw.within(0, 0.4);
  table.seed = static_cast<std::uint64_t>(draw.count(1, 1'000'000));
  if (!draw.chance(0.25)) return table;
  table.slot_pitch_mm = draw.within(50, 100);
  table.slot_width_mm = draw.within(10, 14);
  table.slot_depth_mm = 15;
  table.slot_offset_mm = draw.within(0, table.slot_pitch_mm);
  table.slot_turn_deg = draw.one_of({0.0, 90.0}) + draw.within(-5, 5);
  return table;
}

WildEvents draw_events(Draw& draw) {
  WildEvents events;
  if (draw.chance(0.08)) {
    events.wire_radius_mm = draw.within(0.5, 0.8);
    events.wire_in_camera_mm = {draw.within(-15, 15), draw.within(25, 50), draw.within(180, 240)};
  }
  if (draw.chance(0.05)) events.arc_grey = draw.within(200, 2000);
  if (draw.chance(0.08)) events.sun_grey = draw.within(10, 80);
  if (draw.chance(0.05)) events.flicker_grey = draw.within(5, 40);
  if (draw.chance(0.05)) events.shake_mm = draw.within(0.1, 0.3);
  if (draw.chance(0.12)) events.spoilt_share = draw.within(0.02, 0.1);
  return events;
}

WildScanGeometry draw_scan(const std::vector<WildWork>& works, Draw& draw) {
  WildScanGeometry scan;
  double low = -40, high = 40, height = 0;
  for (const WildWork& work : works) {
    const double from = std::min(work.first.begin.at_mm, work.second.begin.at_mm),
                 to = std::max(work.first.end.at_mm, work.second.end.at_mm);
    const double middle = work.position_mm[0] - WildWork{}.position_mm[0];
    const double straight = std::cos(work.yaw_deg * kDegree);
    low = std::min(low, middle + from * straight);
    high = std::max(high, middle + to * straight);
    if (&work == &works.front()) height = place(work).translation().z();
  }
  scan.taught_height_mm = std::max(0.5, height + draw.within(-3, 3));
  // Now and then the search begins behind the start, or ends before the end.
  scan.begin_mm = low - (draw.chance(0.04) ? -draw.within(2, 20) : draw.within(15, 40));
  scan.end_mm = high + (draw.chance(0.06) ? -draw.within(2, 20) : draw.within(12, 40));
  scan.lean_deg = draw.chance(0.5) ? 38 + draw.within(-3, 3) : draw.within(20, 50);
  if (draw.chance(0.5)) scan.pitch_mm = draw.within(1.5, 7);
  scan.phase_share = draw.within(0, 1);
  if (draw.chance(0.15)) scan.robot_wave_mm = draw.within(0.1, 0.5);
  if (draw.chance(0.15)) scan.calibration_error = draw.within(0.3, 1);
  return scan;
}

}  // namespace arcstart::cell_simulator
