#include "services/sensor_capture/clocks/clock_comparison.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace arcstart::sensor_capture;

namespace {

constexpr std::int64_t kSecond = 1'000'000;

// Two hosts whose clocks are known, and a network whose delays are drawn: the truth.
struct TwoHosts {
  ClockComparison comparison;
  std::mt19937 random{7};
  std::int64_t now = 500 * kSecond;  // steady
  double ahead = 0;                  // the other's clock less this one's; us
  double least = 100, mean = 3'000;  // delays of one way; us

  std::int64_t delay() {
    return static_cast<std::int64_t>(least + std::exponential_distribution(1 / mean)(random));
  }
  std::int64_t here() const { return 1'700'000'000 * kSecond + now; }
  std::int64_t there() const { return here() + static_cast<std::int64_t>(ahead); }
  void exchange() {
    ClockExchange stamps{};
    stamps.asked = here();
    now += delay();
    stamps.heard = there();
    now += 50;
    stamps.answered = there();
    now += delay();
    stamps.answer_heard = here();
    comparison.take(stamps, now);
  }
  // ppm: by which the other's clock runs faster.
  void run(double seconds, double ppm = 0) {
    for (const std::int64_t end = now + static_cast<std::int64_t>(seconds * 1e6); now < end;) {
      const std::int64_t begin = now;
      exchange();
      now = begin + 100'000;
      ahead += ppm * 0.1;
    }
  }
  bool holds() const {
    const auto known = comparison.at(now);
    return known && known->lowest <= ahead && ahead <= known->highest;
  }
};

}  // namespace

TEST_CASE("clocks: nothing is known before the first exchange, nor long after the last") {
  TwoHosts hosts;
  CHECK_FALSE(hosts.comparison.at(hosts.now));
  hosts.exchange();
  CHECK(hosts.comparison.at(hosts.now));
  CHECK_FALSE(hosts.comparison.at(hosts.now + 61 * kSecond));
}

TEST_CASE("clocks: the difference lies within its bound, whatever the delays") {
  for (const double ahead : {0.0, 50'000.0, -200'000.0, 5'000'000.0}) {
    TwoHosts hosts;
    hosts.ahead = ahead;
    for (int i = 0; i < 300; ++i) {
      hosts.run(0.1);
      REQUIRE(hosts.holds());
    }
    // Of 300 exchanges whose mean delay is 3 ms a way, some took a quarter of that.
    CHECK(hosts.comparison.at(hosts.now)->bound() < 1'500);
    CHECK(hosts.comparison.steps() == 0);
  }
}

TEST_CASE("clocks: delays that differ by way widen the bound, but mislead nobody") {
  TwoHosts hosts;
  hosts.ahead = 700;
  for (int i = 0; i < 100; ++i) {
    const std::int64_t asked = hosts.here();
    hosts.now += 200;
    const std::int64_t heard = hosts.there();
    hosts.now += 9'000;  // the way back is always slow
    hosts.comparison.take({asked, hosts.here(), heard, heard}, hosts.now);
    hosts.now += 90'000;
    REQUIRE(hosts.holds());
  }
  CHECK(hosts.comparison.at(hosts.now)->bound() > 4'000);
}

TEST_CASE("clocks: drift is followed") {
  for (const double ppm : {200.0, -200.0}) {
    TwoHosts hosts;
    for (int i = 0; i < 120; ++i) {
      hosts.run(1, ppm);
      REQUIRE(hosts.holds());
    }
    CHECK(hosts.comparison.steps() == 0);
  }
}

TEST_CASE(
    "clocks: a clock that is set is seen, and for two minutes both differences are possible") {
  for (const double step : {20'000.0, -50'000.0, 2'000'000.0}) {
    TwoHosts hosts;
    hosts.run(20);
    const double before = hosts.ahead;
    hosts.ahead += step;
    hosts.run(1);
    CHECK(hosts.comparison.steps() == 1);
    hosts.run(100);
    REQUIRE(hosts.holds());
    const auto known = hosts.comparison.at(hosts.now);
    CHECK(known->lowest <= before);
    CHECK(known->highest >= before);
    hosts.run(30);
    REQUIRE(hosts.holds());
    CHECK(hosts.comparison.at(hosts.now)->bound() < 3'000);
  }
}

TEST_CASE("clocks: exchanges that cannot be are left out") {
  ClockComparison comparison;
  comparison.take({1000, 900, 1000, 1000}, kSecond);             // heard before it was asked
  comparison.take({1000, 2'000'000, 1000, 1000}, kSecond);       // on its way for 2 s
  comparison.take({1000, 900'000, 500'000, 400'000}, kSecond);   // answered before it was heard
  comparison.take({1000, 2000, 1'000'000, 1'900'000}, kSecond);  // held longer than it took
  CHECK_FALSE(comparison.at(kSecond));
}
