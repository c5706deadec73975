#include "services/extraction/lines/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace arcstart::extraction {
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
  const auto line_of = [&](const RidgePoint& p) { return along_rows ? p.row : p.column; };
  int lines = 0;
  for (const Strand& strand : strands)
    for (const int i : strand.points) lines = std::max(lines, line_of(points[i]) + 1);
  struct Strong {
    int point, strand;
    float curvature;
    bool operator<(const Strong& other) const {  // is the better one
      return curvature != other.curvature ? curvature > other.curvature : point < other.point;
    }
  };
  // The strongest of each line, sorted.
  FrameVector<std::array<Strong, kMostOfLine>> strongest(lines, memory);
  FrameVector<int> of_line(lines, 0, memory);
  for (int s = 0; s < static_cast<int>(strands.size()); ++s)
    for (const int i : strands[s].points) {
      const int line = line_of(points[i]);
      const Strong here{i, s, points[i].curvature};
      auto& best = strongest[line];
      int at = of_line[line];
      if (at < kMostOfLine)
        ++of_line[line];
      else if (!(here < best[--at]))
        continue;
      for (; at > 0 && here < best[at - 1]; --at) best[at] = best[at - 1];
      best[at] = here;
    }
  auto& [all, line_begin] = candidates;
  all.clear();
  line_begin.assign(1, 0);
  for (int line = 0; line < lines; ++line) {
    for (int k = 0; k < of_line[line]; ++k) {
      const auto& [i, strand, curvature] = strongest[line][k];
      const RidgePoint& p = points[i];
      Candidate candidate{};
      candidate.point = i;
      candidate.strand = strand;
      candidate.reflection = strands[strand].reflection;
      candidate.line = line;
      candidate.along = along_rows ? p.v : p.u;
      candidate.across = along_rows ? p.u : p.v;
      const float normal_along = along_rows ? p.normal_v : p.normal_u;
      const float normal_across = along_rows ? p.normal_u : p.normal_v;
      candidate.slope = std::abs(normal_across) > 0.05f ? -normal_along / normal_across : 0;
      candidate.slope = std::clamp(candidate.slope, -kSteepest, kSteepest);
      candidate.curvature = curvature;
      all.push_back(candidate);
    }
    line_begin.push_back(static_cast<int>(all.size()));
  }

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

}  // namespace arcstart::extraction
