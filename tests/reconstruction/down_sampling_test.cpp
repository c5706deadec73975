#include "services/reconstruction/down_sampling.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace arcstart;

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
        CHECK(kept[next].segment_end == (number == 0 || number == last));
        ++next;
      }
    }
    CHECK(next == kept.size());
  }
}

TEST_CASE("M = 1 keeps all, and nothing gives nothing") {
  CHECK(down_sample(stripe({100, 3}), 1).size() == 103);
  CHECK(down_sample({}, 15).empty());
}
