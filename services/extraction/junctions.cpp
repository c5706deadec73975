#include "services/extraction/junctions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory_resource>

namespace arcstart {
namespace {

// px along the image between strands that follow on each other.
constexpr float kStep = 5;

// Where in its chain each point stands.
struct Place {
  int chain = -1, position = -1;
};

// An end of one chain lies at a point of another.
struct Meeting {
  int end, point;
};

// A chain's end, seen on from it: lines that leave a corner at a small angle are told apart only
// some way from it.
struct Outlook {
  float u, v, du, dv, reach;

  Outlook(const std::vector<RidgePoint>& points, const Chain& chain, bool last, double reach_px)
      : reach(static_cast<float>(reach_px)) {
    const int size = static_cast<int>(chain.size()), step = std::min(10, size - 1);
    const RidgePoint& tip = points[last ? chain.back() : chain.front()];
    const RidgePoint& inner = points[last ? chain[size - 1 - step] : chain[step]];
    const float length = std::max(1e-3f, std::hypot(tip.u - inner.u, tip.v - inner.v));
    u = tip.u;
    v = tip.v;
    du = (tip.u - inner.u) / length;
    dv = (tip.v - inner.v) / length;
  }
  // From the stretch of four times the reach before the end.
  float distance(const RidgePoint& p) const {
    const float along = std::clamp((p.u - u) * du + (p.v - v) * dv, 0.0f, 4 * reach);
    return std::hypot(p.u - u - along * du, p.v - v - along * dv);
  }
  float lowest_v() const { return std::min(v, v + 4 * reach * dv) - reach; }
  float highest_v() const { return std::max(v, v + 4 * reach * dv) + reach; }
};

// For each end, the first point of each other chain that it runs into.
void find_meetings(const std::vector<RidgePoint>& points, const FrameVector<Place>& places,
                   const Chain& chain, bool last, double reach, FrameVector<Meeting>& meetings) {
  const Outlook outlook(points, chain, last, reach);
  const int end = last ? chain.back() : chain.front();
  // Chain to point.
  std::pmr::map<int, int> nearest(meetings.get_allocator().resource());
  auto at = std::lower_bound(points.begin(), points.end(),
                             static_cast<int>(std::floor(outlook.lowest_v())),
                             [](const RidgePoint& p, int row) { return p.row < row; });
  const auto from_end = [&](const RidgePoint& p) {
    return std::hypot(p.u - outlook.u, p.v - outlook.v);
  };
  for (; at != points.end() && static_cast<float>(at->row) <= outlook.highest_v(); ++at) {
    const auto i = static_cast<int>(at - points.begin());
    if (places[i].chain < 0 || places[i].chain == places[end].chain ||
        outlook.distance(*at) > outlook.reach)
      continue;
    const auto [entry, is_new] = nearest.try_emplace(places[i].chain, i);
    if (!is_new && from_end(*at) < from_end(points[entry->second])) entry->second = i;
  }
  for (const auto& [other, point] : nearest) meetings.push_back({end, point});
}

// Ends that meet share a junction, also by way of others.
void name_junctions(const FrameVector<Place>& places, const FrameVector<Meeting>& meetings,
                    int near, FrameVector<Strand>& strands) {
  int count = 0;
  for (const Meeting& meeting : meetings) {
    int name = -1;
    const auto join = [&](int& junction) {
      if (name < 0) name = junction >= 0 ? junction : count++;
      if (junction >= 0 && junction != name)
        for (Strand& other : strands)
          for (int& old : other.junction)
            if (old == junction && &old != &junction) old = name;
      junction = name;
    };
    for (Strand& strand : strands)
      for (int side = 0; side < 2; ++side) {
        const int tip = side == 0 ? strand.points.front() : strand.points.back();
        const Place &at = places[tip], &met = places[meeting.point];
        if (tip == meeting.end ||
            (at.chain == met.chain && std::abs(at.position - met.position) <= near))
          join(strand.junction[side]);
      }
  }
}

// Ends from which the stripe goes on elsewhere: at a junction, where another strand begins in the
// same columns that goes on the same way (a step in the profile), or at the first or last column
// where anything is seen.
void find_ends_that_lead_on(const std::vector<RidgePoint>& points, const Sight& sight,
                            FrameVector<Strand>& strands) {
  struct End {
    int strand, side;
    float at;       // column, or row
    float inwards;  // to the strand's other end; px
  };
  FrameVector<End> ends(strands.get_allocator().resource());
  for (int s = 0; s < static_cast<int>(strands.size()); ++s) {
    const RidgePoint &first = points[strands[s].points.front()],
                     &last = points[strands[s].points.back()];
    const float a = sight.along_rows ? first.v : first.u, b = sight.along_rows ? last.v : last.u;
    ends.push_back({s, 0, a, b - a});
    ends.push_back({s, 1, b, a - b});
  }
  for (const End& end : ends) {
    const bool out_of_sight = end.at < static_cast<float>(sight.first) + kStep ||
                              end.at > static_cast<float>(sight.last) - kStep;
    const bool steps = std::any_of(ends.begin(), ends.end(), [&](const End& other) {
      return other.strand != end.strand && std::abs(other.at - end.at) <= kStep &&
             std::abs(other.inwards) >= Strand::kLeastWay &&
             (other.inwards > 0) != (end.inwards > 0);
    });
    strands[end.strand].leads_on[end.side] =
        out_of_sight || steps || strands[end.strand].junction[end.side] >= 0;
  }
}

}  // namespace

FrameVector<Strand> cut_at_junctions(const std::vector<RidgePoint>& points,
                                     const std::vector<Chain>& chains, const Sight& sight,
                                     double reach, Memory memory) {
  FrameVector<Place> places(points.size(), memory);
  for (int c = 0; c < static_cast<int>(chains.size()); ++c)
    for (int i = 0; i < static_cast<int>(chains[c].size()); ++i) places[chains[c][i]] = {c, i};
  FrameVector<Meeting> meetings(memory);
  for (const Chain& chain : chains)
    for (const bool last : {false, true})
      find_meetings(points, places, chain, last, reach, meetings);
  FrameVector<FrameVector<int>> cuts(chains.size(), memory);
  for (const Meeting& meeting : meetings)
    cuts[places[meeting.point].chain].push_back(places[meeting.point].position);

  FrameVector<Strand> strands(memory);
  const int near = 2 * static_cast<int>(std::ceil(reach));
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const Chain& chain = chains[c];
    const int size = static_cast<int>(chain.size());
    std::sort(cuts[c].begin(), cuts[c].end());
    int begin = 0;
    const auto add = [&](int end) {
      strands.push_back({Chain(chain.begin() + begin, chain.begin() + end, memory)});
      begin = end;
    };
    for (const int cut : cuts[c])  // not so near to an end or another cut that only scraps come off
      if (cut - begin >= near && size - cut >= near) add(cut);
    add(size);
  }
  name_junctions(places, meetings, near, strands);
  if (!strands.empty()) find_ends_that_lead_on(points, sight, strands);
  return strands;
}

}  // namespace arcstart
