// Numbers of where a seam starts and ends. Behind the dash stands the source; "bench": none is
// known, scripts/bench seam judges the number.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "services/seam_finding/coverage/constants.hpp"

namespace arcstart::seam_finding {

struct EndConstants {
  // Where a stripe leaves a plate.

  // px square to the edge; standard deviation of a stripe's last centre from where it is expected
  // before the edge - bench.
  double light_deviation = 0.2;
  // mm along the seam for each mm of a stripe: below it light fades slowly at the edge. And the px
  // that are added for each so much less - bench.
  double flat_crossing = 0.2, flat_deviation = 8;
  // mm; between the depths of points on an edge face that tell its edge, at least - bench.
  double least_drop = 0.5;
  // Points on an edge face, at most - bench.
  int most_on_cut = 20;
  // mm; standard deviation of an edge face's place along the seam - bench.
  double cut_noise = 0.07;
  // mm behind or before a plate for each mm of a stripe that leaves it over its edge, at least:
  // bent plates leave their plane by less - bench: wild.
  double least_turn = 0.2;
  // mm; over such a way the noise of points leaves a direction known - bench.
  double direction_base = 3;
  // Of a stripe, mm along the seam for each mm of its length, at least - bench.
  double least_slant = 0.05;

  // mm; away from the seam, within which places lie on the plate's side; and by twice as much they
  // are apart along it: no end is so steep - bench: row short_base.
  double side_edge = 1.5;

  // A plate's edge.

  // mm; standard deviation of a place along the seam, at least - bench.
  double least_place_noise = 0.015;
  // px square to the edge; what all its places have in common: light ends over edges in many ways -
  // bench.
  double common_deviation = 0.1;
  // Share of plates that are not cut square to the seam - bench: wild.
  double slanted_share = 0.2;
  // Slopes up to the steepest that stand for all where none is told - a tenth of the reach.
  int slanted_steps = 10;
  // Slopes told by crossings that are looked at, at most - bench.
  std::size_t most_told = 2;
  // mm; standard deviations by which an edge is rough (milled, sheared, cut by flame), and their
  // shares - bench: wild.
  std::array<std::pair<double, double>, 3> roughness = {std::pair{0.0, 0.6}, std::pair{0.12, 0.25},
                                                        std::pair{0.45, 0.15}};

  // Share of plates whose corner is cut out beside the seam; mm, so far at most - cope holes of
  // rolled sections, AWS D1.1 and EN 1090. mm; what tells it lies so near the seam; and logarithm
  // by which it speaks against the edge - bench: wild.
  double coped_share = 0.05, cope_most = 25, cope_seen = 6, cope_told = 3;

  // What a stripe shows though the edge is not there: probabilities, a stripe.

  // Something behind the plate: a reflection, or a hole in it - bench.
  double seen_past = 0.03;
  // By an accident without a name: nothing of the plate at the seam, another thing in its plane, an
  // end on the plate where light falls on something behind it - bench.
  double accident = 0.02;
  // Nothing of the plate where something stands that may hide it - bench.
  double absent_covered = 0.97;
  // The less likely of the two, if a stripe shows both - bench.
  double second_witness = 0.5;
  // A stripe that ends on the plate; and where something stands that may hide it - bench.
  double ends_early = 0.1, ends_covered = 0.7;
  // mm; over which such ends lie, all places alike - what is seen about an end.
  double way_seen = 30;
  // Another thing in the plate's plane behind a place that is seen past - bench.
  double on_thing = 0.3;

  // Both plates.

  // mm; a narrower root gap cannot be told from none - reflections in the corner: README, figures.
  double least_gap = 0.7;

  // Share of joints whose plates end together, and the mm over which the others' ends scatter about
  // each other - bench.
  double flush_share = 0.3, offsets = 40;
  // mm; half a stripe's width, over which it is seen where it falls - bench.
  double half_stripe = 0.15;
  // mm; between the points of a stripe that are looked at for what lies behind the plates, at most,
  // and before them - a third of what is told apart.
  double looked_behind = 0.8, looked_before = 1.6;

  // Stripes, at least, that end at the outline of what hides an end: a lone one may show a
  // reflection.
  int outline_stripes = 2;

  // The grid over the places of an end.

  // mm - half of it gives the same errors: bench.
  double grid_step = 0.05;
  // mm; inward from where both plates were last shown together, and outward from where they were
  // last seen - bench.
  double inside = 30, outside = 60;
  // Logarithm of what counts beside the best - 1e-9.
  double least_log = -20;
  // 1/mm; less dense places part two modes - bench.
  double least_density = 1e-4;
  // Cells squared; variance of one step of a blur, at most - for three cells.
  double blur_variance = 0.5;
  // Probability that does not count - an error of three deviations.
  double never = 0.01;
  // Stripe spacings; standard deviation up to which an end was seen; and up to which its edge was -
  // bench.
  double seen_spacings = 1, by_edges = 0.15;
};
inline constexpr EndConstants kEnds;

}  // namespace arcstart::seam_finding
