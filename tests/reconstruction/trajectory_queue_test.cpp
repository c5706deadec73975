#include "services/reconstruction/trajectory_queue.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace arcstart;
using namespace arcstart::reconstruction;
using State = TrajectoryQueue::State;

namespace {

constexpr std::int64_t kOneSecond = 1'000'000, kFirstTime = 1'700'000'000 * kOneSecond;

RigidTransform at_x(double x) {
  RigidTransform transform = RigidTransform::Identity();
  transform.translation().x() = x;
  return transform;
}

TrajectoryQueue queue() { return {10 * kOneSecond, 100'000}; }

// A tool at x = seconds after kFirstTime, with a position every 20 ms.
void fill(TrajectoryQueue& positions, double from, double to) {
  for (auto n = std::llround(from * 50); n <= std::llround(to * 50); ++n)
    positions.insert(kFirstTime + n * 20'000, at_x(static_cast<double>(n) / 50));
}

double x_at(const TrajectoryQueue& positions, double seconds) {
  const auto lookup = positions.at(kFirstTime + std::llround(seconds * 1e6));
  REQUIRE(lookup.state == State::found);
  return lookup.T_base_tool.translation().x();
}

}  // namespace

TEST_CASE("an empty queue waits") { CHECK(queue().at(kFirstTime).state == State::waiting); }

TEST_CASE("between two positions it is interpolated by time") {
  auto positions = queue();
  fill(positions, 0, 2);
  for (const double seconds : {0.000001, 0.013, 0.5, 0.71, 1.999999})
    CHECK(x_at(positions, seconds) == Approx(seconds).epsilon(0).margin(1e-12));
}

TEST_CASE("orientation turns evenly with time") {
  auto positions = queue();
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 3).normalized();
  const auto turned = [&](double angle) {
    RigidTransform transform = RigidTransform::Identity();
    transform.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    return transform;
  };
  positions.insert(kFirstTime, turned(3.0));
  positions.insert(kFirstTime + 80'000, turned(3.4));
  const auto lookup = positions.at(kFirstTime + 20'000);
  REQUIRE(lookup.state == State::found);
  CHECK(lookup.T_base_tool.isApprox(turned(3.1), 1e-12));
}

TEST_CASE("it never extrapolates") {
  auto positions = queue();
  fill(positions, 0, 1);
  CHECK(positions.at(kFirstTime + kOneSecond + 1).state == State::waiting);
  CHECK(positions.at(kFirstTime + 5 * kOneSecond).state == State::waiting);
  const auto before = positions.at(kFirstTime - 1);
  CHECK(before.state == State::none);
  CHECK(before.reason == "no position before it");
}

TEST_CASE("at a position's own instant it is that position, once a later one has come") {
  auto positions = queue();
  fill(positions, 0, 1);
  CHECK(x_at(positions, 0) == 0);
  CHECK(x_at(positions, 0.5) == Approx(0.5).epsilon(1e-14));
  CHECK(positions.at(kFirstTime + kOneSecond).state ==
        State::waiting);  // the newest: a later one decides
  fill(positions, 1.02, 1.02);
  CHECK(x_at(positions, 1) == Approx(1).epsilon(1e-14));
}

TEST_CASE("positions up to 100 ms apart are interpolated, farther ones not") {
  auto positions = queue();
  positions.insert(kFirstTime, at_x(0));
  positions.insert(kFirstTime + 100'000, at_x(10));
  positions.insert(kFirstTime + 200'001, at_x(20));
  CHECK(x_at(positions, 0.075) == Approx(7.5));
  const auto lookup = positions.at(kFirstTime + 150'000);
  CHECK(lookup.state == State::none);
  CHECK(lookup.reason == "positions 100 ms apart");
  CHECK(positions.at(kFirstTime + 200'000).state == State::none);
  positions.insert(kFirstTime + 700'001, at_x(20));
  CHECK(positions.at(kFirstTime + 200'001).reason == "positions 500 ms apart");
}

TEST_CASE(
    "positions are kept for the time set, and both neighbours of its first instant with them") {
  auto positions = queue();
  fill(positions, 0, 60);
  CHECK(x_at(positions, 50) == Approx(50));
  CHECK(x_at(positions, 50.003) == Approx(50.003));
  const auto old = positions.at(kFirstTime + 49 * kOneSecond);
  CHECK(old.state == State::none);
  CHECK(old.reason == "its position is no longer kept (10 s)");
}

TEST_CASE("stamps that do not rise are dropped and counted") {
  auto positions = queue();
  fill(positions, 0, 1);
  positions.insert(kFirstTime + kOneSecond, at_x(-1));
  positions.insert(kFirstTime + kOneSecond / 2, at_x(-1));
  positions.insert(kFirstTime - 8 * kOneSecond, at_x(-1));
  fill(positions, 1.02, 1.1);
  CHECK(positions.dropped_going_back() == 3);
  CHECK(positions.dropped_jumps() == 0);
  for (const double seconds : {0.25, 0.5, 1.0, 1.05})
    CHECK(x_at(positions, seconds) == Approx(seconds));
}

TEST_CASE("shuffled positions give no position that they do not hold") {
  // Neighbours are exchanged in pairs: the later of each pair comes first and stands, the other is
  // dropped.
  auto positions = queue();
  for (int n = 0; n < 100; ++n) {
    const int other = n ^ 1;
    positions.insert(kFirstTime + other * 20'000, at_x(other / 50.0));
  }
  CHECK(positions.dropped_going_back() == 50);
  for (const double seconds : {0.03, 0.5, 1.0, 1.5})
    CHECK(x_at(positions, seconds) == Approx(seconds));
}

TEST_CASE("a single jump of more than 10 s is dropped and counted, either way") {
  for (const std::int64_t jump :
       {11 * kOneSecond, -11 * kOneSecond, 1000000 * kOneSecond, -kFirstTime + 1}) {
    auto positions = queue();
    fill(positions, 0, 1);
    positions.insert(kFirstTime + kOneSecond + jump, at_x(-1));
    CHECK(positions.newest() == kFirstTime + kOneSecond);
    CHECK(positions.at(kFirstTime + kOneSecond + 1).state == State::waiting);
    fill(positions, 1.02, 2);
    CHECK(positions.dropped_jumps() == 1);
    CHECK(positions.dropped_going_back() == 0);
    CHECK(x_at(positions, 1.01) == Approx(1.01));
    CHECK(x_at(positions, 1.5) == Approx(1.5));
  }
}

TEST_CASE("two jumps that do not go on from each other are two single ones") {
  auto positions = queue();
  fill(positions, 0, 1);
  positions.insert(kFirstTime + 500 * kOneSecond, at_x(-1));
  positions.insert(kFirstTime + 100 * kOneSecond, at_x(-1));
  positions.insert(kFirstTime + 100 * kOneSecond, at_x(-1));
  fill(positions, 1.02, 2);
  CHECK(positions.dropped_jumps() == 3);
  CHECK(x_at(positions, 1.5) == Approx(1.5));
}

TEST_CASE("a lasting jump ahead begins a new stream, and the hole is told") {
  auto positions = queue();
  fill(positions, 0, 1);
  fill(positions, 31, 32);
  CHECK(positions.dropped_jumps() == 0);
  CHECK(x_at(positions, 31.5) == Approx(31.5));
  CHECK(positions.at(kFirstTime + 20 * kOneSecond).reason == "positions 30000 ms apart");
  CHECK(positions.at(kFirstTime + kOneSecond / 2).state == State::none);
}

TEST_CASE("a lasting jump back begins a new stream") {
  auto positions = queue();
  fill(positions, 100, 120);
  fill(positions, 0, 1);
  CHECK(positions.dropped_jumps() == 0);
  CHECK(positions.dropped_going_back() == 0);
  CHECK(x_at(positions, 0.5) == Approx(0.5));
  CHECK(positions.at(kFirstTime - 1).reason == "no position before it");
  CHECK(positions.at(kFirstTime + 110 * kOneSecond).state == State::waiting);
  CHECK(positions.newest() == kFirstTime + kOneSecond);
}
