#include "services/extraction/lines/junctions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "services/extraction/lines/chain_contacts.hpp"

namespace arcstart::extraction {
namespace {

// Ends of strands, 2 * strand + side, that share a junction.
class Junctions {
 public:
  Junctions(std::size_t strands, Memory memory)
      : parent_(2 * strands, memory), name_(2 * strands, -1, memory) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int name_of(int end) { return name_[root_of(end)]; }  // -1 for none

  // All of one junction from now on, which keeps the first one's name.
  void join(const FrameVector<int>& ends) {
    if (ends.empty()) return;
    const int first = root_of(ends.front());
    if (name_[first] < 0) name_[first] = count_++;
    for (const int end : ends) parent_[root_of(end)] = first;
  }

 private:
  int root_of(int end) {
    while (parent_[end] != end) end = parent_[end] = parent_[parent_[end]];
    return end;
  }
  FrameVector<int> parent_, name_;
  int count_ = 0;
};

// Ends that meet share a junction, also by way of others. first_strand: of each chain, and the end.
void name_junctions(const FrameVector<ChainPlace>& places,
                    const FrameVector<ChainContact>& meetings, const FrameVector<int>& first_strand,
                    int near, FrameVector<Strand>& strands) {
  const Memory memory = strands.get_allocator().resource();
  Junctions junctions(strands.size(), memory);
  FrameVector<int> ends(memory);
  const auto position = [&](int strand, int side) {
    const Chain& points = strands[strand].points;
    return places[side == 0 ? points.front() : points.back()].position;
  };
  // Ends of a chain's strands that lie no farther than so many points from one of its.
  const auto add_ends = [&](const ChainPlace& place, int reach) {
    const auto chain_begin = strands.begin() + first_strand[place.chain],
               chain_end = strands.begin() + first_strand[place.chain + 1];
    const auto first = std::partition_point(chain_begin, chain_end, [&](const Strand& strand) {
      return places[strand.points.back()].position < place.position - reach;
    });
    for (int s = static_cast<int>(first - strands.begin());
         s < first_strand[place.chain + 1] && position(s, 0) <= place.position + reach; ++s)
      for (const int side : {0, 1})
        if (std::abs(position(s, side) - place.position) <= reach) ends.push_back(2 * s + side);
  };
  for (const ChainContact& meeting : meetings) {
    const ChainPlace &end = places[meeting.end], &met = places[meeting.point];
    ends.clear();
    if (end.chain < met.chain) add_ends(end, 0);
    add_ends(met, near);
    if (end.chain > met.chain) add_ends(end, 0);
    junctions.join(ends);
  }
  for (int s = 0; s < static_cast<int>(strands.size()); ++s)
    for (const int side : {0, 1}) strands[s].junction[side] = junctions.name_of(2 * s + side);
}

// Ends from which the stripe goes on elsewhere: at a junction, where another strand begins in the
// same columns that goes on the same way (a step in the profile), or at the first or last column
// where anything is seen.
void find_ends_that_lead_on(const std::vector<RidgePoint>& points, const Sight& sight,
                            FrameVector<Strand>& strands) {
  const Memory memory = strands.get_allocator().resource();
  const auto place = [&](const Strand& strand, int side) {  // column, or row
    const RidgePoint& tip = points[side == 0 ? strand.points.front() : strand.points.back()];
    return sight.along_rows ? tip.v : tip.u;
  };
  // Where strands end that lead towards smaller columns from there, and towards larger ones.
  std::array<FrameVector<float>, 2> ends{FrameVector<float>(memory), FrameVector<float>(memory)};
  for (const Strand& strand : strands)
    for (const int side : {0, 1}) {
      const float at = place(strand, side), inwards = place(strand, 1 - side) - at;
      if (std::abs(inwards) >= sight.least_way) ends[inwards > 0].push_back(at);
    }
  for (FrameVector<float>& places : ends) std::sort(places.begin(), places.end());
  for (Strand& strand : strands)
    for (const int side : {0, 1}) {
      const float at = place(strand, side), inwards = place(strand, 1 - side) - at;
      const bool out_of_sight = at < static_cast<float>(sight.first) + Strand::kStep ||
                                at > static_cast<float>(sight.last) - Strand::kStep;
      const FrameVector<float>& others = ends[!(inwards > 0)];
      const auto near = std::partition_point(
          others.begin(), others.end(), [&](float other) { return other - at < -Strand::kStep; });
      const bool steps = near != others.end() && *near - at <= Strand::kStep;
      strand.leads_on[side] = out_of_sight || steps || strand.junction[side] >= 0;
    }
}

}  // namespace

FrameVector<Strand> cut_at_junctions(const std::vector<RidgePoint>& points,
                                     const std::vector<Chain>& chains, const Sight& sight,
                                     double reach, Memory memory) {
  FrameVector<ChainPlace> places(points.size(), memory);
  for (int c = 0; c < static_cast<int>(chains.size()); ++c)
    for (int i = 0; i < static_cast<int>(chains[c].size()); ++i) places[chains[c][i]] = {c, i};
  const FrameVector<ChainContact> meetings = find_contacts(points, chains, places, reach, memory);
  FrameVector<FrameVector<int>> cuts(chains.size(), memory);
  for (const ChainContact& meeting : meetings)
    cuts[places[meeting.point].chain].push_back(places[meeting.point].position);

  FrameVector<Strand> strands(memory);
  FrameVector<int> first_strand(memory);
  const int near = 2 * static_cast<int>(std::ceil(reach));
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const Chain& chain = chains[c];
    const int size = static_cast<int>(chain.size());
    first_strand.push_back(static_cast<int>(strands.size()));
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
  first_strand.push_back(static_cast<int>(strands.size()));
  name_junctions(places, meetings, first_strand, near, strands);
  find_ends_that_lead_on(points, sight, strands);
  return strands;
}

}  // namespace arcstart::extraction
