#include "services/cell_simulator/cell_faults.hpp"

#include <catch2/catch.hpp>

#include "services/cell_simulator/base/device_clock.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {
constexpr std::int64_t kPeriod = 100'000;
}

TEST_CASE("faults strike in their scan alone, from their time on") {
  CellFaultSettings settings;
  settings.scan = 2;
  settings.after_scan_begin = 0.5;
  settings.lose_every = 3;
  settings.camera_away = 1;
  settings.robot_silent = 0.2;
  settings.robot_clock_back = 0.05;
  CellFaults faults(settings);
  faults.scan_begins(10'000'000);
  CHECK_FALSE(faults.camera_away(10'600'000));
  CHECK_FALSE(faults.frame_lost(10'700'000, kPeriod));
  faults.scan_ends(12'000'000);

  faults.scan_begins(20'000'000);
  CHECK_FALSE(faults.camera_away(20'499'999));
  CHECK(faults.camera_away(20'500'000));
  CHECK(faults.camera_away(21'499'999));
  CHECK_FALSE(faults.camera_away(21'500'000));
  CHECK(faults.robot_silent(20'699'999));
  CHECK_FALSE(faults.robot_silent(20'700'000));
  CHECK(faults.robot_clock_back_us(20'499'999) == 0);
  CHECK(faults.robot_clock_back_us(20'500'000) == 50'000);

  std::vector<int> lost;
  faults.scan_ends(21'600'000);
  for (int i = 0; i < 20; ++i)
    if (faults.frame_lost(20'000'000 + i * kPeriod, kPeriod)) lost.push_back(i);
  CHECK(lost == std::vector<int>{7, 10, 13, 16});

  faults.scan_begins(30'000'000);
  faults.scan_ends(33'000'000);
  CHECK_FALSE(faults.frame_lost(30'700'000, kPeriod));
  CHECK_FALSE(faults.camera_away(30'600'000));
  CHECK(faults.robot_clock_back_us(30'000'000) == 50'000);  // for good
}

TEST_CASE("without a scan named there are no faults") {
  CellFaults faults({0, 0, 1, 10, 10, 10});
  faults.scan_begins(1'000'000);
  CHECK_FALSE(faults.camera_away(1'500'000));
  CHECK_FALSE(faults.robot_silent(1'500'000));
  CHECK_FALSE(faults.frame_lost(1'500'000, kPeriod));
  CHECK(faults.robot_clock_back_us(1'500'000) == 0);
}

TEST_CASE("a device's clock has its own epoch and rate, exact over a day") {
  const DeviceClock clock{1'700'000'000'000'000, 4'321'000'000'000, 12};
  CHECK(clock.nanoseconds(1'700'000'000'000'000) == 4'321'000'000'000);
  CHECK(clock.nanoseconds(1'700'000'001'000'000) == 4'322'000'012'000);
  CHECK(clock.nanoseconds(1'700'086'400'000'000) ==
        4'321'000'000'000 + 86'400'000'000'000 + 1'036'800'000);
  CHECK(clock.nanoseconds(1'699'999'999'000'000) == 4'319'999'988'000);
}
