#include "services/command_line/recordings/event_order.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace arcstart;
using namespace arcstart::command_line;

namespace {

constexpr std::int64_t kSecond = 1'000'000;

RecordedStream stream(int rank, std::size_t log, const std::vector<std::int64_t>& utimes,
                      std::size_t first_entry = 0) {
  RecordedStream stream{rank, {}};
  for (std::size_t i = 0; i < utimes.size(); ++i)
    stream.messages.push_back({utimes[i], log, first_entry + i, 0});
  return stream;
}

std::vector<std::int64_t> times(const std::vector<std::int64_t>& utimes) {
  return monotone_times(stream(0, 0, utimes).messages);
}

}  // namespace

TEST_CASE("stamps in order stay as they are") {
  CHECK(times({}).empty());
  CHECK(times({3}) == std::vector<std::int64_t>{3});
  CHECK(times({1, 1, 5, 100 * kSecond, 200 * kSecond}) ==
        std::vector<std::int64_t>{1, 1, 5, 100 * kSecond, 200 * kSecond});
}

TEST_CASE("a stamp that goes back or leaps ahead alone does not disturb the rest") {
  CHECK(times({5, 3, 6}) == std::vector<std::int64_t>{5, 5, 6});
  CHECK(times({5, 900 * kSecond, 6, 7}) == std::vector<std::int64_t>{5, 5, 6, 7});
  CHECK(times({900 * kSecond, 6, 7}) == std::vector<std::int64_t>{6, 6, 7});
  const auto most = std::numeric_limits<std::int64_t>::max();
  const auto least = std::numeric_limits<std::int64_t>::min();
  CHECK(times({5, most, 6}) == std::vector<std::int64_t>{5, 5, 6});
  CHECK(times({most, least, 6}) == std::vector<std::int64_t>{least, least, 6});
  CHECK(times({least, 5}) == std::vector<std::int64_t>{least, 5});
}

TEST_CASE("streams are merged by time, then rank, then place, and keep their own order") {
  const auto merged =
      merge_by_event_time({stream(2, 0, {10, 20, 20}, 0), stream(1, 1, {20, 15, 30}, 7)});
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (const auto& message : merged) places.push_back({message.log, message.entry});
  CHECK(places == std::vector<std::pair<std::size_t, std::size_t>>{
                      {0, 0}, {1, 7}, {1, 8}, {0, 1}, {0, 2}, {1, 9}});
}

TEST_CASE("however wild the stamps, every message comes once and each stream in its order") {
  std::mt19937_64 random(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<RecordedStream> streams;
    for (std::size_t log = 0; log < 3; ++log) {
      std::vector<std::int64_t> utimes(20);
      for (auto& utime : utimes)
        utime = random() % 4 ? static_cast<std::int64_t>(random() % 100) * kSecond
                             : static_cast<std::int64_t>(random());
      streams.push_back(stream(static_cast<int>(log), log, utimes));
    }
    std::vector<std::size_t> next(3, 0);
    for (const auto& message : merge_by_event_time(streams))
      CHECK(message.entry == next[message.log]++);
    CHECK(next == std::vector<std::size_t>{20, 20, 20});
  }
}
