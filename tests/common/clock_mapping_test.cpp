// Clocks with known offset, drift and delays: what comes out is compared with the simulated truth.
#include "common/clock_mapping.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using arcstart::ClockMapping;

namespace {

// A device beside a host. All times in us.
struct Simulation {
  std::int64_t host_us = 1'700'000'000'000'000;
  double device_rate = 1;  // device us a host us
  std::int64_t device_start = 5'000'000;
  double shortest_delay = 500;
  double mean_delay = 700;    // beyond the shortest
  double stall_share = 0.02;  // of messages that come some ms late
  std::mt19937 random{7};
  std::int64_t elapsed_us = 0;

  struct Message {
    std::int64_t device_us, arrival_us, true_host_us;
  };
  Message after(std::int64_t period_us) {
    elapsed_us += period_us;
    double delay = shortest_delay;
    if (mean_delay > 0) delay += std::exponential_distribution<>(1 / mean_delay)(random);
    if (std::uniform_real_distribution<>()(random) < stall_share) delay += 30'000;
    const auto device = device_start + std::llround(static_cast<double>(elapsed_us) * device_rate);
    const std::int64_t truth = host_us + elapsed_us;
    return {device, truth + std::llround(delay), truth};
  }
};

struct Errors {
  double smallest = 1e18, largest = -1e18;
  void add(double error) {
    smallest = std::min(smallest, error);
    largest = std::max(largest, error);
  }
};

// Mapped time less true time over some messages.
Errors run(ClockMapping& mapping, Simulation& simulation, int messages, std::int64_t period_us) {
  Errors errors;
  for (int i = 0; i < messages; ++i) {
    const auto message = simulation.after(period_us);
    errors.add(static_cast<double>(mapping.map(message.device_us, message.arrival_us) -
                                   message.true_host_us));
  }
  return errors;
}

}  // namespace

TEST_CASE("clock mapping: without delay or drift the difference is exact") {
  ClockMapping mapping;
  CHECK_FALSE(mapping.offset_us().has_value());
  CHECK(mapping.map(1000, 5'001'000) == 5'001'000);
  CHECK(mapping.map(2000, 5'002'000) == 5'002'000);
  CHECK(mapping.offset_us() == 5'000'000);
  CHECK(mapping.drift_ppm() == 0);
}

TEST_CASE("clock mapping: the smallest delay is found in the scatter of the others") {
  ClockMapping mapping;
  Simulation simulation;
  run(mapping, simulation, 500, 20'000);
  const Errors errors = run(mapping, simulation, 2000, 20'000);
  CHECK(errors.smallest > 500 - 60);
  CHECK(errors.largest < 500 + 60);
}

TEST_CASE("clock mapping: drift of either sign is followed") {
  const double ppm = GENERATE(-120.0, -40.0, 40.0, 120.0);
  ClockMapping mapping;
  Simulation simulation;
  simulation.device_rate = 1 + ppm * 1e-6;
  run(mapping, simulation, 14 * 60, 71'429);
  const Errors errors = run(mapping, simulation, 14 * 600, 71'429);
  CHECK(errors.smallest > 500 - 150);
  CHECK(errors.largest < 500 + 150);
  CHECK(mapping.drift_ppm() == Approx(-ppm).margin(4));
}

TEST_CASE("clock mapping: a frozen line takes no notice of arrivals and goes on drifting") {
  ClockMapping mapping;
  Simulation simulation;
  simulation.device_rate = 1 + 60e-6;
  run(mapping, simulation, 14 * 120, 71'429);
  mapping.freeze(true);

  ClockMapping same = mapping;
  Simulation other = simulation;
  other.mean_delay = 40'000;
  for (int i = 0; i < 14 * 60; ++i) {
    const auto message = simulation.after(71'429);
    const auto late = other.after(71'429);
    REQUIRE(mapping.map(message.device_us, message.arrival_us) ==
            same.map(late.device_us, late.arrival_us));
  }
  // 60 ppm over this minute alone would be 3.6 ms.
  const Errors errors = run(mapping, simulation, 14, 71'429);
  CHECK(errors.smallest > 500 - 300);
  CHECK(errors.largest < 500 + 300);

  mapping.freeze(false);
  const Errors after = run(mapping, simulation, 14 * 10, 71'429);
  CHECK(after.smallest > 500 - 150);
  CHECK(after.largest < 500 + 150);
}

TEST_CASE("clock mapping: the first message sets even a frozen line") {
  ClockMapping mapping;
  mapping.freeze(true);
  CHECK(mapping.map(1'000, 1'000'000'000) == 1'000'000'000);
  CHECK(mapping.map(21'000, 1'000'019'000) == 1'000'020'000);  // earlier, yet the line stays
  mapping.freeze(false);
  CHECK(mapping.map(41'000, 1'000'040'500) == 1'000'039'000);
}

TEST_CASE("clock mapping: host times never go back, and say when they were held") {
  ClockMapping mapping;
  CHECK(mapping.map(0, 1'000'000'000) == 1'000'000'000);
  CHECK(mapping.held_back_us() == 0);
  // 8 ms better known, 5 ms later on the device: 3 ms before what was said already.
  CHECK(mapping.map(5'000, 999'997'000) == 1'000'000'001);
  CHECK(mapping.held_back_us() == 3'001);
  CHECK(mapping.map(10'000, 1'000'030'000) == 1'000'002'000);
  CHECK(mapping.held_back_us() == 0);
}

TEST_CASE("clock mapping: rises strictly under noise, drift, freezing and restarts") {
  std::mt19937 random(3);
  ClockMapping mapping(20'000'000);
  Simulation simulation;
  simulation.device_rate = 1 - 200e-6;
  simulation.mean_delay = 5'000;
  std::int64_t last = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (random() % 700 == 0) mapping.freeze(random() % 2 == 0);
    if (random() % 3000 == 0) {
      mapping.restart();
      simulation.device_start = static_cast<std::int64_t>(random() % 1'000'000'000);
    }
    const auto message = simulation.after(4'000);
    const std::int64_t host = mapping.map(message.device_us, message.arrival_us);
    REQUIRE(host > last);
    last = host;
  }
}

TEST_CASE("clock mapping: a device that begins its clock anew is mapped anew") {
  ClockMapping mapping;
  Simulation simulation;
  run(mapping, simulation, 1000, 20'000);
  simulation.device_start -= 1000 * 20'000;  // its clock begins again near its start
  simulation.mean_delay = 0;
  const Errors errors = run(mapping, simulation, 500, 20'000);
  CHECK(errors.smallest > 400);
  CHECK(errors.largest < 31'000);  // one stall at the very first message is all that may show
  CHECK(mapping.drift_ppm() == Approx(0).margin(20));
}

TEST_CASE("clock mapping: a host clock that is set is followed") {
  ClockMapping mapping;
  Simulation simulation;
  simulation.stall_share = 0;
  run(mapping, simulation, 1000, 20'000);

  SECTION("ahead: after two seconds, one late message is not enough") {
    auto late = simulation.after(20'000);
    CHECK(mapping.map(late.device_us, late.arrival_us + 3'000'000) < late.true_host_us + 1'000);
    simulation.host_us += 3'000'000;
    run(mapping, simulation, 110, 20'000);
    const Errors errors = run(mapping, simulation, 500, 20'000);
    CHECK(errors.smallest > 400);
    CHECK(errors.largest < 3'000);
  }
  SECTION("back: at once, held until the time said is reached again") {
    simulation.host_us -= 3'000'000;
    const auto message = simulation.after(20'000);
    mapping.map(message.device_us, message.arrival_us);
    CHECK(mapping.held_back_us() > 2'900'000);
    run(mapping, simulation, 160, 20'000);
    CHECK(mapping.held_back_us() == 0);
    const Errors errors = run(mapping, simulation, 500, 20'000);
    CHECK(errors.smallest > 400);
    CHECK(errors.largest < 1'500);
  }
}

TEST_CASE("clock mapping: ticks of 2 ms cost no more than a tick") {
  ClockMapping mapping;
  Simulation simulation;
  simulation.device_rate = 1 + 30e-6;
  Errors errors;
  for (int i = 0; i < 8000; ++i) {
    const auto message = simulation.after(8'000);
    const std::int64_t ticks = message.device_us / 2000 * 2000;
    const auto error =
        static_cast<double>(mapping.map(ticks, message.arrival_us) - message.true_host_us);
    if (i > 1000) errors.add(error);
  }
  CHECK(errors.smallest > 500 - 2'300);
  CHECK(errors.largest < 500 + 300);
}
