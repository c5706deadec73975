// Chains that meet, and reflections, beside the rules written down one pair after the other.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "services/extraction/lines/reflections.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

constexpr double kReach = 6;
constexpr int kNear = 12;  // points; scraps are shorter

// Straight lines that begin anywhere, lead anywhere, and cross: a point a pixel, in raster order.
struct Lines {
  std::vector<RidgePoint> points;
  std::vector<Chain> chains;

  Lines(int count, int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    const auto one_of = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<std::pair<RidgePoint, int>> all;  // with their line
    for (int line = 0; line < count; ++line) {
      const double u = one_of(0, width), v = one_of(0, height), angle = one_of(0, 6.28);
      // Few strengths, so that there are equal ones.
      const auto strength = static_cast<float>(std::floor(one_of(1, 6)));
      const double du = std::cos(angle), dv = std::sin(angle), length = one_of(10, 120);
      const double fade = one_of(0, 0.8) * (one_of(0, 1) < 0.5 ? 1 : 0);
      for (int k = 0; k < length; ++k) {
        const double at_u = u + k * du, at_v = v + k * dv;
        if (std::min(at_u, at_v) < 0) break;
        all.push_back(
            {{static_cast<float>(at_u), static_cast<float>(at_v), static_cast<float>(-dv),
              static_cast<float>(du), strength * static_cast<float>(1 - fade * k / length),
              static_cast<int>(std::lround(at_u)), static_cast<int>(std::lround(at_v))},
             line});
      }
    }
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(all[a].first.row, all[a].first.column) <
             std::pair(all[b].first.row, all[b].first.column);
    });
    std::vector<int> place(all.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      place[order[k]] = static_cast<int>(k);
      points.push_back(all[order[k]].first);
    }
    chains.resize(count);
    for (std::size_t i = 0; i < all.size(); ++i) chains[all[i].second].push_back(place[i]);
    std::erase_if(chains, [](const Chain& chain) { return chain.size() < 3; });
  }
};

// The point of the other chain that an end runs into.
std::optional<std::size_t> meets(const Lines& lines, const Chain& chain, bool last,
                                 const Chain& other) {
  const std::size_t step = std::min<std::size_t>(10, chain.size() - 1);
  const RidgePoint& tip = lines.points[last ? chain.back() : chain.front()];
  const RidgePoint& inner = lines.points[last ? chain[chain.size() - 1 - step] : chain[step]];
  const double length = std::hypot(tip.u - inner.u, tip.v - inner.v);
  const double du = (tip.u - inner.u) / length, dv = (tip.v - inner.v) / length;
  std::optional<std::size_t> nearest;
  double lowest = 0;
  for (std::size_t k = 0; k < other.size(); ++k) {
    const RidgePoint& p = lines.points[other[k]];
    const double u = p.u - tip.u, v = p.v - tip.v, distance = std::hypot(u, v);
    const double along = std::clamp(u * du + v * dv, 0.0, 4 * kReach);
    if (std::hypot(u - along * du, v - along * dv) > kReach) continue;
    // Where only part of its pixel is in reach, a point at the lower edge does not count.
    if (p.row > tip.v + std::max(0.0, 4 * kReach * dv) + kReach) continue;
    if (nearest && distance >= lowest) continue;
    nearest = k;
    lowest = distance;
  }
  return nearest;
}

struct PlainStrand {
  std::size_t chain, begin, end;  // points of the chain
  int junction[2] = {-1, -1};
  bool leads_on[2] = {};
};

std::vector<PlainStrand> plain_strands(const Lines& lines, const Sight& sight) {
  struct PlainMeeting {
    std::size_t chain;
    bool last;
    std::size_t other, at;
  };
  std::vector<PlainMeeting> meetings;
  std::vector<std::vector<std::size_t>> cuts(lines.chains.size());
  for (std::size_t c = 0; c < lines.chains.size(); ++c)
    for (const bool last : {false, true})
      for (std::size_t other = 0; other < lines.chains.size(); ++other)
        if (other != c)
          if (const auto at = meets(lines, lines.chains[c], last, lines.chains[other])) {
            meetings.push_back({c, last, other, *at});
            cuts[other].push_back(*at);
          }
  std::vector<PlainStrand> strands;
  for (std::size_t c = 0; c < lines.chains.size(); ++c) {
    std::sort(cuts[c].begin(), cuts[c].end());
    std::size_t begin = 0;
    for (const std::size_t cut : cuts[c])
      if (cut >= begin + kNear && lines.chains[c].size() >= cut + kNear) {
        strands.push_back({c, begin, cut});
        begin = cut;
      }
    strands.push_back({c, begin, lines.chains[c].size()});
  }
  for (std::size_t m = 0; m < meetings.size(); ++m) {
    const PlainMeeting& meeting = meetings[m];
    for (PlainStrand& strand : strands)
      for (int side = 0; side < 2; ++side) {
        const std::size_t tip = side == 0 ? strand.begin : strand.end - 1;
        const bool is_end =
            strand.chain == meeting.chain &&
            tip == (meeting.last ? lines.chains[meeting.chain].size() - 1 : std::size_t{0});
        const bool is_near =
            strand.chain == meeting.other &&
            std::abs(static_cast<double>(tip) - static_cast<double>(meeting.at)) <= kNear;
        if (!is_end && !is_near) continue;
        const int old = strand.junction[side], name = static_cast<int>(m);
        strand.junction[side] = name;
        if (old < 0) continue;
        for (PlainStrand& another : strands)
          for (int& junction : another.junction)
            if (junction == old) junction = name;
      }
  }
  const auto place = [&](const PlainStrand& strand, int side) {
    const RidgePoint& p =
        lines.points[lines.chains[strand.chain][side == 0 ? strand.begin : strand.end - 1]];
    return sight.along_rows ? p.v : p.u;
  };
  for (PlainStrand& strand : strands)
    for (int side = 0; side < 2; ++side) {
      const float at = place(strand, side), way = place(strand, 1 - side) - at;
      strand.leads_on[side] = strand.junction[side] >= 0 ||
                              at < static_cast<float>(sight.first) + 5 ||
                              at > static_cast<float>(sight.last) - 5;
      for (const PlainStrand& other : strands)
        for (int end = 0; end < 2; ++end) {
          const float other_at = place(other, end), other_way = place(other, 1 - end) - other_at;
          strand.leads_on[side] |= &other != &strand && std::abs(other_at - at) <= 5 &&
                                   std::abs(other_way) >= sight.least_way &&
                                   (other_way > 0) != (way > 0);
        }
    }
  return strands;
}

// What lies beside a point of another strand that is stronger by far, more than 4 px away in the
// same line.
bool is_outshone(const std::vector<RidgePoint>& points, const Sight& sight,
                 const FrameVector<Strand>& strands, const std::vector<bool>& reflections,
                 const RidgePoint& p) {
  for (std::size_t s = 0; s < strands.size(); ++s)
    if (!reflections[s])
      for (const int i : strands[s].points) {
        const RidgePoint& q = points[i];
        const bool same_line = sight.along_rows ? q.row == p.row : q.column == p.column;
        const float beside = sight.along_rows ? q.u - p.u : q.v - p.v;
        if (same_line && q.curvature > 1.7f * p.curvature && std::abs(beside) > 4) return true;
      }
  return false;
}

// How a strand leaves one of its ends, as the marking of reflections sees it.
struct Way {
  bool forward;
  float near, far, length, strength, fade;  // near, far: columns or rows of its ends
};
Way way_from(const std::vector<RidgePoint>& points, const Sight& sight, const Strand& strand,
             int side) {
  const auto size = static_cast<int>(strand.points.size());
  const auto point = [&](int i) { return points[strand.points[side == 0 ? i : size - 1 - i]]; };
  const auto mean = [&](int begin, int end) {
    double sum = 0;
    for (int i = begin; i < end; ++i) sum += point(i).curvature;
    return static_cast<float>(sum / (end - begin));
  };
  // Without five points at either end, of 40 at most.
  const int begin = std::min(5, size - 1), end = std::max(begin + 1, size - 5);
  const float strength = mean(begin, std::min(40, size)),
              at_far_end = mean(std::max(begin, end - 40), end);
  const auto place = [&](int i) { return sight.along_rows ? point(i).v : point(i).u; };
  const float near = place(0), far = place(size - 1);
  return {far > near, near, far, std::abs(far - near), strength, strength / at_far_end};
}

std::vector<bool> plain_reflections(const std::vector<RidgePoint>& points, const Sight& sight,
                                    const FrameVector<Strand>& strands) {
  std::vector<bool> marked(strands.size(), false);
  std::map<int, std::vector<std::pair<std::size_t, int>>> junctions;  // strand, side
  for (std::size_t s = 0; s < strands.size(); ++s)
    for (int side = 0; side < 2; ++side)
      if (strands[s].junction[side] >= 0 && strands[s].junction[0] != strands[s].junction[1])
        junctions[strands[s].junction[side]].push_back({s, side});
  for (const bool by_strength : {false, true})
    for (const auto& [junction, leaving] : junctions)
      for (const auto& [a, side_a] : leaving)
        for (const auto& [b, side_b] : leaving) {
          const Way suspect = way_from(points, sight, strands[a], side_a),
                    stripe = way_from(points, sight, strands[b], side_b);
          if (a == b || suspect.forward != stripe.forward || !strands[a].hangs() || marked[b] ||
              std::min(suspect.length, stripe.length) < sight.least_way)
            continue;
          const bool fades =
              stripe.strength > suspect.strength && suspect.fade > 1.5f * stripe.fade;
          const bool leads_to_it = std::abs(stripe.far - suspect.near) <= 5;
          if (by_strength ? (!leads_to_it && stripe.strength > 1.7f * suspect.strength) || fades
                          : !leads_to_it && !strands[b].hangs() &&
                                stripe.strength > 0.45f * suspect.strength)
            marked[a] = true;
        }
  const std::vector<bool> at_corners = marked;
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const auto outshone = std::count_if(
        strands[s].points.begin(), strands[s].points.end(),
        [&](int i) { return is_outshone(points, sight, strands, at_corners, points[i]); });
    if (strands[s].hangs() &&
        2 * outshone > std::max<std::ptrdiff_t>(std::ssize(strands[s].points), 80))
      marked[s] = true;
  }
  return marked;
}

}  // namespace

TEST_CASE("crowded lines are cut, joined and marked as the rules say") {
  const unsigned seed = GENERATE(range(1u, 9u));
  const int count = GENERATE(3, 20, 60);
  const bool along_rows = GENERATE(false, true);
  const Lines lines(count, 400, 300, seed);
  const Sight sight{along_rows, 0, along_rows ? 299 : 399};
  FrameVector<Strand> strands = cut_at_junctions(lines.points, lines.chains, sight, kReach);
  const std::vector<PlainStrand> plain = plain_strands(lines, sight);
  REQUIRE(strands.size() == plain.size());
  std::map<int, int> name_of;  // the plain junctions' names to the others'
  std::map<int, int> plain_of;
  for (std::size_t s = 0; s < plain.size(); ++s) {
    const Chain& chain = lines.chains[plain[s].chain];
    REQUIRE(std::equal(strands[s].points.begin(), strands[s].points.end(),
                       chain.begin() + static_cast<std::ptrdiff_t>(plain[s].begin),
                       chain.begin() + static_cast<std::ptrdiff_t>(plain[s].end)));
    for (int side = 0; side < 2; ++side) {
      const int junction = strands[s].junction[side], plain_junction = plain[s].junction[side];
      REQUIRE((junction < 0) == (plain_junction < 0));
      REQUIRE(name_of.try_emplace(plain_junction, junction).first->second == junction);
      REQUIRE(plain_of.try_emplace(junction, plain_junction).first->second == plain_junction);
      REQUIRE(strands[s].leads_on[side] == plain[s].leads_on[side]);
    }
  }
  if (count == 60) CHECK(name_of.size() > 3);

  mark_reflections(lines.points, sight, strands);
  FrameVector<Strand> unmarked = strands;
  for (Strand& strand : unmarked) strand.reflection = false;
  const std::vector<bool> reflections = plain_reflections(lines.points, sight, unmarked);
  for (std::size_t s = 0; s < strands.size(); ++s) REQUIRE(strands[s].reflection == reflections[s]);
  if (count == 60) CHECK(std::count(reflections.begin(), reflections.end(), true) > 0);
}
