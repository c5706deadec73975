#include "services/robot_pose/hspo/hspo_packet.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/robot_pose/hspo/hspo_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

namespace {

// As the layout's table gives it.
std::vector<std::uint8_t> example() {
  return from_hex(
      "00000001 00000007 000f4240 0001 0001 44764000 00000000 446b0000 43340000 00000000 00000000 "
      "00000000 00000000");
}

// A packet of any types with random values.
struct Random {
  std::mt19937 generator{11};
  float value() { return std::uniform_real_distribution<float>(-3000, 3000)(generator); }
};

}  // namespace

TEST_CASE("HSPO: the layout's example") {
  REQUIRE(example().size() == 48);
  const DecodedHspo decoded = decode_hspo(example());
  REQUIRE(decoded.error == "");
  REQUIRE(decoded.packet.has_value());
  CHECK(decoded.packet->index == 7);
  CHECK(decoded.packet->clock == 1'000'000);
  CHECK(decoded.packet->types == 1);
  CHECK(decoded.packet->motion_group == 1);
  CHECK(decoded.packet->tool == std::array<double, 6>{985, 0, 940, 180, 0, 0});
  CHECK_FALSE(decoded.packet->joints.has_value());
}

TEST_CASE("HSPO: sizes of the packets with one section") {
  CHECK(tool_packet(1, 1).size() == 48);
  CHECK(joint_packet(1, 1).size() == 60);
  const DecodedHspo decoded = decode_hspo(joint_packet(3, 4));
  REQUIRE(decoded.packet.has_value());
  CHECK_FALSE(decoded.packet->tool.has_value());
  REQUIRE(decoded.packet->joints.has_value());
  for (int i = 0; i < 9; ++i)
    CHECK((*decoded.packet->joints)[static_cast<std::size_t>(i)] ==
          static_cast<double>(0.1f * static_cast<float>(i + 1)));
}

TEST_CASE("HSPO: every combination of sections is read back, commanded ones are not") {
  Random random;
  for (std::uint32_t types = 1; types < 32; ++types) {
    const auto index = static_cast<std::uint32_t>(random.generator());
    const auto clock = static_cast<std::uint32_t>(random.generator());
    Bytes bytes = header(index, clock, types);
    std::vector<double> tool, joints;
    for (const std::uint32_t bit : {1u, 2u, 4u, 8u, 16u}) {
      if (!(types & bit)) continue;
      if (bit != 16) bytes.u16(2);
      const int count = bit <= 2 ? 6 : bit <= 8 ? 9 : 10;
      for (int i = 0; i < count; ++i) {
        const float value = random.value();
        bytes.f32(value);
        if (bit == 1) tool.push_back(value);
        if (bit == 4) joints.push_back(value);
      }
      if (bit != 16) bytes.u32(0xffffffff).u32(0x7fc00000);
    }
    const DecodedHspo decoded = decode_hspo(bytes.data);
    INFO("types " << types << ": " << decoded.error);
    REQUIRE(decoded.packet.has_value());
    CHECK(decoded.packet->index == index);
    CHECK(decoded.packet->clock == clock);
    CHECK(decoded.packet->motion_group.has_value() == (types != 16));
    CHECK(decoded.packet->tool.has_value() == !tool.empty());
    CHECK(decoded.packet->joints.has_value() == !joints.empty());
    if (!tool.empty()) CHECK(std::equal(tool.begin(), tool.end(), decoded.packet->tool->begin()));
    if (!joints.empty())
      CHECK(std::equal(joints.begin(), joints.end(), decoded.packet->joints->begin()));
  }
}

TEST_CASE("HSPO: packets of any other size are refused") {
  const auto whole = example();
  for (std::size_t size = 0; size < 400; ++size) {
    if (size == whole.size()) continue;
    auto bytes = whole;
    bytes.resize(size);
    const DecodedHspo decoded = decode_hspo(bytes);
    CHECK_FALSE(decoded.packet.has_value());
    CHECK(decoded.error.find('\n') == std::string::npos);
    CHECK(decoded.error.find(std::to_string(size)) != std::string::npos);
  }
}

TEST_CASE("HSPO: what is not understood is refused with its reason") {
  auto bytes = example();
  SECTION("version") {
    bytes[1] = 1;
    CHECK(decode_hspo(bytes).error.find("not an HSPO packet") != std::string::npos);
  }
  SECTION("the version's low half says nothing") {
    bytes[2] = 0xab;
    CHECK(decode_hspo(bytes).packet.has_value());
  }
  SECTION("no type, unknown type") {
    bytes[13] = 0;
    CHECK(decode_hspo(bytes).error.find("unknown type 0") != std::string::npos);
    bytes[13] = 32;
    CHECK(decode_hspo(bytes).error.find("unknown type 32") != std::string::npos);
    bytes[12] = 0x80, bytes[13] = 1;
    CHECK(decode_hspo(bytes).error.find("unknown type 32769") != std::string::npos);
  }
  SECTION("XML") {
    const std::string text = "<?xml version=\"1.0\"?><HSPO/>";
    const DecodedHspo decoded = decode_hspo(std::vector<std::uint8_t>(text.begin(), text.end()));
    CHECK_FALSE(decoded.packet.has_value());
    CHECK(decoded.error.find("XML") != std::string::npos);
  }
  SECTION("positions that are not finite") {
    const float bad =
        GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                 -std::numeric_limits<float>::infinity());
    CHECK(decode_hspo(tool_packet(1, 1, bad)).error.find("not finite") != std::string::npos);
  }
  SECTION("two motion groups in one packet") {
    Bytes mixed = header(1, 1, 5).u16(1);
    for (int i = 0; i < 6; ++i) mixed.f32(1);
    mixed.u32(0).u32(0).u16(2);
    for (int i = 0; i < 9; ++i) mixed.f32(1);
    mixed.u32(0).u32(0);
    CHECK(decode_hspo(mixed.data).error.find("mixes motion groups 1 and 2") != std::string::npos);
  }
}

TEST_CASE("HSPO: a million hostile bytes are either a packet or a reason") {
  std::mt19937 random(5);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> bytes = random() % 2 ? example() : joint_packet(9, 9);
    if (random() % 4 == 0) bytes.resize(random() % 100);
    for (std::uint32_t flips = random() % 5; flips > 0 && !bytes.empty(); --flips)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    const DecodedHspo decoded = decode_hspo(bytes);
    REQUIRE(decoded.packet.has_value() == decoded.error.empty());
    if (!decoded.packet || !decoded.packet->tool) continue;
    for (const double value : *decoded.packet->tool) REQUIRE(std::isfinite(value));
  }
}
