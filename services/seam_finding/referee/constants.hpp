// Numbers of the referee. Behind the dash stands the source; "bench": none is known,
// scripts/bench seam --wild judges the number.
#pragma once

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

struct RefereeConstants {
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
  // mm; of a plate away from the seam, at most - what a plate's edge is known by.
  double reach = 60;
  // mm; along the seam beyond the claimed ends, what is looked at - the longest tool across a seam.
  double beyond = 80;
  // Of the seam's direction, its part along the light's normal, at least - 1: it is crossed square.
  double least_slope = 1e-3;
  // Along the seam for each mm away, of a trace, at most: flatter stripes say little of an edge.
  double flattest = 2;
  // Of the seam's length, to both sides of its middle, where a plate's begin is looked for - bench.
  double middle = 0.3;
  // mm; from where a plate is claimed to begin, it is found no farther off - radius of a section.
  double farthest_begin = 16;

  // How a plate lies (plate_shape).

  // mm; a plate's own bend and its waves from robot and calibration, at most - 1 in 100.
  double bend = 1.0;
  // Places by which a plate's shape is known well enough - its noise over their root.
  int shape_places = 1000;
  // mm; of a place on it from a plate, at least and at most - bench.
  double least_tolerance = 0.25, most_tolerance = 0.8;

  // What is plate (plate_looks).

  // mm; a plate counts from there on: nearer, fillets, gaps and reflections are - bench.
  double beside_seam = 1.5;
  // mm; of a plate from there on, what is beside the seam, to both sides. Farther away is what a
  // plate's shape is taken from: nearer, light from the other plate moves the stripe - bench.
  double near_seam = 5;
  // A stripe is on or off a plate beside the seam by this share of what is known there - bench.
  double clear = 0.75;

  // The seam as a whole (contradictions, seam_edges).

  // Tilt against the plane claimed, at most; rad - 0.6 of what must be noticed, 1 degree.
  double turned = 0.0105;
  // Of a plate's direction away from the seam, its part out of the plane, at most; 1 - rounding.
  double out_of_plane = 0.01;
  // mm; a plate is not that of a round thing whose radius is less - the largest hand tool.
  double round = 60;
  // mm; a strip narrower than this may be that of a round thing - bench.
  double narrow = 15;
  // mm; what is narrower is no plate - an end face of sheet.
  double narrowest = 4.5;
  // mm; away from the seam, beyond it an outside corner's plate is no cut - as wide as the thickest
  // plate, of 20 mm, and its edge's place.
  double widest_cut = 22;
  // mm; of a stripe on such a plate that shows nothing, at most: then the plate has ended -
  // dropouts.
  double plate_gap = 4;
  // Of the stripes at an outside corner that show a plate beside it, those that must show it so far
  // away as well - bench.
  double wide_share = 0.4;
  // Of a round corner's radius, what its arc keeps off the planes' line, at least: 0.41 at 90 deg,
  // 0.15 at 120; and the differences of the radii seen, at most, quartile to quartile - bench.
  double round_clearance = 0.3, one_radius = 0.3;
  // mm; between neighbouring places of a stripe on a plate, at most - M of 15 in steep sight.
  double place_gap = 3;
  // Of the stripes at a seam between parallel plates, those that leave the plates there - bench.
  double edges_shown = 0.2;
  // Of the stripes at a seam: then each must leave the plate there - bench.
  double nearly_all = 0.7;
  // Stripes by which an edge's course is known - bench.
  int course_stripes = 6;
  // Of the stripes at the seam that tell, those that must show it - bench.
  double shown_share = 0.6;

  // A plate's end (end_bounds, edge_evidence, edge_fit).

  // Stripes inside of those at the end, that may cross its edge far from the seam - an edge at 31
  // degrees over a plate of 60 mm.
  int stripes_inside = 12;
  // Spacings of stripes from one that shows that a plate has ended to the next, at most, for that
  // to be believed - the next, with a spacing that varies by a half.
  double lone = 1.5;
  // Share of a stripe's places on a plate that may be on the wrong side of its edge - bench.
  double misfit = 0.15;
  // mm; of a plate's width in a stripe, that shows nothing by accident - bench.
  double dark = 2;
  // Such a stripe's weight beside one that shows what lies behind - bench.
  double dark_weight = 0.4;
  // Of an edge's direction from the normal to the seam: along for each away - cut up to 31 degrees.
  double steepest = 0.6, steepness_step = 0.005;
  // mm; a place of an edge is off by so much, at most, and the middle between the edges of plates
  // side by side - 0.3 px along the stripe, and the noise.
  double place = 0.2;
  // mm; waves of a flame's cut, at most - ISO 9013, unevenness of range 4 at 20 mm, and more.
  double largest_wave = 1.6;
  // Of the stripes that cross an edge, those that may contradict it - bench.
  double contradicting = 0.2;

  // What becomes of an answer (ruling).

  // mm; an end is not off by less than it may be - a little less than what is wrong silently.
  double allowed = 0.8;
  // mm; and is not contradicted by less - likewise.
  double contradicted = 0.9;
  // Spacings of stripes: an end of which no more is known is not determined; and mm, no less -
  // bench.
  double determined = 2, always_determined = 5;
  // Of a second place, against the first - neither is known to be truer.
  double second_weight = 0.5;
  // mm; a plate lies off the seam by so much at an end, at most, before it counts - what is wrong
  // silently across.
  double off = 0.4;
};
inline constexpr RefereeConstants kReferee;

}  // namespace arcstart::seam_finding
