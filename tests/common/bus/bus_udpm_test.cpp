// The bus over real multicast; run under scripts/in-private-network.
#include <arpa/inet.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "common/bus/bus.hpp"
#include "common/bus/crc32c.hpp"
#include "common/time.hpp"

using namespace arcstart;
using namespace std::chrono_literals;

namespace {

image_t image(std::int64_t seq) {
  image_t message{};
  message.utime = utime_now();
  message.run_id = 1;
  message.seq = seq;
  message.width = message.sensor_width = 1600;
  message.height = message.sensor_height = 1200;
  message.size = 1600 * 1200;
  message.data.assign(static_cast<std::size_t>(message.size), static_cast<std::uint8_t>(seq));
  message.crc32c = crc32c(message.data);
  return message;
}

// Handles for as long as the condition does not hold, 5 s at most.
template <class Condition>
bool handle_until(Bus& bus, Condition condition) {
  for (const std::int64_t end = steady_now() + 5'000'000; steady_now() < end && !condition();)
    bus.handle(20ms);
  return condition();
}

void send_datagram(const std::vector<std::uint8_t>& bytes) {
  static const int out =
      socket(AF_INET, SOCK_DGRAM, 0);  // one: fragments go by their sender's port
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(7667);
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  sendto(out, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group),
         sizeof group);
}

}  // namespace

TEST_CASE("2 MB images at 14 Hz and positions beside them arrive whole, all, in order") {
  BusSettings settings;
  Bus sender(settings), receiver(settings);
  REQUIRE(receiver.buffer_warning().empty());
  std::vector<std::int64_t> images, poses;
  receiver.subscribe<image_t>("LASER0_IMAGE", Queue::images(), [&](const image_t& m) {
    CHECK(m.data[12345] == static_cast<std::uint8_t>(m.seq));
    images.push_back(m.seq);
  });
  receiver.subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(),
                                   [&](const robot_pose_t& m) { poses.push_back(m.seq); });
  receiver.handle(50ms);
  for (int frame = 0; frame < 14; ++frame) {
    sender.publish("LASER0_IMAGE", image(frame));
    for (int i = 0; i < 10; ++i) {
      robot_pose_t pose{};
      pose.utime = pose.run_id = 1;
      pose.seq = 10 * frame + i;
      pose.quaternion[0] = 1;
      sender.publish("ROBOT0_POSE", pose);
    }
    receiver.handle(70ms);
  }
  CHECK(handle_until(receiver, [&] { return images.size() == 14 && poses.size() == 140; }));
  CHECK(std::is_sorted(images.begin(), images.end()));
  CHECK(std::is_sorted(poses.begin(), poses.end()));
}

TEST_CASE("too few file descriptors are no missing route") {
  rlimit old{};
  getrlimit(RLIMIT_NOFILE, &old);
  const int next = dup(0);  // the lowest that is free
  close(next);
  rlimit few = old;
  few.rlim_cur = static_cast<rlim_t>(next) + 3;
  setrlimit(RLIMIT_NOFILE, &few);
  std::string words;
  try {
    Bus bus{BusSettings{}};
  } catch (const BusError& error) {
    words = error.what();
  }
  setrlimit(RLIMIT_NOFILE, &old);
  CHECK_THAT(words, Catch::Contains("more files") && Catch::Contains("ulimit -n"));
  CHECK_NOTHROW(Bus{BusSettings{}});
}

TEST_CASE("a port of its own carries the images alone") {
  BusSettings split;
  split.image_port = 7668;
  Bus sender(split), whole(split), without(BusSettings{});
  int images = 0, poses = 0, others = 0;
  whole.subscribe<image_t>("LASER0_IMAGE", Queue::images(), [&](const image_t&) { ++images; });
  whole.subscribe<scan_t>("LASER0_SCAN", Queue::newest(), [&](const scan_t&) { ++poses; });
  without.subscribe_pattern(
      ".*", Queue::newest(),
      [&](const Bus::Bytes&, const std::string& channel) { others += channel == "LASER0_IMAGE"; });
  whole.handle(50ms);
  without.handle(50ms);
  sender.publish("LASER0_IMAGE", image(1));
  scan_t scan{};
  scan.utime = scan.run_id = 1;
  sender.publish("LASER0_SCAN", scan);
  CHECK(handle_until(whole, [&] { return images == 1 && poses == 1; }));
  without.handle(50ms);
  CHECK(others == 0);
}

TEST_CASE("an image of which fragments came twice and others never is dropped") {
  // liblcm counts fragments, not which, and hands out what an earlier message left in its place.
  Bus bus{BusSettings{}};
  int images = 0;
  bus.subscribe<image_t>("LASER0_IMAGE", Queue::images(), [&](const image_t&) { ++images; });
  bus.handle(50ms);
  constexpr std::size_t kFragment = 64'000;
  const auto send_fragments = [&](const image_t& sent, std::uint32_t number, bool whole) {
    std::vector<std::uint8_t> message(static_cast<std::size_t>(sent.getEncodedSize()));
    sent.encode(message.data(), 0, static_cast<int>(message.size()));
    const std::size_t count = (message.size() + kFragment - 1) / kFragment;
    for (std::size_t i = 0; i < count; ++i) {
      // Of the broken one the second half is left out, and the first sent twice in its place.
      const std::size_t fragment = whole || i < count / 2 ? i : i - count / 2 + 1;
      std::vector<std::uint8_t> bytes = {'L', 'C', '0', '3'};
      const auto add = [&](std::size_t value, int size) {
        while (size-- > 0) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * size)));
      };
      add(number, 4);
      add(message.size(), 4);
      add(fragment * kFragment, 4);
      add(fragment, 2);
      add(count, 2);
      if (fragment == 0)
        for (const char character : std::string("LASER0_IMAGE") + '\0')
          bytes.push_back(static_cast<std::uint8_t>(character));
      const std::size_t end = std::min(message.size(), (fragment + 1) * kFragment);
      bytes.insert(bytes.end(), message.begin() + static_cast<std::ptrdiff_t>(fragment * kFragment),
                   message.begin() + static_cast<std::ptrdiff_t>(end));
      send_datagram(bytes);
    }
  };
  send_fragments(image(1), 1, true);
  CHECK(handle_until(bus, [&] { return images == 1; }));
  send_fragments(image(2), 2, false);
  CHECK(handle_until(bus, [&] { return bus.undecodable() == 1; }));
  CHECK(images == 1);
  CHECK_THAT(bus.last_error(), Catch::Contains("CRC-32C"));
  send_fragments(image(3), 3, true);
  CHECK(handle_until(bus, [&] { return images == 2; }));
}

TEST_CASE("hostile datagrams are counted and survived") {
  Bus bus{BusSettings{}};
  int images = 0;
  bus.subscribe<image_t>("LASER0_IMAGE", Queue::images(), [&](const image_t&) { ++images; });
  bus.handle(50ms);
  image_t small = image(1);
  small.width = small.height = 2;
  small.size = 4;
  small.data.assign(4, 9);
  small.crc32c = crc32c(small.data);
  const auto datagram = [&](const std::vector<std::uint8_t>& body) {
    std::vector<std::uint8_t> bytes = {'L', 'C', '0', '2', 0, 0, 0, 1};
    for (const char character : std::string("LASER0_IMAGE"))
      bytes.push_back(static_cast<std::uint8_t>(character));
    bytes.push_back(0);
    bytes.insert(bytes.end(), body.begin(), body.end());
    return bytes;
  };
  std::vector<std::uint8_t> good(static_cast<std::size_t>(small.getEncodedSize()));
  small.encode(good.data(), 0, static_cast<int>(good.size()));
  for (const std::uint32_t count : {0xFFFFFFFFu, 0x7FFFFFFFu, 1'000'000'000u}) {
    auto bad = good;
    for (int i = 0; i < 4; ++i)
      bad[bad.size() - 8 + static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(count >> (24 - 8 * i));
    send_datagram(datagram(bad));
  }
  auto wrong_hash = good;
  wrong_hash[0] ^= 0xFF;
  send_datagram(datagram(wrong_hash));
  send_datagram(datagram({good.begin(), good.begin() + 20}));
  send_datagram({'L', 'C'});
  send_datagram(datagram({}));
  send_datagram(datagram(good));
  CHECK(handle_until(bus, [&] { return images == 1; }));
  CHECK(bus.undecodable() == 6);
}
