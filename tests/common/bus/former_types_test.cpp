// Messages in the layout of the version before: told as such, once a channel, and never decoded.
#include "common/bus/former_types.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"

using namespace arcstart;
using namespace std::chrono_literals;

namespace {

// A message begins with its type's hash; what follows does not matter.
std::vector<std::uint8_t> beginning_with(std::uint64_t hash) {
  std::vector<std::uint8_t> bytes(400, 0);
  for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
  return bytes;
}

template <class Message>
void check_former(std::uint64_t former_hash) {
  const std::string type = Message::getTypeName();
  INFO(type);
  CHECK(static_cast<std::uint64_t>(Message::getHash()) != former_hash);
  CHECK(former_type(beginning_with(former_hash)) == type);
  const auto now = beginning_with(static_cast<std::uint64_t>(Message::getHash()));
  CHECK(former_type(now).empty());

  const auto bus = Bus::in_memory();
  int handled = 0;
  for (const char* channel : {"LASER0_A", "LASER1_A"})
    bus->subscribe<Message>(channel, Queue::measurements(), [&](const Message&) { ++handled; });
  std::vector<std::string> warnings;
  for (int i = 0; i < 50; ++i) {
    for (const char* channel : {"LASER0_A", "LASER1_A"})
      bus->publish_bytes(channel, beginning_with(former_hash));
    bus->handle(0ms);
    while (auto warning = bus->next_warning()) warnings.push_back(*warning);
  }
  CHECK(handled == 0);
  CHECK(bus->undecodable() == 100);
  REQUIRE(warnings.size() == 2);
  std::sort(warnings.begin(), warnings.end());
  CHECK_THAT(warnings[0], Catch::Contains("LASER0_A") && Catch::Contains(type) &&
                              Catch::Contains("of the version before") && !Catch::Contains("\n"));
  CHECK_THAT(warnings[1], Catch::Contains("LASER1_A"));
  CHECK_THAT(bus->last_error(), Catch::Contains("of the version before"));
}

}  // namespace

TEST_CASE("every type that has changed is known by its former hash") {
  check_former<calibration_t>(0xcc0bc3c8dfcfe2cb);
  check_former<camera_command_t>(0x41468eb3e0ffa7b7);
  check_former<image_t>(0x3c000d0d77f4ada4);
  check_former<profile_t>(0x3878b0cb49009ba6);
  check_former<robot_pose_t>(0x1b180dbd77ef4b7b);
  check_former<scan_command_t>(0x21ed00ebdb693557);
  check_former<scan_t>(0x40b1b1f24f20b6dc);
  check_former<seam_t>(0x34d1f5e9588532a3);
  check_former<stripe_t>(0x54c036e723b96b52);
}

TEST_CASE("what is damaged, or of another type, is not taken for a former version") {
  CHECK(former_type({}).empty());
  CHECK(former_type(std::vector<std::uint8_t>(7, 0)).empty());
  const auto bus = Bus::in_memory();
  bus->subscribe<scan_t>("A", Queue::measurements(), [](const scan_t&) {});
  bus->publish_bytes("A", beginning_with(0x1234567812345678));
  bus->handle(0ms);
  CHECK(bus->undecodable() == 1);
  CHECK_FALSE(bus->next_warning());
  CHECK_THAT(bus->last_error(), Catch::Contains("not a scan_t of this version, or damaged"));
}
