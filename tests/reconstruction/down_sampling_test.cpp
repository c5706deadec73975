#include "services/reconstruction/down_sampling.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

using namespace arcstart;
using namespace arcstart::reconstruction;

namespace {

// Segments of these lengths; a centre's u is its number in the segment.
std::vector<ReceivedCentre> stripe(const std::vector<int>& lengths) {
  std::vector<ReceivedCentre> centres;
  for (std::size_t segment = 0; segment < lengths.size(); ++segment)
    for (int i = 0; i < lengths[segment]; ++i)
      centres.push_back({static_cast<float>(i), 0, 0, static_cast<std::int16_t>(segment)});
  return centres;
}

}  // namespace

TEST_CASE("every segment keeps its centres 0, M, 2M and so on, and its last") {
  const std::vector<int> lengths = {1, 2, 14, 15, 16, 17, 31, 100, 1600};
  for (const int keep_every : {1, 5, 15, 20}) {
    const auto kept = down_sample(stripe(lengths), keep_every);
    std::size_t next = 0;
    for (std::size_t segment = 0; segment < lengths.size(); ++segment) {
      const int last = lengths[segment] - 1;
      std::set<int> expected{last};
      for (int i = 0; i <= last; i += keep_every) expected.insert(i);
      for (const int number : expected) {
        REQUIRE(next < kept.size());
        CHECK(kept[next].segment == static_cast<int>(segment));
        CHECK(kept[next].u == number);
        CHECK((kept[next].segment_end != 0) == (number == 0 || number == last));
        ++next;
      }
    }
    CHECK(next == kept.size());
  }
}

TEST_CASE("a segment's ends keep extraction's reason, and nothing between them has one") {
  auto centres = stripe({40, 40});
  for (auto& centre : centres) centre.segment_end = 0;
  centres[0].segment_end = 3, centres[39].segment_end = 1;
  centres[20].segment_end = 4;  // which extraction never says
  const auto kept = down_sample(centres, 10);
  std::vector<int> ends;
  for (const auto& centre : kept) ends.push_back(centre.segment_end);
  // Of the second segment nobody said why: 2, a gap.
  CHECK(ends == std::vector<int>{3, 0, 0, 0, 1, 2, 0, 0, 0, 2});
}

TEST_CASE("M = 1 keeps all, and nothing gives nothing") {
  CHECK(down_sample(stripe({100, 3}), 1).size() == 103);
  CHECK(down_sample({}, 15).empty());
}

TEST_CASE("a notch narrower than M is kept where bends are, and a straight stripe stays thin") {
  auto centres = stripe({100});
  for (auto& centre : centres) centre.v = 500 - 0.3f * centre.u;
  CHECK(down_sample(centres, 15, 1).size() == down_sample(centres, 15).size());
  for (int i = 50; i <= 56; ++i) centres[i].v -= 4;  // a gap between two plates
  const auto kept = down_sample(centres, 15, 1);
  std::set<float> numbers;
  for (const auto& centre : kept) numbers.insert(centre.u);
  CHECK(numbers.size() == kept.size());
  CHECK(std::is_sorted(kept.begin(), kept.end(),
                       [](const auto& a, const auto& b) { return a.u < b.u; }));
  // Its four bends, and one on its floor, all of which lies equally far from the line.
  CHECK(numbers.size() <= down_sample(centres, 15).size() + 5);
  // No centre lies farther than a pixel from the line through those that are kept.
  for (std::size_t i = 1; i < kept.size(); ++i)
    for (const auto& centre : centres) {
      if (centre.u <= kept[i - 1].u || centre.u >= kept[i].u) continue;
      const double share = (centre.u - kept[i - 1].u) / (kept[i].u - kept[i - 1].u);
      CHECK(std::abs(centre.v - kept[i - 1].v - share * (kept[i].v - kept[i - 1].v)) < 1.1);
    }
}
