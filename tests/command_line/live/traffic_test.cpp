#include "services/command_line/live/traffic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

using namespace arcstart;
using namespace arcstart::command_line;
using Catch::Matchers::Contains;

namespace {

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

robot_pose_t position(std::int64_t utime, std::int64_t run_id, std::int64_t seq) {
  robot_pose_t pose{};
  pose.utime = utime;
  pose.run_id = run_id;
  pose.seq = seq;
  pose.quaternion[0] = 1;
  return pose;
}

constexpr std::int64_t kOneSecond = 1'000'000;

const nlohmann::json& line(const nlohmann::json& list, const std::string& channel) {
  for (const auto& entry : list)
    if (entry["channel"] == channel) return entry;
  FAIL("no line for " + channel);
  return list;
}

}  // namespace

TEST_CASE("rate and size are those of what came") {
  Traffic traffic;
  std::int64_t now = 100 * kOneSecond;
  traffic.tick(now);
  for (int i = 0; i < 500; ++i) {  // 10 s at 50 Hz
    now += 20'000;
    traffic.take("ROBOT0_POSE", bytes_of(position(now, 1, i)), now);
    traffic.take("OTHER", std::vector<std::uint8_t>(100), now);
    if (i % 50 == 49) traffic.tick(now);
  }
  const auto list = traffic.json(now, now + 3000);
  CHECK(line(list, "ROBOT0_POSE")["rate_hz"] == Approx(50));
  CHECK(line(list, "ROBOT0_POSE")["messages"] == 500);
  CHECK(line(list, "ROBOT0_POSE")["age_s"] == Approx(0.003));
  CHECK(line(list, "ROBOT0_POSE")["gaps"] == 0);
  CHECK(line(list, "OTHER")["bytes_per_s"] == Approx(5000));
  CHECK(line(list, "OTHER")["size_bytes"] == 100);
  CHECK_FALSE(line(list, "OTHER").contains("gaps"));

  // Silent for 5 s: the rate is 0 and the age grows.
  for (int i = 0; i < 6; ++i) traffic.tick(now += kOneSecond);
  CHECK(line(traffic.json(now, now), "ROBOT0_POSE")["rate_hz"] == 0);
  CHECK(line(traffic.json(now, now), "ROBOT0_POSE")["age_s"] == Approx(6));
  CHECK(line(traffic.json(now, now), "OTHER")["age_s"] == Approx(6));
}

TEST_CASE("gaps are counted by seq, anew with each run") {
  Traffic traffic;
  for (const std::int64_t seq : {5, 6, 9, 8, 10})
    traffic.take("ROBOT0_POSE", bytes_of(position(1, 1, seq)), 1);
  traffic.take("ROBOT0_POSE", bytes_of(position(1, 2, 3)), 1);
  CHECK(line(traffic.json(2, 2), "ROBOT0_POSE")["gaps"] == 2);
  // A hostile seq must not overflow the sum.
  for (const std::int64_t seq : {std::int64_t{4}, std::numeric_limits<std::int64_t>::max()})
    traffic.take("ROBOT0_POSE", bytes_of(position(1, 2, seq)), 1);
  traffic.take("ROBOT0_POSE", bytes_of(position(1, 3, 0)), 1);
  traffic.take("ROBOT0_POSE", bytes_of(position(1, 3, std::numeric_limits<std::int64_t>::max())),
               1);
  CHECK(line(traffic.json(2, 2), "ROBOT0_POSE")["gaps"] ==
        std::numeric_limits<std::int64_t>::max());
}

TEST_CASE("what is no message of the channel's type is counted as undecodable") {
  Traffic traffic;
  auto bytes = bytes_of(position(1, 1, 1));
  traffic.take("ROBOT0_POSE", bytes, 1);
  bytes.push_back(0);
  traffic.take("ROBOT0_POSE", bytes, 1);
  traffic.take("ROBOT0_POSE", {}, 1);
  auto senseless = position(1, 1, 2);
  senseless.position[1] = std::numeric_limits<double>::quiet_NaN();
  traffic.take("ROBOT0_POSE", bytes_of(senseless), 1);
  for (const std::string channel : {"A_IMAGE", "A_PREVIEW", "A_STRIPE", "A_PROFILE", "A_SCAN",
                                    "A_SCAN_COMMAND", "A_CAMERA_COMMAND", "A_CALIBRATION", "A_SEAM",
                                    "A_ANY_STATUS", "CELL_COMMAND", "CELL_TRUTH"}) {
    traffic.take(channel, bytes, 1);
    CHECK(line(traffic.json(2, 2), channel)["undecodable"] == 1);
  }
  CHECK(line(traffic.json(2, 2), "ROBOT0_POSE")["undecodable"] == 3);
}

TEST_CASE("states are shown, and nothing unprintable reaches the terminal") {
  Traffic traffic;
  service_status_t status{};
  status.utime = status.run_id = 1;
  status.state = service_status_t::DEGRADED;
  status.last_error = "camera\n\x1b[31mlost";
  traffic.take("LASER0_SENSOR_CAPTURE_STATUS", bytes_of(status), 1);
  scan_t scan{};
  scan.utime = scan.run_id = 1;
  scan.state = scan_t::SCANNING;
  scan.images = 12;
  traffic.take("LASER0_SCAN", bytes_of(scan), 1);
  traffic.take("\x1b[2J\xff bad\nname", {}, 1);
  const std::string table = traffic.table(2, 2);
  CHECK_THAT(table, Contains("degraded: camera\\x0a\\x1b[31mlost") &&
                        Contains("scanning, 12 images") && Contains("\\x1b[2J\\xff bad\\x0aname"));
  for (const char character : table)
    CHECK(((character >= ' ' && character < 0x7f) || character == '\n'));
  CHECK(std::count(table.begin(), table.end(), '\n') == 4);
}

TEST_CASE("two senders of one channel are shown, a message that comes twice is not a gap") {
  Traffic traffic;
  std::int64_t seq = 0;
  const auto take = [&](std::int64_t run_id) {
    traffic.take("ROBOT0_POSE", bytes_of(position(1, run_id, ++seq)), 1);
  };
  take(100);
  take(100);
  traffic.take("ROBOT0_POSE", bytes_of(position(1, 100, seq)), 1);
  CHECK_FALSE(line(traffic.json(2, 2), "ROBOT0_POSE").contains("state"));
  take(200);
  take(100);
  CHECK_THAT(line(traffic.json(2, 2), "ROBOT0_POSE")["state"].get<std::string>(),
             Contains("two senders: runs 100 and 200"));
}

TEST_CASE("the preview tells whether the laser is on") {
  Traffic traffic;
  image_t preview{};
  preview.utime = preview.run_id = 1;
  preview.scan_index = -1;
  preview.incomplete = "only its header matters here";
  traffic.take("LASER0_PREVIEW", bytes_of(preview), 1);
  CHECK(line(traffic.json(2, 2), "LASER0_PREVIEW")["state"] == "laser off");
  preview.laser_on = 1;
  traffic.take("LASER0_PREVIEW", bytes_of(preview), 2);
  CHECK(line(traffic.json(2, 2), "LASER0_PREVIEW")["state"] == "laser on");
}

TEST_CASE("a sender of the version before is named as such") {
  Traffic traffic;
  std::vector<std::uint8_t> former(300, 0);
  const std::uint64_t hash = 0x1b180dbd77ef4b7b;  // of robot_pose_t
  for (std::size_t i = 0; i < 8; ++i) former[i] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
  traffic.take("ROBOT0_POSE", former, 1);
  CHECK_THAT(traffic.table(2, 2), Contains("robot_pose_t of the version before"));
  CHECK(line(traffic.json(2, 2), "ROBOT0_POSE")["undecodable"] == 1);
}

TEST_CASE("a sender that invents channels takes no memory without end") {
  Traffic traffic;
  for (int i = 0; i < 2000; ++i) traffic.take(fmt::format("C{}", i), {}, 1);
  CHECK(traffic.json(2, 2).size() == Traffic::kMostChannels);
  CHECK_THAT(traffic.table(2, 2), Contains("and 1500 messages on channels beyond the first 500"));
}
