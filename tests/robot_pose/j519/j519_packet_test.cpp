#include "services/robot_pose/j519/j519_packet.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/robot_pose/j519/j519_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

TEST_CASE("J519: what is sent, byte by byte: start, stop and the capability question") {
  CHECK(j519_start(4) == from_hex("000000c8 00000004"));
  CHECK(j519_stop(3) == from_hex("00000002 00000003"));
  CHECK(j519_capability_question() ==
        from_hex("00000007 00000003 00000001 00000000 00000000 00000000 00000000"));
}

TEST_CASE("J519: a status of version 3, written out") {
  auto bytes = from_hex(
      "000000ca 00000003 00000007 0d000000 000003e8"
      "44764000 00000000 446b0000 43340000 00000000 c2b40000 00000000 00000000 00000000"
      "3f800000 c0000000 3f000000 00000000 42b40000 00000000 00000000 00000000 00000000");
  REQUIRE(bytes.size() == 92);
  bytes.resize(388);
  const DecodedJ519 decoded = decode_j519(bytes);
  REQUIRE(decoded.error == "");
  REQUIRE(decoded.status.has_value());
  CHECK_FALSE(decoded.capability.has_value());
  CHECK(decoded.status->version == 3);
  CHECK(decoded.status->sequence == 7);
  CHECK(decoded.status->time_stamp == 1000);
  CHECK(decoded.status->position == std::array<double, 9>{985, 0, 940, 180, 0, -90, 0, 0, 0});
  CHECK(decoded.status->joints == std::array<double, 9>{1, -2, 0.5, 0, 90, 0, 0, 0, 0});
}

TEST_CASE("J519: sizes by version, and the same fields in both") {
  CHECK(j519_status(3, 1, 1).size() == 388);
  CHECK(j519_status(4, 1, 1).size() == 416);
  for (const std::uint32_t version : {3u, 4u}) {
    const DecodedJ519 decoded = decode_j519(j519_status(version, 0xffffffff, 0x80000001, 12.5f));
    REQUIRE(decoded.status.has_value());
    CHECK(decoded.status->version == version);
    CHECK(decoded.status->sequence == 0xffffffff);
    CHECK(decoded.status->time_stamp == 0x80000001);
    CHECK(decoded.status->position[0] == 12.5);
    CHECK(decoded.status->joints[8] == 9);
  }
}

TEST_CASE("J519: the controller's capability, byte by byte") {
  const DecodedJ519 decoded =
      decode_j519(from_hex("00000007 00000003 00000001 00000008 00000005 00000004 00000001"));
  REQUIRE(decoded.capability.has_value());
  CHECK(decoded.capability->sampling_ms == 8);
  CHECK(decoded.capability->available_version == 4);
  CHECK(decoded.capability->tool);
  CHECK_FALSE(decode_j519(j519_capability(3, 0)).capability->tool);
  CHECK(decode_j519(j519_capability(3, 2)).error.find("rob_status_use_tcp 2") != std::string::npos);
  CHECK(decode_j519(j519_capability(3, 1, 0)).error.find("0 ms") != std::string::npos);
}

TEST_CASE("J519: packets of any other size are refused in one line") {
  for (const auto& whole : {j519_status(3, 1, 1), j519_status(4, 1, 1), j519_capability(4, 1)})
    for (std::size_t size = 0; size < 450; ++size) {
      if (size == whole.size()) continue;
      auto bytes = whole;
      bytes.resize(size);
      const DecodedJ519 decoded = decode_j519(bytes);
      CHECK_FALSE((decoded.status || decoded.capability));
      CHECK(decoded.error.find(std::to_string(size)) != std::string::npos);
      CHECK(decoded.error.find('\n') == std::string::npos);
    }
}

TEST_CASE("J519: what is not understood is refused with its reason") {
  auto bytes = j519_status(4, 1, 1);
  SECTION("another version in the form") {
    bytes[7] = 3;
    CHECK(decode_j519(bytes).error.find("version 3 in the form of version 4") != std::string::npos);
  }
  SECTION("the oldest form") {
    CHECK(decode_j519(Bytes().zeros(132).data).error.find("oldest form") != std::string::npos);
  }
  SECTION("HSPO's packet") {
    CHECK(decode_j519(from_hex("00000001 00000007 000f4240 0001 0001"))
              .error.find("not a J519 packet: it begins with 00000001") != std::string::npos);
  }
  SECTION("positions that are none") {
    const float bad = GENERATE(std::numeric_limits<float>::quiet_NaN(),
                               -std::numeric_limits<float>::infinity(), 2e5f);
    CHECK(decode_j519(j519_status(3, 1, 1, bad)).error.find("a position that is none") !=
          std::string::npos);
  }
}

TEST_CASE("J519: hostile bytes are either a packet or a reason") {
  std::mt19937 random(6);
  for (int i = 0; i < 20'000; ++i) {
    auto bytes = random() % 3 == 0 ? j519_capability(4, 1) : j519_status(3 + random() % 2, 9, 9);
    if (random() % 4 == 0) bytes.resize(random() % 500);
    for (std::uint32_t flips = random() % 5; flips > 0 && !bytes.empty(); --flips)
      bytes[random() % std::min<std::size_t>(bytes.size(), 100)] =
          static_cast<std::uint8_t>(random());
    const DecodedJ519 decoded = decode_j519(bytes);
    REQUIRE((decoded.status || decoded.capability) == decoded.error.empty());
    if (!decoded.status) continue;
    for (const double value : decoded.status->position) REQUIRE(std::abs(value) < 1e5);
    for (const double value : decoded.status->joints) REQUIRE(std::isfinite(value));
  }
}
