#include "services/sensor_capture/scan/standstill.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace arcstart;
using namespace arcstart::sensor_capture;

namespace {

constexpr std::int64_t kPosePeriod = 20'000;

struct Tool {
  Standstill standstill{StandstillSettings{}};
  std::int64_t utime = 1'000'000;
  std::mt19937 random{1};

  bool stand(const Eigen::Vector3d& at, int reports, double degrees = 0) {
    std::normal_distribution<> noise(0, 0.02);
    const Eigen::Quaterniond turned(
        Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitY()));
    bool stands = false;
    for (int i = 0; i < reports; ++i, utime += kPosePeriod)
      stands = standstill.take(
          utime, at + Eigen::Vector3d(noise(random), noise(random), noise(random)), turned);
    return stands;
  }
};

}  // namespace

TEST_CASE("standstill: a tool that never moved does not count, noise is no movement") {
  Tool tool;
  CHECK_FALSE(tool.stand({1000, 0, 500}, 3000));
}

TEST_CASE("standstill: moved, then half a second") {
  Tool tool;
  tool.stand({0, 0, 0}, 50);
  for (int i = 0; i < 100; ++i) CHECK_FALSE(tool.stand({i * 0.2, 0, 0}, 1));  // 10 mm/s
  CHECK_FALSE(tool.stand({20, 0, 0}, 25));
  CHECK(tool.stand({20, 0, 0}, 4));
}

TEST_CASE("standstill: a turn is a movement too") {
  Tool tool;
  tool.stand({0, 0, 0}, 5);
  CHECK_FALSE(tool.stand({0, 0, 0}, 10, 5));
  CHECK(tool.stand({0, 0, 0}, 20, 5));
}

TEST_CASE("standstill: silence proves nothing, a restart forgets") {
  Tool tool;
  tool.stand({0, 0, 0}, 5);
  tool.stand({9, 0, 0}, 5);
  tool.utime += 2'000'000;
  CHECK_FALSE(tool.stand({9, 0, 0}, 1));
  CHECK_FALSE(tool.stand({9, 0, 0}, 24));
  CHECK(tool.stand({9, 0, 0}, 2));
  tool.standstill.restart();
  CHECK_FALSE(tool.stand({9, 0, 0}, 200));
}
