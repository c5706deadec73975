#include "services/extraction/reflections.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory_resource>

namespace arcstart {
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
  bool forward;    // towards larger columns (rows where along_rows)
  float way;       // how far it leads that way; px
  float strength;  // mean curvature near the junction
  float fade;      // that, by what it is at the strand's other end
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
  const float way = sight.along_rows ? far.v - near.v : far.u - near.u;
  return {index, way > 0, std::abs(way), strength, strength / far_strength};
}

void mark_at_corners(const std::vector<RidgePoint>& points, const Sight& sight,
                     FrameVector<Strand>& strands) {
  std::pmr::map<int, FrameVector<Leaving>> junctions(strands.get_allocator().resource());
  for (int s = 0; s < static_cast<int>(strands.size()); ++s)
    for (int side = 0; side < 2; ++side)
      if (const int junction = strands[s].junction[side];
          junction >= 0 && junction != strands[s].junction[1 - side])
        junctions[junction].push_back(leave(points, sight, strands, s, side));
  for (const bool by_strength : {false, true})
    for (const auto& [junction, leaving] : junctions)
      for (const Leaving& a : leaving)
        for (const Leaving& b : leaving) {
          Strand &suspect = strands[a.strand], &stripe = strands[b.strand];
          if (a.strand == b.strand || a.forward != b.forward || !suspect.hangs() ||
              stripe.reflection)
            continue;
          if (std::min(a.way, b.way) < Strand::kLeastWay) continue;
          const bool fades = b.strength > a.strength && a.fade > kFades * b.fade;
          if (by_strength ? b.strength > kStronger * a.strength || fades
                          : !stripe.hangs() && b.strength > kFaintest * a.strength)
            suspect.reflection = true;
        }
}

void mark_beside(const std::vector<RidgePoint>& points, const Sight& sight,
                 FrameVector<Strand>& strands) {
  struct Seen {
    int strand;
    float across, curvature;
  };
  const Memory memory = strands.get_allocator().resource();
  std::pmr::map<int, FrameVector<Seen>> lines(memory);  // columns, or rows
  for (int s = 0; s < static_cast<int>(strands.size()); ++s)
    for (const int i : strands[s].points)
      lines[sight.along_rows ? points[i].row : points[i].column].push_back(
          {s, sight.along_rows ? points[i].u : points[i].v, points[i].curvature});
  FrameVector<int> outshone(strands.size(), 0, memory);
  for (const auto& [line, seen] : lines)
    for (const Seen& a : seen)
      outshone[a.strand] += std::any_of(seen.begin(), seen.end(), [&](const Seen& b) {
        return b.curvature > kStronger * a.curvature && std::abs(b.across - a.across) > kBeside &&
               !strands[b.strand].reflection;
      });
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

}  // namespace arcstart
