#include "common/bus/bus.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace arcstart;
using namespace std::chrono_literals;

namespace {

robot_pose_t pose(std::int64_t seq) {
  robot_pose_t message{};
  message.utime = 1000 + seq;
  message.run_id = 1;
  message.seq = seq;
  message.quaternion[0] = 1;
  return message;
}

template <class Message>
Bus::Bytes encoded(const Message& message) {
  Bus::Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

TEST_CASE("messages arrive every one, in order, over memq") {
  const auto bus = Bus::in_memory();
  std::vector<std::int64_t> seen;
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(),
                               [&](const robot_pose_t& m) { seen.push_back(m.seq); });
  for (int i = 0; i < 100; ++i) bus->publish("ROBOT0_POSE", pose(i));
  CHECK(bus->handle(0ms));
  REQUIRE(seen.size() == 100);
  for (int i = 0; i < 100; ++i) CHECK(seen[static_cast<std::size_t>(i)] == i);
  CHECK(bus->received() == 100);
  CHECK(bus->sent() == 100);
  CHECK_FALSE(bus->handle(0ms));
}

TEST_CASE("what a handler publishes is handled in the same call, stage after stage") {
  const auto bus = Bus::in_memory();
  int last = -1;
  bus->subscribe<robot_pose_t>("A", Queue::measurements(),
                               [&](const robot_pose_t& m) { bus->publish("B", m); });
  bus->subscribe<robot_pose_t>("B", Queue::measurements(),
                               [&](const robot_pose_t& m) { last = static_cast<int>(m.seq); });
  bus->publish("A", pose(7));
  bus->handle(0ms);
  CHECK(last == 7);
}

TEST_CASE("a channel is a name, not a pattern") {
  const auto bus = Bus::in_memory();
  int count = 0;
  bus->subscribe<robot_pose_t>("ROBOT.", Queue::measurements(),
                               [&](const robot_pose_t&) { ++count; });
  bus->publish("ROBOT0", pose(1));
  bus->publish("ROBOT.", pose(1));
  bus->handle(0ms);
  CHECK(count == 1);
}

TEST_CASE("newest-only keeps the newest of each channel") {
  const auto bus = Bus::in_memory();
  std::vector<std::int64_t> seen;
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::newest(),
                               [&](const robot_pose_t& m) { seen.push_back(m.seq); });
  for (int i = 0; i < 5; ++i) bus->publish("ROBOT0_POSE", pose(i));
  bus->handle(0ms);
  CHECK(seen == std::vector<std::int64_t>{4});
}

TEST_CASE("what falls over a full queue is counted") {
  const auto bus = Bus::in_memory();
  int count = 0;
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", {3, 1 << 20, false},
                               [&](const robot_pose_t&) { ++count; });
  for (int i = 0; i < 5; ++i) bus->publish("ROBOT0_POSE", pose(i));
  bus->handle(0ms);
  CHECK(count == 3);
  CHECK(bus->overflowed() == 2);
  CHECK_THAT(bus->last_error(), Catch::Contains("ROBOT0_POSE"));
}

TEST_CASE("the bytes of a queue are bounded too") {
  const auto bus = Bus::in_memory();
  int count = 0;
  const std::size_t size = encoded(pose(0)).size();
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", {100, 2 * size, false},
                               [&](const robot_pose_t&) { ++count; });
  for (int i = 0; i < 5; ++i) bus->publish("ROBOT0_POSE", pose(i));
  bus->handle(0ms);
  CHECK(count == 2);
  CHECK(bus->overflowed() == 3);
}

TEST_CASE("what is not the type, is damaged or has no meaning is counted and dropped") {
  const auto bus = Bus::in_memory();
  int count = 0;
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(),
                               [&](const robot_pose_t&) { ++count; });
  const auto send = [&](Bus::Bytes bytes) {
    bus->publish_bytes("ROBOT0_POSE", bytes);
    bus->handle(0ms);
  };
  const Bus::Bytes good = encoded(pose(1));
  Bus::Bytes bytes = good;
  bytes[3] ^= 1;  // the hash
  send(bytes);
  CHECK(bus->undecodable() == 1);
  for (std::size_t size = 0; size < good.size(); ++size)
    send({good.begin(), good.begin() + static_cast<long>(size)});
  CHECK(bus->undecodable() == 1 + static_cast<std::int64_t>(good.size()));
  bytes = good;
  bytes.push_back(0);  // trailing garbage
  send(bytes);
  scan_t other{};
  send(encoded(other));
  robot_pose_t nan = pose(2);
  nan.position[1] = std::numeric_limits<double>::quiet_NaN();
  send(encoded(nan));
  CHECK_THAT(bus->last_error(),
             Catch::Contains("ROBOT0_POSE") && Catch::Contains("position not finite"));
  CHECK(bus->undecodable() == 4 + static_cast<std::int64_t>(good.size()));
  CHECK(count == 0);
  send(good);
  CHECK(count == 1);
}

TEST_CASE("what a handler throws comes out of handle and the rest is handled later") {
  const auto bus = Bus::in_memory();
  int count = 0;
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(), [&](const robot_pose_t& m) {
    if (m.seq == 0) throw std::runtime_error("handler");
    ++count;
  });
  bus->publish("ROBOT0_POSE", pose(0));
  bus->publish("ROBOT0_POSE", pose(1));
  CHECK_THROWS_WITH(bus->handle(0ms), "handler");
  bus->handle(0ms);
  CHECK(count == 1);
}

TEST_CASE("a group that is none is refused with what to do") {
  BusSettings settings;
  settings.group = "no-address";
  CHECK_THROWS_AS(Bus(settings), BusError);
}
