// Numbers of the referee. Behind the dash stands the source; "bench": none is known,
// scripts/bench seam --wild judges the number.
#pragma once

#include <cstddef>

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

struct RefereeConstants {
  // Points, evenly taken, by which a plane or a plate's shape is known well enough - its noise over
  // their root.
  std::size_t sample = 4096;

  // The sheet of light (stripe_light).

  // mm; points that spread less off a line span no plane, and none is off it that is nearer - they
  // lie on it to 0.001, float's rounding at 10 m.
  double light_width = 0.05;

  // Where light meets a plate (plate_view).

  // mm; between points that are looked at, so that a stripe tells to so much where it leaves a
  // plate - a quarter of a usual spacing of stripes.
  double step = 1.0;
  // Points of a stripe within a step, at most - 0.07 mm a pixel and less.
  int longest_jump = 16;
  // mm; away from the seam and along it beyond the claimed ends, what is looked at - what a plate's
  // edge is known by, over the tools that lie across a seam.
  double reach = 60;
  // Along the seam for each mm away, of a trace, at most: flatter stripes say little of an edge.
  double flattest = 2;

  // How a plate lies (plate_shape).

  // mm; a plate's own bend and its waves from robot and calibration, at most - 1 in 100.
  double bend = 1.0;
  // mm; of a place on it from a plate, at least - bench.
  double least_tolerance = 0.25;

  // What is plate (plate_looks).

  // mm; a plate counts from there on: nearer, fillets, gaps and reflections are - bench.
  double beside_seam = 1.5;
  // mm; of a plate from there on, what is beside the seam, to both sides. Farther away is what a
  // plate's shape is taken from: nearer, light from the other plate moves the stripe - bench.
  double near_seam = 5;

  // The seam as a whole (contradictions, seam_edges).

  // Tilt against the plane claimed, at most; rad - 0.6 of what must be noticed, 1 degree.
  double turned = 0.0105;
  // mm; a plate is not that of a round thing whose radius is less - the largest hand tool.
  double round = 60;
  // mm; a strip narrower than this may be that of a round thing - bench.
  double narrow = 15;
  // mm; what is narrower is no plate - an end face of sheet.
  double narrowest = 4.5;
  // Of a round corner's radius, what its arc keeps off the planes' line, at least: 0.41 at 90 deg,
  // 0.15 at 120; and the differences of the radii seen, at most, quartile to quartile - bench.
  double round_clearance = 0.3, one_radius = 0.3;
  // mm; radius of a root that is no seam, at least - 3 in the smallest rolled angles (EN 10056-1:
  // 3.5), and what the image takes of it.
  double least_root = 2.4;
  // Shares of what tells, stripes at the seam or places of one beside it: of what must be shown; of
  // what leaves no doubt; and of what may be otherwise by accident - bench.
  double shown_share = 0.6, nearly_all = 0.75, by_accident = 0.15;

  // A plate's end (end_bounds, edge_evidence, edge_fit).

  // Spacings of stripes from one that shows that a plate has ended to the next, at most, for that
  // to be believed - the next, with a spacing that varies by a half.
  double lone = 1.5;
  // mm; of a plate's width in a stripe, that shows nothing by accident - bench.
  double dark = 2;
  // Such a stripe's weight beside one that shows what lies behind - bench.
  double dark_weight = 0.4;
  // Between the slopes of an edge that are tried - 0.3 mm over the reach.
  double steepness_step = 0.005;
  // mm; a place of an edge is off by so much, at most, and the middle between the edges of plates
  // side by side - 0.3 px along the stripe, and the noise.
  double place = 0.2;
  // mm; waves of a flame's cut, at most - ISO 9013, unevenness of range 4 at 20 mm, and more.
  double largest_wave = 1.6;

  // What becomes of an answer (ruling).

  // mm; an end may be off along the seam by so much, and across it by half of it - a little less
  // than what is wrong silently.
  double allowed = 0.8;
  // Spacings of stripes: an end of which no more is known is not determined; and mm, no less -
  // bench.
  double determined = 2, always_determined = 5;
  // Of a second place, against the first - neither is known to be truer.
  double second_weight = 0.5;
};
inline constexpr RefereeConstants kReferee;

}  // namespace arcstart::seam_finding
