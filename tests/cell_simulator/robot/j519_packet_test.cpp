#include "services/cell_simulator/robot/j519_packet.hpp"

#include <fmt/core.h>

#include <catch2/catch.hpp>

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

std::string hex_of(const std::vector<std::uint8_t>& bytes, std::size_t from, std::size_t count) {
  std::string text;
  for (std::size_t i = from; i < from + count; ++i) text += fmt::format("{:02x}", bytes.at(i));
  return text;
}

J519Place place(std::uint32_t version) {
  return {version, 7, 1000, {985, 0, 940, 180, 0, -90}, {1, -2, 0.5, 0, 90, 0}};
}

}  // namespace

TEST_CASE("J519 status: header, position, joints, and where each version goes on") {
  const std::string common =
      "44764000"
      "00000000"
      "446b0000"
      "43340000"
      "00000000"
      "c2b40000"  // X to R
      "00000000"
      "00000000"
      "00000000"  // E1 to E3
      "3f800000"
      "c0000000"
      "3f000000"
      "00000000"
      "42b40000"
      "00000000"  // J1 to J6
      "00000000"
      "00000000"
      "00000000";
  const auto older = j519_status_bytes(place(3)), newer = j519_status_bytes(place(4));
  REQUIRE(older.size() == 388);
  REQUIRE(newer.size() == 416);
  CHECK(hex_of(older, 0, 20) ==
        "000000ca"
        "00000003"
        "00000007"
        "05000000"
        "000003e8");
  CHECK(hex_of(newer, 0, 20) ==
        "000000cc"
        "00000004"
        "00000007"
        "05000000"
        "000003e8");
  for (const auto& bytes : {older, newer}) {
    CHECK(hex_of(bytes, 20, 72) == common);
    CHECK(hex_of(bytes, 92, 36) == std::string(72, '0'));  // currents
    CHECK(hex_of(bytes, 128, 4) == "3f800000");            // safety scale
    CHECK(hex_of(bytes, 132, bytes.size() - 132) == std::string(2 * (bytes.size() - 132), '0'));
  }
}

TEST_CASE("J519 capability: 28 bytes") {
  const auto bytes = j519_capability_bytes(8, 4, true);
  CHECK(hex_of(bytes, 0, bytes.size()) ==
        "00000007"
        "00000003"
        "00000001"
        "00000008"
        "00000000"
        "00000004"
        "00000001");
}

TEST_CASE("J519 requests: start, stop and capability are understood, a motion command is not") {
  CHECK(understand_j519({0, 0, 0, 200, 0, 0, 0, 4})->what == J519Request::kStart);
  CHECK(understand_j519({0, 0, 0, 200, 0, 0, 0, 4})->version == 4);
  CHECK(understand_j519({0, 0, 0, 2, 0, 0, 0, 3})->what == J519Request::kStop);
  std::vector<std::uint8_t> question(28);
  question[3] = 7;
  CHECK(understand_j519(question)->what == J519Request::kCapability);
  question[3] = 8;  // would set it
  CHECK_FALSE(understand_j519(question));
  std::vector<std::uint8_t> command(344);
  command[3] = 201;
  CHECK_FALSE(understand_j519(command));
  CHECK_FALSE(understand_j519({}));
}
