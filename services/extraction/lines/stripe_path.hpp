// Which of the chains are the stripe: one centre for each column of the image, by dynamic
// programming.
#pragma once

#include <optional>
#include <vector>

#include "services/extraction/lines/candidates.hpp"
#include "services/extraction/lines/linking.hpp"
#include "services/extraction/lines/reflections.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

// One branch of the stripe: indices of points, along the image's columns, or rows where the stripe
// runs down the image.
struct Branch {
  FrameVector<int> points;
  bool chosen =
      true;  // else a second candidate: a reflection, or something else that looks like a stripe
};

struct StripePath {
  bool along_rows =
      false;  // one centre a row: the stripe runs down the image rather than across it
  std::vector<Branch>
      branches;  // the chosen ones first, in order along the image; no two chosen share a column,
                 // but for their last few where one surface hides another
};

struct StripePathSettings {
  int longest_hole = 5;                   // columns without a centre that do not yet end a branch
  int fewest_points = 10;                 // of a branch
  int width = 0, height = 0, margin = 0;  // of the image, and of its border without points; px
  // Whether the stripe runs down the image, where that is known; else what most of the lines do.
  std::optional<bool> along_rows;
  double junction_reach = 7;  // px within which lines that meet are seen to end: a few sigma
};

class Selector {
 public:
  // widths: of the stripe's profile at each point, px, 0 where not known.
  //
  // A laser sheet is seen at most once a column, except where one surface hides another. So the
  // path of greatest worth from the first to the last column is taken, a column having one of its
  // points or none. Where it changes to another stripe, either is followed on to its end if that is
  // a few columns off: its last centres are weak, and tell where the surface ends. A point is worth
  // more the stronger it is, up to the usual strength in the image, and less the more its width
  // differs from the usual; a bright blob gains nothing. Leaving a line costs, whatever the
  // distance to the next, so that a step in the profile is followed and a short detour is not;
  // less where the stripe is narrow, for surfaces are fewer columns long in a coarse image. A
  // chain beside a clearly stronger one for most of its length is its reflection and is worth
  // nothing, even where the stronger one has a gap. Nothing is put in where there is no point. The
  // branches lie in the memory given.
  void select(const std::vector<RidgePoint>& points, const std::vector<Chain>& chains,
              const std::vector<float>& widths, const StripePathSettings& settings,
              StripePath& selection, Memory memory = heap());

 private:
  FrameVector<int> best_path() const;
  float leaving_cost(const Candidate& from, const Candidate& to) const;
  // The path goes on, far across, on another stripe.
  bool changes_stripe(const Candidate& from, const Candidate& to) const;
  // The candidates of the same strand behind (step 1) or before (-1) this one, one a column, from
  // it outward; none where the strand goes on for more than `reach` columns.
  FrameVector<int> rest_of_strand(int candidate, int step, int reach) const;
  void split_path(const FrameVector<int>& path, const StripePathSettings& settings,
                  StripePath& selection);
  void add_second_candidates(const StripePathSettings& settings, StripePath& selection);

  Memory memory_ = heap();
  float break_cost_ = 0;  // columns of clean stripe
  Candidates candidates_;
  std::vector<int> chosen_;  // of each line, -1 for none
};

}  // namespace arcstart::extraction
