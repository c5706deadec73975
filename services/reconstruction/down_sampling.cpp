#include "services/reconstruction/down_sampling.hpp"

namespace arcstart {

std::vector<ReceivedCentre> down_sample(const std::vector<ReceivedCentre>& centres,
                                        int keep_every) {
  std::vector<ReceivedCentre> kept;
  kept.reserve(centres.size() / static_cast<std::size_t>(keep_every) + 2);
  int number = 0;  // of the centre in its segment
  for (std::size_t i = 0; i < centres.size(); ++i, ++number) {
    const bool first = i == 0 || centres[i].segment != centres[i - 1].segment;
    const bool last = i + 1 == centres.size() || centres[i].segment != centres[i + 1].segment;
    if (first) number = 0;
    if (number % keep_every != 0 && !last) continue;
    kept.push_back(centres[i]);
    kept.back().segment_end = first || last;
  }
  return kept;
}

}  // namespace arcstart
