#include "services/cell_simulator/robot/search_motion.hpp"

#include <catch2/catch.hpp>

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

const RigidTransform kBegin =
    make_transform({800, -60, 160}, Eigen::Quaterniond(0.1, 0.9, -0.3, 0.2));
const RigidTransform kEnd =
    make_transform({950, -60, 160}, Eigen::Quaterniond(0.1, 0.9, -0.3, 0.2));
constexpr std::int64_t kFramePeriod = 71428;  // 14 frames a second
constexpr std::int64_t kNow = 1'700'000'000'123'456;

double along(const SearchMotion& motion, std::int64_t utime) {
  return motion.pose(utime).translation().x() - 800;
}

// Neither the tool nor its speed may jump: checked each millisecond. mm, mm/s, mm/s2.
void check_smooth(const SearchMotion& motion, std::int64_t from, std::int64_t to, double speed,
                  double acceleration) {
  constexpr double kStep = 1e-3;
  Eigen::Vector3d last = motion.pose(from).translation(), last_velocity = Eigen::Vector3d::Zero();
  for (std::int64_t t = from + 1000; t <= to; t += 1000) {
    const Eigen::Vector3d position = motion.pose(t).translation();
    const Eigen::Vector3d velocity = (position - last) / kStep;
    if (velocity.norm() > speed * 1.001 + 0.01)
      FAIL("too fast at " << t - from << " us: " << velocity.norm());
    const double change = (velocity - last_velocity).norm() / kStep;
    if (t > from + 1000 && change > 1.01 * acceleration + 1)
      FAIL("jerks at " << t - from << " us: " << change);
    last = position;
    last_velocity = velocity;
  }
  SUCCEED();
}

}  // namespace

TEST_CASE(
    "the search begins half a second after the scan, at its phase of the trigger, and runs as a "
    "trapezoid") {
  for (const double phase : {0.0, 0.25, 0.999}) {
    SearchMotion motion(kBegin, kEnd, {});
    const std::int64_t start = motion.search(kNow, kNow - 40'000, kFramePeriod, phase);
    CHECK(start >= kNow - 40'000 + 500'000);
    CHECK(start < kNow - 40'000 + 500'000 + kFramePeriod);
    CHECK(start % kFramePeriod == std::llround(phase * kFramePeriod));

    CHECK(along(motion, start) == 0);
    CHECK_FALSE(motion.moving(start - 1));
    CHECK(motion.moving(start));
    CHECK(along(motion, start + 20'000) == Approx(0.5 * 1000 * 0.02 * 0.02));
    CHECK(along(motion, start + 50'000) == Approx(1.25));  // 50 mm/s reached
    CHECK(along(motion, start + 1'000'000) == Approx(1.25 + 47.5));
    CHECK(along(motion, start + 3'000'000) == Approx(148.75));  // slows down from here
    CHECK(along(motion, start + 3'050'000) == Approx(150));
    CHECK(motion.at_rest_from(kNow) == start + 3'050'000);
    CHECK_FALSE(motion.moving(start + 3'050'000));
    CHECK(along(motion, start + 60'000'000) == Approx(150));  // rests there
    CHECK(motion.pose(start + 1'234'567).linear().isApprox(kBegin.linear(), 1e-12));
    CHECK(motion.pose(start + 1'234'567).translation().y() == Approx(-60));
    check_smooth(motion, start - 100'000, start + 3'200'000, 50, 1000);
  }
}

TEST_CASE("a scan that is heard of late still leaves 0.3 s of notice") {
  SearchMotion motion(kBegin, kEnd, {});
  CHECK(motion.search(kNow, kNow - 5'000'000, kFramePeriod, 0) >= kNow + SearchMotion::kNotice);
}

TEST_CASE("after the scan the arm goes back fast, and the next search waits for it") {
  SearchMotion motion(kBegin, kEnd, {});
  const std::int64_t start = motion.search(kNow, kNow, kFramePeriod, 0.5);
  const std::int64_t ended = start + 3'500'000;
  motion.go_back(ended);
  CHECK(along(motion, ended + SearchMotion::kNotice) == Approx(150));
  // 150 mm at 1000 mm/s2: a triangle, 2 sqrt(d / a), whose top of 387 mm/s stays below 500.
  const std::int64_t back = ended + SearchMotion::kNotice + 774'597;
  CHECK(motion.at_rest_from(ended) == back);
  CHECK(along(motion, back) == Approx(0).margin(1e-9));

  motion.go_back(ended + 100'000);  // said again: nothing changes
  CHECK(motion.at_rest_from(ended) == back);

  const std::int64_t next = motion.search(ended + 200'000, ended + 200'000, kFramePeriod, 0.5);
  CHECK(next >= back);
  CHECK(next < back + kFramePeriod);
  CHECK(along(motion, next + 1'000'000) == Approx(48.75));
  check_smooth(motion, start, next + 3'200'000, 388, 1000);
}

TEST_CASE("a search cut short is braked before the arm goes back") {
  SearchMotion motion(kBegin, kEnd, {});
  const std::int64_t start = motion.search(kNow, kNow, kFramePeriod, 0.1);
  const std::int64_t ended = start + 1'000'000;
  motion.go_back(ended);
  const std::int64_t braked = ended + SearchMotion::kNotice;
  CHECK(along(motion, braked) == Approx(50 * 1.3 - 1.25));  // on its way until then
  CHECK(along(motion, braked + 50'000) ==
        Approx(50 * 1.3 - 1.25 + 1.25));  // 50 mm/s to rest over v2 / 2a
  CHECK(along(motion, motion.at_rest_from(ended)) == Approx(0).margin(1e-9));
  check_smooth(motion, start, motion.at_rest_from(ended) + 100'000, 360, 1000);
}

TEST_CASE("a pose asked for is gone to and kept, and left for the next search") {
  SearchMotion motion(kBegin, kEnd, {});
  const RigidTransform pose = make_transform({700, 200, 300}, Eigen::Quaterniond(0, 1, 0, 0));
  motion.go_to(kNow, pose);
  CHECK(motion.pose(kNow + SearchMotion::kNotice).isApprox(kBegin));
  const std::int64_t there = motion.at_rest_from(kNow);
  CHECK(motion.pose(there).isApprox(pose, 1e-12));
  CHECK(motion.pose(there + 600'000'000).isApprox(pose, 1e-12));
  check_smooth(motion, kNow, there, 500, 1000);

  const std::int64_t start = motion.search(there + 1'000'000, there + 1'000'000, kFramePeriod, 0);
  CHECK(motion.pose(start).isApprox(kBegin, 1e-12));
  CHECK(along(motion, start + 1'000'000) == Approx(48.75));
  check_smooth(motion, there, start + 3'100'000, 500, 1000);
}

TEST_CASE("a pose asked for on the way to another is reached without a jump") {
  SearchMotion motion(kBegin, kEnd, {});
  const RigidTransform first = make_transform({1200, 300, 300}, Eigen::Quaterniond(0, 1, 0, 0));
  const RigidTransform second = make_transform({700, -200, 400}, Eigen::Quaterniond(0, 1, 0.1, 0));
  motion.go_to(kNow, first);
  motion.go_to(kNow, second);  // the first has not begun: it never does
  CHECK(motion.pose(motion.at_rest_from(kNow)).isApprox(second, 1e-12));
  motion.go_to(kNow + 100'000, first);
  CHECK(motion.moving(kNow + 350'000));  // on the way to the second, to be braked 50 ms later
  CHECK(motion.pose(motion.at_rest_from(kNow)).isApprox(first, 1e-12));
  check_smooth(motion, kNow, motion.at_rest_from(kNow) + 10'000, 500, 1000);
}

TEST_CASE("further sweeps go back and to at their own speeds, in one scan, and end with it") {
  SearchMotionSettings settings;
  settings.further_sweeps = {50, 120, 120};
  SearchMotion motion(kBegin, kEnd, settings);
  const std::int64_t start = motion.search(kNow, kNow, kFramePeriod, 0.5);
  // 150 mm and the time to get to speed, at 50, 50, 120 and 120 mm/s.
  const std::int64_t end = start + 2 * 3'050'000 + 2 * 1'370'000;
  CHECK(motion.at_rest_from(kNow) == end);
  CHECK(along(motion, start + 3'050'000) == Approx(150));
  CHECK(along(motion, start + 6'100'000) == Approx(0).margin(1e-9));
  CHECK(along(motion, start + 7'470'000) == Approx(150));
  CHECK(along(motion, end) == Approx(0).margin(1e-9));
  check_smooth(motion, start, end + 100'000, 120, 1000);
  motion.go_back(start + 1'000'000);
  CHECK(motion.at_rest_from(kNow) < start + 3'000'000);
  CHECK(along(motion, start + 60'000'000) == Approx(0).margin(1e-9));
}
