#include "services/cell_simulator/robot/hspo_packet.hpp"

#include <fmt/core.h>

#include <catch2/catch.hpp>

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

// In groups as a protocol analyser shows them.
std::string hexadecimal(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const auto byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

TEST_CASE("the tool's packet is the published example, byte by byte") {
  HspoReport report;
  report.index = 7;
  report.clock = 1'000'000;
  report.tool = {985, 0, 940, 180, 0, 0};
  CHECK(hexadecimal(hspo_packet(report)) ==
        "00000001"
        "00000007"
        "000f4240"
        "0001"
        "0001"
        "44764000"
        "00000000"
        "446b0000"
        "43340000"
        "00000000"
        "00000000"
        "00000000"
        "00000000");
}

TEST_CASE("the joints' packet has 60 bytes: nine joints from byte 16, status at 52, I/O at 56") {
  HspoReport report;
  report.index = 0xffffffff;
  report.clock = 0x80000001;
  report.joints = {1, -2, 0.5f, 0, 0, 0, 0, 0, -1};
  const auto bytes = hspo_packet(report);
  CHECK(bytes.size() == 60);
  CHECK(hexadecimal(bytes) ==
        "00000001"
        "ffffffff"
        "80000001"
        "0004"
        "0001"
        "3f800000"
        "c0000000"
        "3f000000"
        "00000000"
        "00000000"
        "00000000"
        "00000000"
        "00000000"
        "bf800000"
        "0000000000000000");
}

TEST_CASE(
    "both go into one packet, the tool's section first, each with its group, status and I/O") {
  HspoReport report;
  report.motion_group = 2;
  report.tool = {1, 0, 0, 0, 0, 0};
  report.joints = {1, 0, 0, 0, 0, 0, 0, 0, 0};
  const auto bytes = hspo_packet(report);
  REQUIRE(bytes.size() == 94);
  const std::string text = hexadecimal(bytes);
  CHECK(text.substr(2 * 12, 4) == "0005");
  CHECK(text.substr(2 * 14, 4) == "0002");
  CHECK(text.substr(2 * 16, 8) == "3f800000");
  CHECK(text.substr(2 * 40, 16) == "0000000000000000");
  CHECK(text.substr(2 * 48, 4) == "0002");
  CHECK(text.substr(2 * 50, 8) == "3f800000");
  CHECK(text.substr(2 * 86) == "0000000000000000");
}
