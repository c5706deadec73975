#include "services/extraction/lines/stripe_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcstart::extraction {
namespace {

// Worth and cost are in columns of clean stripe.
constexpr float kBreakCost = 24;       // to leave a line for any other place
constexpr int kOneLine = 4;            // columns within which a path goes on as on one line
constexpr float kLongestNearJump = 6;  // px
constexpr int kFar = 100;              // columns over which a line may be found again after a gap
constexpr float kGapCost = 4;          // to find it again there, at least
constexpr double kUsualReach = 6.25;   // of a junction, px, where the stripe is not narrow
constexpr float kSameLine = 4;         // px: nearer points of a column belong to one stripe

// By how much `to` lies off the line through both ends' slopes, px.
float offset_from_line(const Candidate& from, const Candidate& to) {
  return std::abs(to.across - from.across -
                  0.5f * (from.slope + to.slope) * (to.along - from.along));
}

}  // namespace

float Selector::leaving_cost(const Candidate& from, const Candidate& to) const {
  const float gap = to.along - from.along;
  const float offset = offset_from_line(from, to);
  if (to.line - from.line <= kOneLine) {
    if (offset > kLongestNearJump) return break_cost_;
    return 0.5f * std::max(0.0f, offset - 0.5f) +
           0.3f * static_cast<float>(to.line - from.line - 1);
  }
  // The same line found again beyond a gap.
  return std::min(break_cost_, kGapCost + 0.06f * gap + 6 * offset / (2 + 0.2f * gap));
}

FrameVector<int> Selector::best_path() const {
  const int count = candidates_.count();
  FrameVector<float> score(count, memory_);
  FrameVector<int> previous(count, -1, memory_), strand_ends(memory_);
  int best = -1;             // of all in the lines before
  std::size_t in_reach = 0;  // the first of strand_ends that is
  const int lines = candidates_.lines();
  for (int line = 0; line < lines; ++line) {
    while (in_reach < strand_ends.size() && candidates_[strand_ends[in_reach]].line < line - kFar)
      ++in_reach;
    for (int i = candidates_.line_begin[line]; i < candidates_.line_begin[line + 1]; ++i) {
      const Candidate& here = candidates_[i];
      float highest = 0;
      const auto consider = [&](int from, float cost) {
        if (score[from] - cost <= highest) return;
        highest = score[from] - cost;
        previous[i] = from;
      };
      for (int j = candidates_.line_begin[std::max(0, line - kOneLine)];
           j < candidates_.line_begin[line]; ++j)
        consider(j, leaving_cost(candidates_[j], here));
      if (here.starts_strand)
        for (std::size_t k = in_reach; k < strand_ends.size(); ++k)
          if (const int j = strand_ends[k];
              candidates_[j].line < line - kOneLine && score[j] - kGapCost > highest)
            consider(j, leaving_cost(candidates_[j], here));
      if (best >= 0) consider(best, break_cost_);
      score[i] = highest + here.worth;
    }
    for (int i = candidates_.line_begin[line]; i < candidates_.line_begin[line + 1]; ++i) {
      if (best < 0 || score[i] > score[best]) best = i;
      if (candidates_[i].ends_strand) strand_ends.push_back(i);
    }
  }
  FrameVector<int> path(memory_);
  if (best >= 0 && score[best] > 0)
    for (int i = best; i >= 0; i = previous[i]) path.push_back(i);
  std::reverse(path.begin(), path.end());
  return path;
}

bool Selector::changes_stripe(const Candidate& from, const Candidate& to) const {
  return from.strand != to.strand && to.line - from.line <= kOneLine &&
         offset_from_line(from, to) > kLongestNearJump;
}

FrameVector<int> Selector::rest_of_strand(int candidate, int step, int reach) const {
  const Candidate& from = candidates_[candidate];
  FrameVector<int> rest(memory_);
  float across = from.across;
  const int lines = candidates_.lines();
  for (int k = 1; k <= reach + 1; ++k) {
    const int line = from.line + step * k;
    if (line < 0 || line >= lines) break;
    int nearest = -1;
    for (int i = candidates_.line_begin[line]; i < candidates_.line_begin[line + 1]; ++i)
      if (candidates_[i].strand == from.strand &&
          (nearest < 0 || std::abs(candidates_[i].across - across) <
                              std::abs(candidates_[nearest].across - across)))
        nearest = i;
    if (nearest < 0) continue;
    if (k > reach) return FrameVector<int>(memory_);  // it does not end here
    rest.push_back(nearest);
    across = candidates_[nearest].across;
  }
  return rest;
}

void Selector::split_path(const FrameVector<int>& path, const StripePathSettings& settings,
                          StripePath& selection) {
  const int reach = static_cast<int>(settings.junction_reach);
  chosen_.assign(candidates_.lines(), -1);
  for (std::size_t begin = 0; begin < path.size();) {
    std::size_t end = begin + 1;
    while (end < path.size()) {
      const Candidate &from = candidates_[path[end - 1]], &to = candidates_[path[end]];
      if (to.line - from.line > settings.longest_hole || offset_from_line(from, to) > 3) break;
      ++end;
    }
    if (static_cast<int>(end - begin) >= settings.fewest_points) {
      Branch branch{FrameVector<int>(memory_)};
      if (begin > 0 && changes_stripe(candidates_[path[begin - 1]], candidates_[path[begin]])) {
        const FrameVector<int> before = rest_of_strand(path[begin], -1, reach);
        for (auto i = before.rbegin(); i != before.rend(); ++i)
          branch.points.push_back(candidates_[*i].point);
      }
      for (std::size_t i = begin; i < end; ++i) {
        branch.points.push_back(candidates_[path[i]].point);
        chosen_[candidates_[path[i]].line] = path[i];
      }
      if (end < path.size() && changes_stripe(candidates_[path[end - 1]], candidates_[path[end]]))
        for (const int i : rest_of_strand(path[end - 1], +1, reach))
          branch.points.push_back(candidates_[i].point);
      selection.branches.push_back(std::move(branch));
    }
    begin = end;
  }
}

void Selector::add_second_candidates(const StripePathSettings& settings, StripePath& selection) {
  FrameVector<std::pair<int, int>> seconds(memory_);  // strand, candidate
  for (std::size_t line = 0; line + 1 < candidates_.line_begin.size(); ++line)
    for (int i = candidates_.line_begin[line]; i < candidates_.line_begin[line + 1]; ++i) {
      if (i == chosen_[line]) continue;
      if (chosen_[line] >= 0 &&
          std::abs(candidates_[i].across - candidates_[chosen_[line]].across) <= kSameLine)
        continue;
      seconds.push_back({candidates_[i].strand, i});
      break;  // the strongest one only
    }
  std::sort(seconds.begin(), seconds.end());
  for (std::size_t begin = 0; begin < seconds.size();) {
    std::size_t end = begin + 1;
    while (end < seconds.size() && seconds[end].first == seconds[begin].first &&
           candidates_[seconds[end].second].line - candidates_[seconds[end - 1].second].line <=
               settings.longest_hole)
      ++end;
    if (static_cast<int>(end - begin) >= settings.fewest_points) {
      Branch branch{FrameVector<int>(memory_), false};
      for (std::size_t i = begin; i < end; ++i)
        branch.points.push_back(candidates_[seconds[i].second].point);
      selection.branches.push_back(std::move(branch));
    }
    begin = end;
  }
}

void Selector::select(const std::vector<RidgePoint>& points, const std::vector<Chain>& chains,
                      const std::vector<float>& widths, const StripePathSettings& settings,
                      StripePath& selection, Memory memory) {
  memory_ = memory;
  selection.branches.clear();
  double across_image = 0;  // of the tangents, weighted with the curvature: > 0 where they run
                            // along the columns' order
  for (const Chain& chain : chains)
    for (const int i : chain)
      across_image += points[i].curvature * (points[i].normal_v * points[i].normal_v -
                                             points[i].normal_u * points[i].normal_u);
  selection.along_rows = settings.along_rows.value_or(across_image < 0);
  const int lines = selection.along_rows ? settings.height : settings.width;
  Sight sight{selection.along_rows, settings.margin, lines - 1 - settings.margin};
  // A surface that is few pixels long in a coarse image is no scrap, nor less worth to go to.
  const double coarse = std::min(1.0, settings.junction_reach / kUsualReach);
  sight.least_way *= static_cast<float>(coarse);
  break_cost_ = static_cast<float>(coarse) * kBreakCost;
  FrameVector<Strand> strands =
      cut_at_junctions(points, chains, sight, settings.junction_reach, memory);
  mark_reflections(points, sight, strands);
  collect_candidates(points, strands, widths, selection.along_rows, memory, candidates_);
  split_path(best_path(), settings, selection);
  add_second_candidates(settings, selection);
}

}  // namespace arcstart::extraction
