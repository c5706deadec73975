#include "services/extraction/lines/reflections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory_resource>

namespace arcstart::extraction {
namespace {

// Times.
constexpr float kStronger = 1.7f;
// What times as much of its strength a reflection loses on its way from the corner: it spreads.
constexpr float kFades = 1.5f;
// Share of a hanging line's strength that one which leads on has at least, to be the stripe.
constexpr float kFaintest = 0.45f;
// px; nearer points of a column belong to one stripe.
constexpr float kBeside = 4;
// Points from a corner on that may belong to either line, and up to which strengths are compared.
constexpr int kCorner = 5, kNear = 40;
// Points of a strand that half must lie beside a stronger one, where it has fewer.
constexpr int kEvidence = 80;

// A strand as it leaves a junction.
struct Leaving {
  int strand;
  bool forward;     // towards larger columns (rows where along_rows)
  float near, far;  // columns (rows) of its end at the junction, and of its other one; px
  float way;        // how far it leads; px
  float strength;   // mean curvature near the junction
  float fade;       // that, by what it is at the strand's other end
};

Leaving leave(const std::vector<RidgePoint>& points, const Sight& sight,
              const FrameVector<Strand>& strands, int index, int side) {
  const Chain& chain = strands[index].points;
  const int size = static_cast<int>(chain.size());
  const auto from_junction = [&](int i) -> const RidgePoint& {
    return points[chain[side == 0 ? i : size - 1 - i]];
  };
  const auto mean_of = [&](int begin, int end) {
    double sum = 0;
    for (int i = begin; i < end; ++i) sum += from_junction(i).curvature;
    return static_cast<float>(sum / (end - begin));
  };
  const int begin = std::min(kCorner, size - 1);
  const float strength = mean_of(begin, std::min(kNear, size));
  const int far_end = std::max(begin + 1, size - kCorner);
  const float far_strength = mean_of(std::max(begin, far_end - kNear), far_end);
  const RidgePoint &near = from_junction(0), &far = from_junction(size - 1);
  const float from = sight.along_rows ? near.v : near.u, to = sight.along_rows ? far.v : far.u;
  return {index, to > from, from, to, std::abs(to - from), strength, strength / far_strength};
}

void mark_at_corners(const std::vector<RidgePoint>& points, const Sight& sight,
                     FrameVector<Strand>& strands) {
  std::pmr::map<int, FrameVector<Leaving>> junctions(strands.get_allocator().resource());
  for (int s = 0; s < static_cast<int>(strands.size()); ++s)
    for (int side = 0; side < 2; ++side)
      if (const int junction = strands[s].junction[side];
          junction >= 0 && junction != strands[s].junction[1 - side])
        junctions[junction].push_back(leave(points, sight, strands, s, side));
  for (auto& [junction, leaving] : junctions)
    std::sort(leaving.begin(), leaving.end(),
              [](const Leaving& a, const Leaving& b) { return a.strength > b.strength; });
  FrameVector<const Leaving*> stripes(strands.get_allocator().resource());
  for (const bool by_strength : {false, true})
    for (const auto& [junction, leaving] : junctions)
      for (const bool forward : {false, true}) {
        const auto concerns = [&](const Leaving& one) {
          return one.forward == forward && one.way >= sight.least_way;
        };
        // What outdoes one that outdoes another outdoes that, too: in which order they are marked
        // does not matter.
        const auto may_be_stripe = [&](const Leaving& one) {
          const Strand& strand = strands[one.strand];
          return concerns(one) && !strand.reflection && (by_strength || !strand.hangs());
        };
        stripes.clear();
        for (const Leaving& one : leaving)
          if (may_be_stripe(one)) stripes.push_back(&one);
        // The tip of the stripe beside a step in the profile leads on to what begins there: that is
        // not its reflection.
        const auto strongest_beside = [&](const Leaving& one) {
          for (const Leaving* stripe : stripes)
            if (std::abs(stripe->far - one.near) > Strand::kStep) return stripe->strength;
          return 0.0f;
        };
        float least_fade = std::numeric_limits<float>::infinity();  // of those that are stronger
        auto stronger = leaving.begin();
        for (const Leaving& one : leaving) {
          for (; stronger->strength > one.strength; ++stronger)
            if (may_be_stripe(*stronger)) least_fade = std::min(least_fade, stronger->fade);
          if (!concerns(one) || !strands[one.strand].hangs()) continue;
          const float strongest = strongest_beside(one);
          if (by_strength ? strongest > kStronger * one.strength || one.fade > kFades * least_fade
                          : strongest > kFaintest * one.strength)
            strands[one.strand].reflection = true;
        }
      }
}

void mark_beside(const std::vector<RidgePoint>& points, const Sight& sight,
                 FrameVector<Strand>& strands) {
  struct Seen {
    int line, strand;  // line: column, or row
    float across, curvature;
    bool reflection;
  };
  const Memory memory = strands.get_allocator().resource();
  FrameVector<Seen> seen(memory);
  for (int s = 0; s < static_cast<int>(strands.size()); ++s)
    for (const int i : strands[s].points) {
      const RidgePoint& p = points[i];
      seen.push_back({sight.along_rows ? p.row : p.column, s, sight.along_rows ? p.u : p.v,
                      p.curvature, strands[s].reflection});
    }
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.line != b.line ? a.line < b.line : a.curvature > b.curvature;
  });
  FrameVector<int> outshone(strands.size(), 0, memory);
  // Of those in a line that are stronger by far, how far up and down they lie.
  std::size_t next = 0;
  float lowest = 0, highest = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Seen& a = seen[i];
    if (i == 0 || a.line != seen[i - 1].line) {
      next = i;
      lowest = std::numeric_limits<float>::max();
      highest = std::numeric_limits<float>::lowest();
    }
    for (; seen[next].curvature > kStronger * a.curvature; ++next)
      if (!seen[next].reflection) {
        lowest = std::min(lowest, seen[next].across);
        highest = std::max(highest, seen[next].across);
      }
    outshone[a.strand] += highest - a.across > kBeside || a.across - lowest > kBeside;
  }
  for (std::size_t s = 0; s < strands.size(); ++s)
    if (strands[s].hangs() &&
        2 * outshone[s] > std::max(static_cast<int>(strands[s].points.size()), kEvidence))
      strands[s].reflection = true;
}

}  // namespace

void mark_reflections(const std::vector<RidgePoint>& points, const Sight& sight,
                      FrameVector<Strand>& strands) {
  mark_at_corners(points, sight, strands);
  mark_beside(points, sight, strands);
}

}  // namespace arcstart::extraction
