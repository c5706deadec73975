// Several SEAMs of one scan, as a stranger or a second seam_finding sends them. Marks are written
// down here, with the digest of the message as a digest of its bytes by crc32c's tables.
#include "services/command_line/live/awaited_answer.hpp"

#include <fmt/core.h>

#include <catch2/catch.hpp>

#include "common/bus/crc32c.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using Catch::Matchers::Contains;

namespace {

constexpr std::int64_t kAwaited = 1'700'000'000'000'000, kStatusEvery = 1'000'000;

seam_t seam_at(double x) {
  seam_t seam{};
  seam.scan_id = kAwaited;
  seam.start[0] = x;
  return seam;
}

std::string digest_of(const seam_t& seam) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(seam.getEncodedSize()));
  seam.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return fmt::format("{:08x}", crc32c_by_tables(bytes));
}

service_status_t status_of(std::int64_t run_id, int pid, const std::string& words) {
  service_status_t status{};
  status.host = "cell-pc";
  status.run_id = run_id;
  status.pid = pid;
  status.state = service_status_t::RUNNING;
  status.last_error = words;
  return status;
}

std::string words_naming(const seam_t& seam) {
  return "images lost; answer to scan 1700000000000000: " + digest_of(seam);
}

const seam_t kTrue = seam_at(1), kForged = seam_at(25);

}  // namespace

TEST_CASE("the SEAM that STATUS names is the answer, whichever comes first") {
  for (const bool status_first : {true, false}) {
    AwaitedAnswer answer;
    answer.take(kForged, kAwaited, true);
    if (status_first) answer.take(status_of(1, 10, words_naming(kTrue)), kStatusEvery);
    answer.take(kTrue, kAwaited, true);
    answer.decide(kAwaited, kStatusEvery);
    CHECK(answer.seam().has_value() == status_first);
    answer.take(status_of(1, 10, words_naming(kTrue)), kStatusEvery);
    answer.decide(kAwaited, kStatusEvery);
    REQUIRE(answer.seam());
    CHECK(answer.seam()->start[0] == 1);
    CHECK_THAT(answer.stranger(), Contains("cell-pc, process 10") && Contains("start 25.000"));
    CHECK(answer.failure().empty());
  }
}

TEST_CASE("a SEAM before the scan's end is no answer, and is told where it differs") {
  for (const seam_t& early : {kForged, kTrue}) {
    AwaitedAnswer answer;
    answer.take(early, kAwaited, false);
    answer.take(status_of(1, 10, words_naming(early)), kStatusEvery);
    answer.decide(kAwaited, kStatusEvery);
    CHECK_FALSE(answer.seam());
    answer.take(status_of(1, 10, words_naming(kTrue)), kStatusEvery);
    answer.take(kTrue, kAwaited, true);
    answer.decide(kAwaited, kStatusEvery);
    REQUIRE(answer.seam());
    CHECK(answer.seam()->start[0] == 1);
    CHECK(answer.stranger().empty() == (early.start[0] == 1));
  }
}

TEST_CASE("two seam_finding that answer differently give no answer, and both are named") {
  AwaitedAnswer answer;
  answer.take(kTrue, kAwaited, true);
  answer.take(status_of(1, 10, words_naming(kTrue)), kStatusEvery);
  answer.take(status_of(2, 20, ""), kStatusEvery);
  answer.decide(kAwaited, kStatusEvery);
  CHECK_FALSE(answer.seam());  // the second has not answered yet
  SECTION("differently") {
    answer.take(status_of(2, 20, words_naming(kForged)), 2 * kStatusEvery);
    answer.decide(kAwaited, 2 * kStatusEvery);
    CHECK_FALSE(answer.seam());
    CHECK_THAT(answer.failure(), Contains("process 10") && Contains("process 20"));
  }
  SECTION("alike") {
    answer.take(status_of(2, 20, words_naming(kTrue)), 2 * kStatusEvery);
    answer.decide(kAwaited, 2 * kStatusEvery);
    CHECK(answer.seam());
    CHECK(answer.failure().empty());
  }
  SECTION("the second has died") {
    answer.take(status_of(1, 10, words_naming(kTrue)), 2 * kStatusEvery);
    answer.decide(kAwaited, 3 * kStatusEvery);
    CHECK(answer.seam());
  }
  SECTION("the second ends") {
    service_status_t last = status_of(2, 20, "");
    last.state = service_status_t::STOPPING;
    answer.take(last, kStatusEvery);
    answer.decide(kAwaited, kStatusEvery);
    CHECK(answer.seam());
  }
}

TEST_CASE("of a flood of forged SEAMs the true one is told, and what is missing is said") {
  AwaitedAnswer answer;
  CHECK(answer.missing().empty());
  for (int i = 0; i < 1000; ++i) answer.take(seam_at(100 + i), kAwaited, true);
  CHECK_THAT(answer.missing(), Contains("no STATUS of seam_finding"));
  answer.take(status_of(1, 10, "answer to scan 1600000000000000: 12345678"), kStatusEvery);
  CHECK_THAT(answer.missing(), Contains("names: a stranger's"));
  answer.take(status_of(1, 10, words_naming(kTrue)), kStatusEvery);
  answer.decide(kAwaited, kStatusEvery);
  CHECK_FALSE(answer.seam());
  answer.take(kTrue, kAwaited, true);
  answer.decide(kAwaited, kStatusEvery);
  REQUIRE(answer.seam());
  CHECK(answer.seam()->start[0] == 1);
}
