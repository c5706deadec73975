// Medians and quantiles against std::sort, with each convention's place written out in integers.
#include "common/order_statistics.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace arcstart;

TEST_CASE("a quantile is the value at its place in the sorted list") {
  std::mt19937 engine(3);
  std::uniform_int_distribution<int> value(-40, 40);  // some of them equal
  for (std::size_t count = 1; count < 130; ++count) {
    std::vector<double> values(count);
    for (double& one : values) one = value(engine);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    CAPTURE(count);
    CHECK(quantile(values, 0) == sorted.front());
    CHECK(quantile(values, 0.5) == sorted[(count - 1) / 2]);
    CHECK(quantile(values, 0.75) == sorted[3 * (count - 1) / 4]);
    CHECK(quantile(values, 0.9) == sorted[9 * (count - 1) / 10]);
    CHECK(quantile(values, 1) == sorted.back());
    CHECK(upper_quantile(values, 0.75) == sorted[3 * count / 4]);
    CHECK(upper_quantile(values, 0.9) == sorted[9 * count / 10]);
    CHECK(median(values) == sorted[count / 2]);
    std::sort(values.begin(), values.end());
    CHECK(values == sorted);
  }
}

TEST_CASE("of an even number of values the median is the upper of the two in the middle") {
  std::vector<float> values = {4, 1, 3, 2};
  CHECK(median(values) == 3);
  CHECK(quantile(values, 0.5) == 2);
}

TEST_CASE("a quantile of no values is 0") {
  std::vector<double> none;
  CHECK(quantile(none, 0.9) == 0);
  CHECK(upper_quantile(none, 0.9) == 0);
  CHECK(median(none) == 0);
}
