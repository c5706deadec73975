#include "services/reconstruction/down_sampling.hpp"

#include <cmath>

namespace arcstart::reconstruction {
namespace {

constexpr std::int8_t kGap = 2;  // profile_t.GAP: also where extraction did not say why it ends

// Appends those between two kept ones that the stripe bends at, in their order.
void keep_bends(const std::vector<ReceivedCentre>& centres, std::size_t first, std::size_t last,
                double bend_px, std::vector<ReceivedCentre>& kept) {
  const ReceivedCentre &a = centres[first], &b = centres[last];
  const double u = b.u - a.u, v = b.v - a.v, length = std::hypot(u, v);
  if (!(length > 0)) return;
  std::size_t farthest = first;
  double most = bend_px;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = std::abs((centres[i].u - a.u) * v - (centres[i].v - a.v) * u) / length;
    if (off > most) most = off, farthest = i;
  }
  if (farthest == first) return;
  keep_bends(centres, first, farthest, bend_px, kept);
  kept.push_back(centres[farthest]);
  kept.back().segment_end = 0;
  keep_bends(centres, farthest, last, bend_px, kept);
}

}  // namespace

std::vector<ReceivedCentre> down_sample(const std::vector<ReceivedCentre>& centres, int keep_every,
                                        double bend_px) {
  std::vector<ReceivedCentre> kept;
  kept.reserve(centres.size() / static_cast<std::size_t>(keep_every) + 2);
  int number = 0;          // of the centre in its segment
  std::size_t before = 0;  // the last that was kept for its number
  for (std::size_t i = 0; i < centres.size(); ++i, ++number) {
    const bool first = i == 0 || centres[i].segment != centres[i - 1].segment;
    const bool last = i + 1 == centres.size() || centres[i].segment != centres[i + 1].segment;
    if (first) number = 0;
    if (number % keep_every != 0 && !last) continue;
    if (bend_px > 0 && !first) keep_bends(centres, before, i, bend_px, kept);
    before = i;
    kept.push_back(centres[i]);
    std::int8_t& end = kept.back().segment_end;
    end = !first && !last ? 0 : end != 0 ? end : kGap;
  }
  return kept;
}

}  // namespace arcstart::reconstruction
