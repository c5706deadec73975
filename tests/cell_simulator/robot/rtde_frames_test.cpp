#include "services/cell_simulator/robot/rtde_frames.hpp"

#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <cstring>

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

std::string hex_text(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const auto byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

TEST_CASE("RTDE answers, byte by byte") {
  CHECK(hex_text(rtde_yes_or_no('V', true)) == "00045601");
  CHECK(hex_text(rtde_yes_or_no('S', false)) == "00045300");
  CHECK(hex_text(rtde_recipe_bytes(1, "DOUBLE")) ==
        "000a4f01"
        "444f55424c45");
}

TEST_CASE("RTDE requests are cut from what has come") {
  std::vector<std::uint8_t> received{0, 5, 'V', 0, 2, 0, 3, 'S', 0};
  const auto version = take_rtde_request(received);
  REQUIRE(version);
  CHECK(version->type == 'V');
  CHECK(version->payload == std::vector<std::uint8_t>{0, 2});
  CHECK(take_rtde_request(received)->type == 'S');
  CHECK_FALSE(take_rtde_request(received));
  CHECK(received == std::vector<std::uint8_t>{0});
  received = {0, 1, 'V'};
  CHECK_FALSE(take_rtde_request(received));
  CHECK(received.empty());
}

TEST_CASE("RTDE outputs: 125 Hz and their names, and what is not known") {
  std::vector<std::uint8_t> payload{0x40, 0x5f, 0x40, 0, 0, 0, 0, 0, 'a', ',', 'b'};
  const auto outputs = understand_rtde_outputs(payload);
  REQUIRE(outputs);
  CHECK(outputs->rate_hz == 125);
  CHECK(outputs->names == std::vector<std::string>{"a", "b"});
  CHECK_FALSE(understand_rtde_outputs({1, 2, 3}));
  CHECK(rtde_type_of("timestamp") == "DOUBLE");
  CHECK(rtde_type_of("tcp_offset") == "VECTOR6D");
  CHECK(rtde_type_of("actual_TCP_speed") == "NOT_FOUND");
}

TEST_CASE("RTDE data: 108 bytes for time, pose and joints, in metres and radians") {
  RobotReport report;
  report.clock_ns = 1'500'000'000;
  report.T_base_tool = RigidTransform::Identity();
  report.T_base_tool.translation() << 1000, -500, 250;
  report.joints = {1, 2, 3, 4, 5, -6};
  const auto bytes = rtde_data_bytes(1, {"timestamp", "actual_TCP_pose", "actual_q"}, report,
                                     RigidTransform::Identity());
  CHECK(hex_text(bytes) ==
        "006c5501"
        "3ff8000000000000"
        "3ff0000000000000"
        "bfe0000000000000"
        "3fd0000000000000"
        "0000000000000000"
        "0000000000000000"
        "0000000000000000"
        "3ff0000000000000"
        "4000000000000000"
        "4008000000000000"
        "4010000000000000"
        "4014000000000000"
        "c018000000000000");
}

TEST_CASE("RTDE rotation vectors of exact half turns, where there is no sine") {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, 0, -0.8)}) {
    RigidTransform transform = RigidTransform::Identity();
    transform.linear() = 2 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
    const auto values = to_rotation_vector(transform);
    const Eigen::Vector3d vector(values[3], values[4], values[5]);
    CHECK(vector.norm() == Approx(3.141592653589793));
    CHECK(vector.cross(axis).norm() < 1e-9);
  }
}

TEST_CASE("RTDE rotation vectors, nearly half turns among them") {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  for (const Vector3d& axis :
       {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(2, -1, 0.5), Vector3d(-0.1, 0.2, -0.9)})
    for (const double angle : {1e-9, 1e-4, 1.0, 2.9, 3.05, 3.14, 3.14159265}) {
      const Eigen::Matrix3d turned = AngleAxisd(angle, axis.normalized()).toRotationMatrix();
      RigidTransform transform = RigidTransform::Identity();
      transform.linear() = turned;
      const auto values = to_rotation_vector(transform);
      const Vector3d vector(values[3], values[4], values[5]);
      // Back by the series of the exponential, 2^-12 of the turn at a time.
      Eigen::Matrix3d skew;
      skew << 0, -vector.z(), vector.y(), vector.z(), 0, -vector.x(), -vector.y(), vector.x(), 0;
      skew /= 4096;
      Eigen::Matrix3d back = Eigen::Matrix3d::Identity() + skew + skew * skew / 2 +
                             skew * skew * skew / 6 + skew * skew * skew * skew / 24;
      for (int i = 0; i < 12; ++i) back = (back * back).eval();
      INFO(angle << " about " << axis.transpose());
      CHECK((back - turned).norm() < 1e-7);
      CHECK(vector.norm() < 3.1416);
    }
}
