// What the stripe's course is chosen from: the points of each column, and what each is worth.
#pragma once

#include <vector>

#include "services/extraction/lines/junctions.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

struct Candidate {
  int point, strand;
  int line;             // column, or row where along_rows
  float along, across;  // px, along and across the image's main direction of the stripe
  float slope;          // d across / d along
  float curvature, worth;
  bool starts_strand, ends_strand, reflection;
};

// By line, the strongest of a line first, a few of each.
struct Candidates {
  std::vector<Candidate> all;
  std::vector<int> line_begin;  // the first of each line, and the end

  int count() const { return static_cast<int>(all.size()); }
  int lines() const { return static_cast<int>(line_begin.size()) - 1; }
  const Candidate& operator[](int i) const { return all[static_cast<std::size_t>(i)]; }
};

// A point is worth more the stronger it is, up to the usual strength in the image, and less the
// more its width differs from the usual; a bright blob gains nothing. A reflection is worth
// nothing. widths: of the stripe's profile at each point, px, 0 where not known.
void collect_candidates(const std::vector<RidgePoint>& points, const FrameVector<Strand>& strands,
                        const std::vector<float>& widths, bool along_rows, Memory memory,
                        Candidates& candidates);

}  // namespace arcstart::extraction
