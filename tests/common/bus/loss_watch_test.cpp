#include "common/bus/loss_watch.hpp"

#include <catch2/catch.hpp>

using namespace arcstart;

namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kNoon = 1'796'040'000 * kSecond;  // 2026-11-30 12:00:00 UTC

}  // namespace

TEST_CASE("what was lost keeps its count, its beginning and its reason while it is news") {
  LossWatch watch;
  watch.take(0, "slow", 0, kNoon);
  CHECK(watch.words().empty());
  watch.take(2, "stamp goes back", 5 * kSecond, kNoon + 5 * kSecond);
  CHECK(watch.words() == "2 inputs lost since 12:00:05 UTC (stamp goes back)");
  CHECK(watch.words("stamp goes back") == "2 inputs lost since 12:00:05 UTC");
  watch.take(3, "", 14 * kSecond, kNoon + 14 * kSecond);  // all is well again, and one more is lost
  CHECK(watch.words() == "3 inputs lost since 12:00:05 UTC (stamp goes back)");
  watch.take(3, "", 23 * kSecond, kNoon + 23 * kSecond);
  CHECK(watch.is_losing());
  watch.take(3, "", 24 * kSecond, kNoon + 24 * kSecond);
  CHECK_FALSE(watch.is_losing());
  CHECK(watch.words().empty());
  watch.take(4, "", 60 * kSecond, kNoon + 3661 * kSecond);
  CHECK(watch.words() == "1 inputs lost since 13:01:01 UTC");
}
