#include "services/extraction/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcstart {
namespace {

constexpr float kSteepest = 4;  // slope believed in
constexpr int kMostOfLine = 6;  // candidates of a line

// Logarithm of a width's ratio to the usual that is unlikely. A blob is wider; narrower is the
// stripe itself where it is dim, but where it is bright that is spatter.
constexpr float kWider = 0.6f, kNarrower = 1.2f, kNarrowerAndBright = 0.6f;

using Weighted = std::pair<float, float>;  // value, weight

float weighted_median(FrameVector<Weighted>& values) {
  std::sort(values.begin(), values.end());
  double total = 0, sum = 0;
  for (const auto& [value, weight] : values) total += weight;
  for (const auto& [value, weight] : values) {
    sum += weight;
    if (2 * sum >= total) return value;
  }
  return 0;
}

void collect(const std::vector<RidgePoint>& points, const FrameVector<Strand>& strands,
             bool along_rows, Memory memory, Candidates& candidates) {
  FrameVector<Candidate> sorted(memory);
  int lines = 0;
  for (int c = 0; c < static_cast<int>(strands.size()); ++c)
    for (const int i : strands[c].points) {
      const RidgePoint& p = points[i];
      Candidate candidate{};
      candidate.point = i;
      candidate.strand = c;
      candidate.reflection = strands[c].reflection;
      candidate.line = along_rows ? p.row : p.column;
      candidate.along = along_rows ? p.v : p.u;
      candidate.across = along_rows ? p.u : p.v;
      const float normal_along = along_rows ? p.normal_v : p.normal_u;
      const float normal_across = along_rows ? p.normal_u : p.normal_v;
      candidate.slope = std::abs(normal_across) > 0.05f ? -normal_along / normal_across : 0;
      candidate.slope = std::clamp(candidate.slope, -kSteepest, kSteepest);
      candidate.curvature = p.curvature;
      lines = std::max(lines, candidate.line + 1);
      sorted.push_back(candidate);
    }
  std::sort(sorted.begin(), sorted.end(), [](const Candidate& a, const Candidate& b) {
    if (a.line != b.line) return a.line < b.line;
    return a.curvature != b.curvature ? a.curvature > b.curvature : a.point < b.point;
  });
  auto& [all, line_begin] = candidates;
  all.clear();
  line_begin.assign(lines + 1, 0);
  int of_line = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    of_line = i > 0 && sorted[i].line == sorted[i - 1].line ? of_line + 1 : 0;
    if (of_line >= kMostOfLine) continue;
    all.push_back(sorted[i]);
    ++line_begin[sorted[i].line + 1];
  }
  for (int line = 0; line < lines; ++line) line_begin[line + 1] += line_begin[line];

  // A strand's first and last candidate along the image, whatever way it was followed.
  FrameVector<int> first(strands.size(), -1, memory), last(strands.size(), -1, memory);
  for (int i = 0; i < static_cast<int>(all.size()); ++i) {
    const int strand = all[i].strand;
    if (first[strand] < 0) first[strand] = i;
    last[strand] = i;
  }
  for (const int i : first)
    if (i >= 0) all[i].starts_strand = true;
  for (const int i : last)
    if (i >= 0) all[i].ends_strand = true;
}

void rate(const std::vector<float>& widths, Memory memory, std::vector<Candidate>& candidates) {
  FrameVector<Weighted> values(memory);
  for (const Candidate& c : candidates) values.push_back({c.curvature, c.curvature});
  const float usual_curvature = weighted_median(values);
  values.clear();
  for (const Candidate& c : candidates)
    if (widths[c.point] > 0)
      values.push_back({widths[c.point], std::min(c.curvature, usual_curvature)});
  const float usual_width = weighted_median(values);
  for (Candidate& c : candidates) {
    float likeness = 0.7f;
    if (widths[c.point] > 0) {
      float difference = std::log(widths[c.point] / usual_width);
      difference /= difference > 0                  ? kWider
                    : c.curvature > usual_curvature ? kNarrowerAndBright
                                                    : kNarrower;
      likeness = std::exp(-0.5f * difference * difference);
    }
    const float strength = std::sqrt(std::min(1.0f, c.curvature / usual_curvature));
    c.worth = c.reflection ? -0.1f : strength * likeness - 0.1f;
  }
}

}  // namespace

void collect_candidates(const std::vector<RidgePoint>& points, const FrameVector<Strand>& strands,
                        const std::vector<float>& widths, bool along_rows, Memory memory,
                        Candidates& candidates) {
  collect(points, strands, along_rows, memory, candidates);
  rate(widths, memory, candidates.all);
}

}  // namespace arcstart
