// The order of decisions, through the whole of Reconstruction without a bus.
#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "services/reconstruction/reconstruction.hpp"
#include "tests/reconstruction/synthetic_cell.hpp"

using namespace arcstart;
using namespace arcstart::reconstruction;
using namespace arcstart::test;

namespace {

constexpr std::int64_t kSecond = 1'000'000;

std::shared_ptr<const Calibration> calibration(double time_offset = 0) {
  auto result = std::make_shared<Calibration>(true_calibration());
  result->time_offset = time_offset;
  return result;
}

// A stripe of one centre, measured at this time after kBegin.
ReceivedStripe stripe(std::int64_t time, std::int64_t seq, std::int64_t scan_id = 5) {
  ReceivedStripe result;
  result.source = {kBegin + time, 1, seq, scan_id, static_cast<std::int32_t>(seq)};
  result.sensor_width = 1600;
  result.sensor_height = 1200;
  result.centres = {{800, 600, 0, 0}};
  return result;
}

ReceivedStripe empty_stripe(std::int64_t time, std::int64_t seq) {
  ReceivedStripe result = stripe(time, seq);
  result.centres.clear();
  result.why = EmptyProfile::kNoStripe;
  result.empty = "too dark";
  return result;
}

struct Bench {
  Reconstruction reconstruction;
  explicit Bench(const ReconstructionSettings& settings = {}) : reconstruction(settings) {}

  // A tool at x = ms after kBegin.
  void position(std::int64_t time) {
    RigidTransform transform = RigidTransform::Identity();
    transform.translation().x() = static_cast<double>(time) / 1e3;
    reconstruction.take_position(kBegin + time, transform);
  }
  void positions(std::int64_t from, std::int64_t to) {
    for (std::int64_t time = from; time <= to; time += 20'000) position(time);
  }
  // "3: x=12.5" or "3: reason" for each profile ready.
  std::vector<std::string> ready() {
    std::vector<std::string> lines;
    while (const auto profile = reconstruction.next())
      lines.push_back(
          fmt::format("{}: {}", profile->source.seq,
                      profile->why == EmptyProfile::kNone
                          ? fmt::format("x={:g}", profile->T_base_tool.translation().x())
                          : profile->empty));
    return lines;
  }
};

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("a stripe waits for the first position after it") {
  Bench bench;
  bench.reconstruction.take_calibration(calibration());
  bench.positions(0, 40'000);
  bench.reconstruction.take_stripe(stripe(40'000, 1));
  bench.reconstruction.take_stripe(stripe(50'000, 2));
  CHECK(bench.ready().empty());
  bench.position(60'000);
  CHECK(bench.ready() == Lines{"1: x=40", "2: x=50"});
  CHECK(bench.reconstruction.waiting() == 0);
}

TEST_CASE("an image stamped 27.32 ms late is looked up 27.32 ms earlier") {
  Bench bench;
  bench.reconstruction.take_calibration(calibration(-0.02732));
  bench.positions(0, 200'000);
  bench.reconstruction.take_stripe(stripe(127'320, 1));
  CHECK(bench.ready() == Lines{"1: x=100"});
}

TEST_CASE("an empty stripe needs neither position nor calibration, but keeps its place") {
  Bench bench;
  bench.reconstruction.take_stripe(empty_stripe(0, 1));
  CHECK(bench.ready() == Lines{"1: stripe empty: too dark"});
  bench.reconstruction.take_calibration(calibration());
  bench.positions(0, 20'000);
  bench.reconstruction.take_stripe(stripe(30'000, 2));
  bench.reconstruction.take_stripe(empty_stripe(40'000, 3));
  CHECK(bench.ready().empty());
  bench.position(40'000);
  CHECK(bench.ready() == Lines{"2: x=30", "3: stripe empty: too dark"});
}

TEST_CASE("without positions stripes wait, whatever their number, up to the bound") {
  ReconstructionSettings settings;
  settings.waiting_stripes = 3;
  Bench bench(settings);
  bench.reconstruction.take_calibration(calibration());
  for (int i = 0; i < 3; ++i) bench.reconstruction.take_stripe(stripe(i * 10'000, i));
  CHECK(bench.ready().empty());
  bench.reconstruction.take_stripe(stripe(30'000, 3));
  CHECK(bench.ready() == Lines{"0: no later position while 3 stripes waited"});
  bench.positions(0, 40'000);
  CHECK(bench.ready() == Lines{"1: x=10", "2: x=20", "3: x=30"});
}

TEST_CASE("a hole in the positions empties the stripes in it alone") {
  Bench bench;
  bench.reconstruction.take_calibration(calibration());
  bench.positions(0, 20'000);
  for (int i = 0; i < 5; ++i) bench.reconstruction.take_stripe(stripe(10'000 + i * 50'000, i));
  CHECK(bench.ready() == Lines{"0: x=10"});
  bench.positions(180'000, 300'000);
  CHECK(bench.ready() == Lines{"1: positions 160 ms apart", "2: positions 160 ms apart",
                               "3: positions 160 ms apart", "4: x=210"});
  bench.reconstruction.take_stripe(stripe(-1, 5));
  CHECK(bench.ready() == Lines{"5: no position before it"});
}

TEST_CASE("stripes before the first calibration wait for it") {
  Bench bench;
  bench.reconstruction.take_stripe(stripe(10'000, 1));
  bench.positions(0, 3 * kSecond);
  bench.reconstruction.take_stripe(stripe(30'000, 2));
  CHECK(bench.ready().empty());
  bench.reconstruction.take_calibration(calibration());
  CHECK(bench.ready() == Lines{"1: x=10", "2: x=30"});
}

TEST_CASE("a scan whose first stripe sees no calibration for 3 s of positions stays without") {
  Bench bench;
  bench.reconstruction.take_stripe(stripe(10'000, 1, 5));
  bench.reconstruction.take_stripe(stripe(90'000, 2, 5));
  bench.positions(0, 3 * kSecond);
  CHECK(bench.ready().empty());
  bench.positions(3 * kSecond + 20'000, 4 * kSecond);
  CHECK(bench.ready() == Lines{"1: no calibration", "2: no calibration"});
  bench.reconstruction.take_stripe(stripe(3 * kSecond, 3, 5));
  CHECK(bench.ready() == Lines{"3: no calibration"});
  bench.reconstruction.take_calibration(calibration());
  bench.reconstruction.take_stripe(stripe(3 * kSecond, 4, 5));
  bench.reconstruction.take_stripe(stripe(3 * kSecond, 5, 6));  // the next scan has one
  CHECK(bench.ready() == Lines{"4: no calibration", "5: x=3000"});
}

TEST_CASE("a calibration that changes in a scan empties the rest of it") {
  Bench bench;
  auto other = std::make_shared<Calibration>(true_calibration());
  other->id = "fedcba9876543210";
  other->time_offset = 0.01;
  bench.positions(0, kSecond);
  bench.reconstruction.take_calibration(calibration());
  bench.reconstruction.take_stripe(stripe(10'000, 1, 5));
  bench.reconstruction.take_calibration(calibration());  // repeated: no change
  bench.reconstruction.take_stripe(stripe(20'000, 2, 5));
  bench.reconstruction.take_calibration(other);
  bench.reconstruction.take_stripe(stripe(30'000, 3, 5));
  bench.reconstruction.take_calibration(calibration());
  bench.reconstruction.take_stripe(stripe(40'000, 4, 5));
  bench.reconstruction.take_calibration(other);
  bench.reconstruction.take_stripe(stripe(50'000, 5, 6));
  CHECK(bench.ready() == Lines{"1: x=10", "2: x=20", "3: calibration changed within the scan",
                               "4: calibration changed within the scan", "5: x=60"});
}

TEST_CASE("a scan that begins with an empty stripe has the calibration of that moment") {
  Bench bench;
  auto other = std::make_shared<Calibration>(true_calibration());
  other->id = "fedcba9876543210";
  bench.positions(0, kSecond);
  bench.reconstruction.take_calibration(calibration());
  bench.reconstruction.take_stripe(empty_stripe(10'000, 1));
  bench.reconstruction.take_calibration(other);
  bench.reconstruction.take_stripe(stripe(20'000, 2));
  CHECK(bench.ready() ==
        Lines{"1: stripe empty: too dark", "2: calibration changed within the scan"});
}

TEST_CASE("a change is not missed behind an empty stripe that waits for its turn") {
  Bench bench;
  auto other = std::make_shared<Calibration>(true_calibration());
  other->id = "fedcba9876543210";
  bench.reconstruction.take_calibration(calibration());
  bench.reconstruction.take_stripe(stripe(10'000, 1, 5));
  bench.reconstruction.take_stripe(empty_stripe(20'000, 2));
  bench.reconstruction.take_stripe(stripe(30'000, 3, 6));
  bench.reconstruction.take_calibration(other);
  bench.reconstruction.take_stripe(stripe(40'000, 4, 6));
  bench.positions(0, 100'000);
  CHECK(bench.ready() == Lines{"1: x=10", "2: stripe empty: too dark", "3: x=30",
                               "4: calibration changed within the scan"});
}

TEST_CASE("an image of another size than the calibration's is empty") {
  Bench bench;
  bench.reconstruction.take_calibration(calibration());
  ReceivedStripe other = stripe(10'000, 1);
  other.sensor_width = 640;
  other.sensor_height = 480;
  bench.reconstruction.take_stripe(other);
  CHECK(bench.ready() == Lines{"1: image of 640 x 480 px, calibration of 1600 x 1200 px"});
}

TEST_CASE("a stripe that comes when its positions are gone is told so") {
  Bench bench;
  bench.reconstruction.take_calibration(calibration());
  bench.positions(0, 20 * kSecond);
  bench.reconstruction.take_stripe(stripe(5 * kSecond, 1));
  bench.reconstruction.take_stripe(stripe(15 * kSecond, 2));
  CHECK(bench.ready() == Lines{"1: its position is no longer kept (10 s)", "2: x=15000"});
}

TEST_CASE("a stripe with a stamp far ahead holds up none but the next") {
  Bench bench;
  bench.reconstruction.take_calibration(calibration());
  bench.positions(0, 100'000);
  bench.reconstruction.take_stripe(stripe(10'000, 1));
  bench.reconstruction.take_stripe(stripe(1'000'000 * kSecond, 2));
  CHECK(bench.ready() == Lines{"1: x=10"});
  bench.reconstruction.take_stripe(stripe(50'000, 3));
  CHECK(bench.ready() ==
        Lines{"2: its time lies far ahead of the positions and of the stripe after it", "3: x=50"});
}
