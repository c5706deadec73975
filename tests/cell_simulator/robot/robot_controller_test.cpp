#include "services/cell_simulator/robot/robot_controller.hpp"

#include <bit>
#include <catch2/catch.hpp>

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

std::uint32_t u32(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return std::uint32_t{bytes.at(at)} << 24 | std::uint32_t{bytes.at(at + 1)} << 16 |
         std::uint32_t{bytes.at(at + 2)} << 8 | bytes.at(at + 3);
}
double f32(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return static_cast<double>(std::bit_cast<float>(u32(bytes, at)));
}

const RigidTransform kTool = from_xyzwpr({31.5, -4.2, 297.8, 1.3, 28.4, -2.1});
const XyzWpr kPose{805.145, -61.2, 162.065, -173.868, -4.073, 4.283};

RobotControllerSettings without_noise() {
  RobotControllerSettings settings;
  settings.T_tool0_tool = kTool;
  settings.position_noise = 0;
  return settings;
}

}  // namespace

TEST_CASE("pose and joints of a packet are one place of the arm") {
  RobotController controller(without_noise(), [](std::int64_t utime) {
    XyzWpr pose = kPose;
    pose.x += 50e-6 * static_cast<double>(utime);
    return from_xyzwpr(pose);
  });
  const FanucM20ia arm(kTool);
  for (std::int64_t instant = 0; instant <= 3'000'000; instant += 20'000) {
    const auto bytes = controller.packet(instant);
    REQUIRE(bytes.size() == 94);
    const double expected_x = kPose.x + 50e-6 * static_cast<double>(instant);
    CHECK(f32(bytes, 16) == Approx(expected_x).margin(1e-4));
    CHECK(f32(bytes, 28) == Approx(kPose.w).margin(1e-4));
    CHECK(f32(bytes, 36) == Approx(kPose.r).margin(1e-4));
    Joints joints{};
    for (std::size_t i = 0; i < 6; ++i) joints[i] = f32(bytes, 50 + 4 * i);
    joints[2] += joints[1];  // FANUC counts J3 from the horizontal
    const RigidTransform reached = arm.tool_pose(joints);
    CHECK((reached.translation() - Eigen::Vector3d(expected_x, kPose.y, kPose.z)).norm() < 0.002);
  }
  CHECK(controller.unreachable() == 0);
}

TEST_CASE("index counts, the clock has its own epoch, drift, tick and width") {
  RobotControllerSettings settings = without_noise();
  settings.joints_too = false;
  settings.tick_us = 2000;
  settings.clock = {1'000'000, 8'000'000'000, 1000};  // 8 s at utime 1 s; 1 ms a second fast
  RobotController controller(settings, [](std::int64_t) { return from_xyzwpr(kPose); });
  const auto first = controller.packet(1'000'000), second = controller.packet(11'000'000);
  CHECK(first.size() == 48);
  CHECK(u32(first, 4) == 0);
  CHECK(u32(second, 4) == 1);
  CHECK(u32(first, 8) == 4000);
  CHECK(u32(second, 8) == 9005);  // 8 s + 10.010 s in ticks of 2 ms
  CHECK(u32(controller.packet(11'000'000, 2'000'000), 8) == 8004);

  settings.tick_us = 1;
  settings.clock = {0, (std::int64_t{1} << 32) * 1000, 0};
  RobotController wrapped(settings, [](std::int64_t) { return from_xyzwpr(kPose); });
  CHECK(u32(wrapped.packet(5), 8) == 5);
}

TEST_CASE("noise has its deviation, is on the position alone, and follows from the seed") {
  RobotControllerSettings settings = without_noise();
  settings.joints_too = false;
  settings.position_noise = 0.02;
  const auto pose = [](std::int64_t) { return from_xyzwpr(kPose); };
  RobotController controller(settings, pose), same(settings, pose);
  settings.seed = 2;
  RobotController other(settings, pose);
  double sum = 0, squares = 0;
  int differ = 0;
  constexpr int kPackets = 5000;
  for (int i = 0; i < kPackets; ++i) {
    const auto bytes = controller.packet(i);
    CHECK(bytes == same.packet(i));
    if (bytes != other.packet(i)) ++differ;
    CHECK(f32(bytes, 28) == Approx(kPose.w).margin(2e-5));
    const double error = f32(bytes, 24) - kPose.z;
    sum += error;
    squares += error * error;
  }
  CHECK(std::abs(sum / kPackets) < 4 * 0.02 / std::sqrt(kPackets));
  CHECK(std::sqrt(squares / kPackets) == Approx(0.02).epsilon(0.05));
  CHECK(differ == kPackets);
}

TEST_CASE("a pose out of reach keeps the last joints and is counted") {
  bool away = false;
  RobotController controller(without_noise(), [&away](std::int64_t) {
    XyzWpr pose = kPose;
    if (away) pose.x = 4000;
    return from_xyzwpr(pose);
  });
  const auto good = controller.packet(0);
  away = true;
  const auto bad = controller.packet(1);
  CHECK(controller.unreachable() == 1);
  CHECK(std::vector(bad.begin() + 48, bad.end()) == std::vector(good.begin() + 48, good.end()));
}
