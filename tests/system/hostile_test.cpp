// What a cell must bear from outside: hostile packets at every live service, a full disk, damaged
// recordings. One clear line each, nothing crashes, nothing recorded is lost.
#include <arpa/inet.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>

#include "paths.hpp"
#include "services/command_line/output/seam_error.hpp"
#include "tests/system/running_cell.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
namespace fs = std::filesystem;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Message>
Bus::Bytes encoded(const Message& message) {
  Bus::Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

// Not this type, cut short, too long, or no message at all.
template <class Message>
void publish_damaged(Bus& bus, const std::string& channel, const Message& good) {
  Bus::Bytes bytes = encoded(good);
  bus.publish_bytes(channel, Bus::Bytes(bytes.begin(), bytes.end() - 1));
  bus.publish_bytes(channel, Bus::Bytes(bytes.begin(), bytes.begin() + 8));
  bytes.push_back(0);
  bus.publish_bytes(channel, bytes);
  bytes.pop_back();
  bytes[0] ^= 1;
  bus.publish_bytes(channel, bytes);
  bus.publish_bytes(channel, Bus::Bytes(3, 0xff));
  bus.publish_bytes(channel, Bus::Bytes());
}

// `none` and `one` are the same message with no element and with one: where their bytes first
// differ, the count's 32 bits end.
template <class Message>
void publish_bad_counts(Bus& bus, const std::string& channel, const Message& none,
                        const Message& one) {
  Bus::Bytes bytes = encoded(none);
  const Bus::Bytes other = encoded(one);
  const auto last = static_cast<std::size_t>(
      std::mismatch(bytes.begin(), bytes.end(), other.begin()).first - bytes.begin());
  for (const std::uint32_t count : {0xffffffffu, 0x7fffffffu, 0x80000000u, 1000u}) {
    for (std::size_t i = 0; i < 4; ++i)
      bytes[last - i] = static_cast<std::uint8_t>(count >> (8 * i));
    bus.publish_bytes(channel, bytes);
  }
}

void publish_hostile(Bus& bus) {
  image_t image{}, one_byte{};
  one_byte.size = 1;
  one_byte.data.assign(1, 9);
  publish_damaged(bus, "LASER0_IMAGE", image);
  publish_bad_counts(bus, "LASER0_IMAGE", image, one_byte);
  bus.publish("LASER0_IMAGE", one_byte);  // one byte of an image of no size

  stripe_t stripe{}, centre{};
  centre.count = 1;
  for (auto* values : {&centre.u, &centre.v, &centre.strength, &centre.width, &centre.deviation})
    values->assign(1, std::numeric_limits<float>::quiet_NaN());
  centre.segment.assign(1, 0);
  centre.rank.assign(1, 0);
  centre.segment_end.assign(1, 0);
  publish_damaged(bus, "LASER0_STRIPE", stripe);
  publish_bad_counts(bus, "LASER0_STRIPE", stripe, centre);
  bus.publish("LASER0_STRIPE", centre);

  robot_pose_t pose{};
  pose.position[1] = kNan;
  publish_damaged(bus, "ROBOT0_POSE", pose);
  bus.publish("ROBOT0_POSE", pose);
  pose.position[1] = 0;  // the quaternion is 0
  bus.publish("ROBOT0_POSE", pose);

  calibration_t calibration{};
  calibration.camera_matrix[0] = kNan;
  publish_damaged(bus, "LASER0_CALIBRATION", calibration);
  bus.publish("LASER0_CALIBRATION", calibration);

  profile_t profile{}, point{};
  point.count = 1;
  for (auto* values : {&point.x, &point.y, &point.z, &point.u, &point.v, &point.deviation})
    values->assign(1, std::numeric_limits<float>::infinity());
  point.segment.assign(1, 0);
  point.segment_end.assign(1, 0);
  publish_damaged(bus, "LASER0_PROFILE", profile);
  publish_bad_counts(bus, "LASER0_PROFILE", profile, point);
  bus.publish("LASER0_PROFILE", point);

  scan_command_t start{};
  start.command_id = 1;
  start.action = scan_command_t::START;
  start.longest_duration = kNan;
  publish_damaged(bus, "LASER0_SCAN_COMMAND", start);
  bus.publish("LASER0_SCAN_COMMAND", start);
  camera_command_t camera{};
  camera.command_id = 2;
  camera.exposure_us = kNan;
  publish_damaged(bus, "LASER0_CAMERA_COMMAND", camera);
  bus.publish("LASER0_CAMERA_COMMAND", camera);
  scan_t scan{};
  scan.state = 77;
  publish_damaged(bus, "LASER0_SCAN", scan);
  bus.publish("LASER0_SCAN", scan);
  cell_command_t cell{};
  cell.command_id = 3;
  cell.move = true;
  cell.position[0] = kNan;
  publish_damaged(bus, "CELL_COMMAND", cell);
  bus.publish("CELL_COMMAND", cell);
}

void send_to_robot_port(int port) {
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (const std::size_t size : {0, 1, 7, 63, 64, 200, 1400}) {
    const std::string bytes(size, '\xff');
    REQUIRE(sendto(out, bytes.data(), size, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) ==
            static_cast<ssize_t>(size));
  }
  close(out);
}

int lines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("hostile packets at every live service, in a scan: counted, and the seam is right") {
  RunningCell cell("hostile");
  cell.start_all();
  ARCSTART_REQUIRE_OF(cell, cell.wait_until_ready());
  ARCSTART_REQUIRE_OF(cell, cell.scan(scan_t::BACKGROUND));
  ARCSTART_REQUIRE_OF(cell, cell.change_scene(true, 26));
  ARCSTART_REQUIRE_OF(cell, cell.wait_for_arm());
  const std::int64_t id = cell.command(scan_command_t::START, scan_t::WORKPIECE);
  REQUIRE(cell.listen_until([&] { return cell.heard().scan->command_id == id; }, 15));
  cell.machine_kept_up();
  const std::int64_t scan_id = cell.heard().scan->scan_id;
  cell.listen_until(
      [&] {
        publish_hostile(cell.bus());
        send_to_robot_port(60015);
        cell.listen(0.2);
        return cell.seam_of(scan_id).has_value();
      },
      60);
  const auto seam = cell.seam_of(scan_id);
  ARCSTART_REQUIRE_OF(cell, seam);
  INFO(seam->reason);
  const bool kept_up = cell.machine_kept_up();
  if (kept_up) {
    CHECK(seam->verdict == seam_t::FOUND);
    CHECK(seam->profiles_lost == 0);
  }
  if (seam->verdict == seam_t::FOUND) CHECK_FALSE(seam_error(*seam, *cell.heard().truth).wrong);
  cell.listen(1.5);
  for (const auto& service : RunningCell::services()) {
    INFO(service << ": " << cell.log_of(service));
    CHECK(cell.process(service).is_running());
    if (service != "calibration")  // which subscribes to nothing
      CHECK(cell.status(service).undecodable > 0);
  }
}

TEST_CASE("a disk that fills up under the logger is told, and what was recorded can be replayed") {
  const RunningCell cell("disk_full");  // for its folder and its bus alone
  const std::string disk = cell.folder() + "/disk", recording = disk + "/recording.lcm";
  fs::create_directory(disk);
  REQUIRE(mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=4m") == 0);
  const std::string record = std::string(ARCSTART_SOURCE) + "/scripts/record";

  const Output refused = run({record, "-o", recording, "--free-mb", "100"});
  CHECK(refused.code == 1);
  CHECK(lines(refused.err) == 1);
  CHECK_THAT(refused.err, Catch::Contains(disk) && Catch::Contains("nothing is recorded"));

  for (const std::string free : {"2", "0"}) {
    INFO("--free-mb " << free);
    fs::remove(recording);
    Process logger({record, "-o", recording, "--free-mb", free}, cell.folder() + "/" + free);
    // A recording that exists, played into the logger until the disk is full.
    const std::string source = std::string(ARCSTART_SOURCE) + "/logs/";
    std::optional<int> code;
    usleep(1'000'000);
    for (int i = 0; i < 10 && !(code = logger.wait(0)); ++i)
      run({"/usr/bin/lcm-logplayer", "-s", "20", "--lcm-url=udpm://239.255.76.67:7667?ttl=0",
           source + (i == 0 ? "no_tool_50.lcm" : "tool_50.lcm")});
    code = logger.wait(5);
    REQUIRE(code);
    CHECK(*code == 1);
    std::ifstream log(cell.folder() + "/" + free);
    const std::string said((std::istreambuf_iterator<char>(log)), {});
    INFO(said);
    CHECK_THAT(said, Catch::Contains(free == "0" ? "is full" : "MB left"));
    const Output replayed = run({program("arcstart"), "replay", recording, "--json"});
    INFO(replayed.err);
    CHECK(replayed.code <= 1);
    CHECK(lines(replayed.out) >= 1);  // the background, which was whole
  }
  umount(disk.c_str());
}

TEST_CASE("a damaged recording never reaches liblcm's player") {
  const RunningCell cell("damaged");
  const std::string source = std::string(ARCSTART_SOURCE) + "/logs/tool_50.lcm",
                    damaged = cell.folder() + "/damaged.lcm";
  std::ifstream in(source, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  const std::string replay = std::string(ARCSTART_SOURCE) + "/scripts/replay";
  SECTION("a length of 2^31 - 1 in its first event") {
    std::string bytes = good;
    bytes.replace(20, 4, "\x7f\xff\xff\xff");
    std::ofstream(damaged, std::ios::binary) << bytes;
  }
  SECTION("a text") { std::ofstream(damaged, std::ios::binary) << "not a recording"; }
  SECTION("cut off in the middle of an event") {
    std::ofstream(damaged, std::ios::binary) << good.substr(0, good.size() / 2);
  }
  SECTION("a bad length in the middle") {
    std::string bytes = good;
    const std::size_t event = good.find("\xed\xa1\xda\x01", good.size() / 2);
    bytes.replace(event + 20, 4, "\x7f\xff\xff\xff");
    std::ofstream(damaged, std::ios::binary) << bytes;
  }
  const Output output = run({replay, damaged});
  INFO(output.err);
  CHECK(output.code == 2);
  CHECK(output.out.empty());
  CHECK(lines(output.err) == 1);
  CHECK_THAT(output.err, Catch::Contains("damaged.lcm"));
}
