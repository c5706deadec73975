// Numbers of what makes two plates a joint. Behind the dash stands the source; "bench": none is
// known, scripts/bench seam judges the number.
#pragma once

#include <cstddef>

#include "common/geometry.hpp"
#include "services/seam_finding/planes/constants.hpp"

namespace arcstart::seam_finding {

struct JointConstants {
  // mm; a plate that reaches so far from the seam counts in full - bench.
  double full_reach = 10;
  // mm; less of it seen on both plates is no seam - bench.
  double shortest_seam = 10;
  // mm; nor is it where less bears it out: between parallel plates, in a cloud without stripes -
  // bench.
  double shortest_doubtful = 20;
  // Alternatives listed, at most - none known; a person reads them.
  std::size_t alternatives = 6;

  // Crossing plates.

  // Share of a plate before the other, at least - bench.
  double least_concave = 0.8;
  // mm; a plate is seen so far in under the other through a root gap - bench: row root_gap.
  double in_under = 3.5;
  // Share of what is there that lies on the two plates, at least - bench.
  double least_explained = 0.5;
  // Component of a unit direction, at least, whose sign is not noise - bench.
  double no_component = 0.05;
  // rad; beyond the tolerance of Eq. 6, what is listed with its flaw - bench.
  double near_miss = 10 * kDegree;
  // rad; between faces of one plane, and between lines of one seam - bench.
  double same_plane = 2 * kDegree, same_direction = 3 * kDegree;
  // rad; between a face and the viewpoint from which its side is known, where that is assumed and
  // where it is given - bench.
  double assumed_view_slant = 20 * kDegree, given_view_slant = 5 * kDegree;
  // mm; so near the other plate the stripe's centre is drawn aside - bench.
  double bend_width = 1.2;
  // mm; beyond the seam's ends, what its planes are fitted to - bench.
  double overhang = 3;

  // rad; of a plate's cut from square to the seam, at most - cuts up to 31 deg.
  double most_cut_turn = 35 * kDegree;
  // Share of an end's face that lies so deep, at least, where the body is solid - bench.
  double least_solid = 0.1;

  // rad; between a groove's side and its plate's top - ISO 9692-1: sides of 5 to 60 deg to the
  // top's normal.
  double least_top_fold = 30 * kDegree, most_top_fold = 85 * kDegree;
  // rad; between a seam and the edge along it - a plate tapers by less.
  double same_course = 10 * kDegree;

  // Parallel plates: the bench's rows are lap, butt and v.

  // mm; crossings of faces so near a joint of parallel plates are part of it - bench.
  double around_parallel = 3;
  // Share of the sections in which a seam shows, at least - bench.
  double through = 0.6;
  // Width of a lap's upper plate over its height, at least - bench.
  double wider_than_high = 1.5;
  // mm; of a point on a plate from its plane, at least - bench.
  double least_near = 0.15;
  // mm; standard deviation of a stripe's end at a gap - bench.
  double end_deviation = 0.25;
  // mm; standard deviation of a gap that no stripe shows alone - bench.
  double narrow_deviation = 0.1;
  // mm; standard deviation of a seam across, at most - bench.
  double unsteady = 0.4;
  // mm; of a plate away from the seam, at least - bench.
  double least_reach = 15;
  // Of a lap's score where its root is hidden: whoever scans one looks at the root - bench.
  double hidden_root = 0.5;
  // mm of shadow beside a step for each mm of its height - bench.
  double step_shadow = 2;

  // mm; of a transition from its line, at most - bench.
  double on_line = 2;
  // mm; between transitions that draw a line, at least - bench.
  double least_base = 10;
  // Of that line, mm across for each mm along, at most - bench.
  double steepest_line = 0.8;
  // Transitions that may draw one - bounds the time.
  std::size_t drawn = 200;

  // Standard deviations of an edge face's lean, mm across for each mm up: of a plate cut square,
  // and of one of which nothing is known - bench.
  double square_cut = 0.1, free_cut = 3;
  // mm; standard deviation of a segment's last centre from the edge it leaves - bench.
  double jump_deviation = 0.3;
  // mm; standard deviation across of a point on an edge face - bench.
  double cut_deviation = 0.1;
  // mm; depth of an edge face by which its slant is known, at least - bench.
  double least_depth = 1.5;
  // Points on an edge face, at least - bench.
  std::size_t cut_points = 6;
  // An edge face's points over what lies on the plates - bench.
  double off_plate = 1.25;
  // mm out for each mm across; of a straight run on a plate against the face that holds it, at
  // most: a face that is laid through two plates a tolerance apart lies less askew - bench.
  double steepest_run = 0.1;
  // mm; from the line, where a narrow gap is sought - bench.
  double gap_reach = 4;
  // rad; of an edge face from the plate's normal, at least, where it is a groove's - bench.
  double slanting = 0.2;
  // mm; noise beside a gap, where the light of both plates mingles, at least - bench.
  double gap_noise = 0.06;
  // mm across for each mm down; of the sight into a gap, at least - bench.
  double least_gap_sight = 0.15;
  // mm; between the tops of a butt joint's plates, at most, where its gap is fitted or their faces
  // are taken together - bench.
  double one_level = 1;
  // mm; of a step between two plates, where a lap alone is wanted: at least, so that waves and
  // bends make none. Sheet metal is thinner only in bodies and cabinets - bench, whose sheets are
  // of 0.8 mm and more.
  double least_step = 0.6;
  // mm; of the tops' mismatch where the lower plate is seen to end, at most - ISO 5817, 507, level
  // B, of any thickness.
  double most_offset = 3;
  // mm; of a lap's root gap, at most: what is seen of the step is the upper plate and the gap - ISO
  // 5817, 617, level B.
  double most_root_gap = 2;
  // Score over that of a joint found by the faces' planes, at least, for one found by the stripes'
  // runs or in faces taken together: where the planes tell, they tell more closely - bench.
  double clearly_better = 1.05;
  // Variance across over that one's, at most, where the scores are alike - bench.
  double clearly_closer = 0.7;
  // mm; from both borders of a gap, where what a stripe shows is between the plates - bench.
  double off_border = 0.6;
  // mm; by which the edges of plates that touch seem to overlap, at most - bench.
  double overlap = 0.5;
  // mm; from the edges that a line in one plate seems to have, its floor reaches - bench: lines up
  // to 2 mm wide.
  double floor_beside = 1;
  // Share of the stripes that are seen to go on below the lower plate, where it ends - bench.
  double seen_below = 0.3;
};
inline constexpr JointConstants kJoints;

}  // namespace arcstart::seam_finding
