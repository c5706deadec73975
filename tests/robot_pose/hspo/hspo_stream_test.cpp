#include "services/robot_pose/hspo/hspo_stream.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/robot_pose/hspo/hspo_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

namespace {

constexpr std::int64_t kPeriod = 20'000;  // us

// A controller with a clock of its own, heard after a fixed delay.
struct Controller {
  HspoStream stream;
  std::uint32_t index = 100;
  std::uint32_t clock = 5'000'000;  // ticks
  std::uint32_t ticks_a_period = 20'000;
  std::int64_t arrival = 1'700'000'000'000'000;

  explicit Controller(double tick_us = 1) : stream(tick_us, 1) {}

  void pass(int periods = 1) {
    index += static_cast<std::uint32_t>(periods);
    clock += ticks_a_period * static_cast<std::uint32_t>(periods);
    arrival += kPeriod * periods;
  }
  std::optional<ReportedPosition> send() { return stream.take(tool_packet(index, clock), arrival); }
  // So many reports in a row; the last one's position.
  ReportedPosition run(int reports) {
    std::optional<ReportedPosition> last;
    for (int i = 0; i < reports; ++i) {
      last = send();
      REQUIRE(last.has_value());
      pass();
    }
    return *last;
  }
};

}  // namespace

TEST_CASE("HSPO stream: positions, numbers and clock of an undisturbed controller") {
  Controller controller;
  const ReportedPosition first = controller.run(1);
  CHECK(first.seq == 100);
  CHECK(first.invalid.find("not been compared") != std::string::npos);
  for (int i = 1; i < 10; ++i) CHECK_FALSE(controller.run(1).invalid.empty());
  // 0.2 s have shown that a tick is 1 us.
  const ReportedPosition valid = controller.run(1);
  CHECK(valid.invalid == "");
  CHECK(valid.clock_begins);
  CHECK(valid.seq == 110);
  CHECK(valid.device_clock == 5'000'000 + 10 * kPeriod);
  CHECK(valid.device_tick_us == 1);
  CHECK(valid.position == Eigen::Vector3d(985, 0, 940));
  CHECK(valid.joints.empty());
  const ReportedPosition next = controller.run(1);
  CHECK_FALSE(next.clock_begins);
  CHECK(next.seq == 111);
  CHECK(controller.stream.counts().lost == 0);
  CHECK(controller.stream.counts().received == 12);
}

TEST_CASE("HSPO stream: lost reports leave a gap and are counted") {
  Controller controller;
  controller.run(20);
  controller.pass(3);
  const ReportedPosition after = controller.run(1);
  CHECK(after.seq == 123);
  CHECK(after.invalid == "");
  CHECK(controller.stream.counts().lost == 3);
  CHECK(controller.run(1).seq == 124);
}

TEST_CASE("HSPO stream: number and clock wrap without a trace") {
  Controller controller;
  controller.index = 0xffffffff - 15;
  controller.clock = 0xffffffff - 15 * 20'000 + 7;
  const ReportedPosition before = controller.run(12);
  const ReportedPosition after = controller.run(12);
  CHECK(after.seq - before.seq == 12);
  CHECK(after.device_clock - before.device_clock == 12 * kPeriod);
  CHECK(after.seq > 0xffffffffll);
  CHECK(after.invalid == "");
  CHECK_FALSE(after.clock_begins);
  CHECK(controller.stream.counts().lost == 0);
}

TEST_CASE("HSPO stream: duplicates and reordered reports are dropped and counted") {
  Controller controller;
  controller.run(20);
  const auto early = tool_packet(controller.index, controller.clock);
  controller.pass();
  CHECK(controller.send()->seq == 121);  // overtook the one before
  CHECK_FALSE(controller.stream.take(early, controller.arrival + 100).has_value());
  CHECK_FALSE(controller.send().has_value());  // twice
  controller.pass();
  CHECK(controller.run(1).seq == 122);
  CHECK(controller.stream.counts().late == 2);
  CHECK(controller.stream.last_error().find("2 reports came twice, late") == 0);
}

TEST_CASE("HSPO stream: a restarted controller is recognised after three reports") {
  Controller controller;
  const std::int64_t last = controller.run(50).seq;
  controller.index = GENERATE(0u, 1u, 120u);  // also where the numbers look like the old ones
  controller.clock = 3'000;
  controller.arrival += 30'000'000;
  int announced = 0;
  std::int64_t seq = last;
  for (int i = 0; i < 20; ++i) {
    const auto position = controller.send();
    controller.pass();
    if (!position) continue;
    CHECK(position->seq > seq);
    seq = position->seq;
    if (!position->invalid.empty()) continue;
    announced += position->clock_begins;
    CHECK(position->device_clock < 1'000'000);
  }
  CHECK(announced == 1);
  CHECK(seq >= last + 18);
  CHECK(controller.stream.last_error().find("began anew") != std::string::npos);
  CHECK(controller.stream.counts().lost >= 1);
}

TEST_CASE("HSPO stream: one stray packet does not lead it away") {
  Controller controller;
  controller.run(30);
  const auto stray = GENERATE(tool_packet(4'000'000'000, 5'400'000),  // number
                              tool_packet(3, 70), tool_packet(2'000'000, 2'000'000'000));
  CHECK_FALSE(controller.stream.take(stray, controller.arrival).has_value());
  const ReportedPosition next = controller.run(1);
  CHECK(next.seq == 130);
  CHECK(next.invalid == "");
  CHECK(controller.stream.counts().lost == 0);
  CHECK(controller.stream.counts().late == 1);
}

TEST_CASE("HSPO stream: a clock that goes back or jumps marks the position invalid") {
  Controller controller;
  controller.run(30);
  const std::uint32_t right = controller.clock;
  const bool back = GENERATE(true, false);
  controller.clock = back ? right - 500'000 : right + 1'800'000'000;
  const auto wrong = controller.send();
  REQUIRE(wrong.has_value());
  CHECK(wrong->seq == 130);
  CHECK(wrong->invalid.find(back ? "went back" : "jumped ahead") != std::string::npos);
  controller.clock = right;
  controller.pass();
  const ReportedPosition next = controller.run(1);
  CHECK(next.invalid == "");
  CHECK(next.seq == 131);
  CHECK_FALSE(next.clock_begins);
}

TEST_CASE("HSPO stream: a clock that stays elsewhere is a new one") {
  Controller controller;
  const std::int64_t last = controller.run(30).seq;
  controller.clock -= 4'000'000;
  bool announced = false;
  std::int64_t seq = last;
  for (int i = 0; i < 20; ++i) {
    const ReportedPosition position = controller.run(1);
    CHECK(position.seq > seq);
    seq = position.seq;
    announced |= position.clock_begins;
  }
  CHECK(announced);
  CHECK(controller.run(1).invalid == "");
}

TEST_CASE("HSPO stream: after silence it goes on, what was missed is lost") {
  Controller controller;
  controller.run(30);
  controller.pass(50 * 60 * 5);  // five minutes
  const ReportedPosition after = controller.run(1);
  CHECK(after.invalid == "");
  CHECK(after.seq == 130 + 15'000);
  CHECK(controller.stream.counts().lost == 15'000);
}

TEST_CASE("HSPO stream: ticks of 2 ms") {
  Controller controller(2000);
  controller.ticks_a_period = 10;
  const ReportedPosition position = controller.run(40);
  CHECK(position.invalid == "");
  CHECK(position.device_tick_us == 2000);
  CHECK(position.device_clock == 5'000'000 + 39 * 10);
}

TEST_CASE("HSPO stream: a wrong tick setting is found by the rate of arrivals") {
  const bool too_short = GENERATE(true, false);
  Controller controller(too_short ? 1 : 2000);
  if (too_short) controller.ticks_a_period = 10;
  controller.run(15);
  for (int i = 0; i < 300; ++i) {
    const ReportedPosition position = controller.run(1);
    REQUIRE(position.invalid.find("robot_pose.clock_tick_us") != std::string::npos);
  }
  CHECK(controller.stream.last_error().find(too_short ? "lasts 2e+03 us" : "lasts 1 us") !=
        std::string::npos);
}

TEST_CASE("HSPO stream: jitter of arrival is not taken for a wrong tick") {
  Controller controller;
  std::mt19937 random(4);
  const std::int64_t start = controller.arrival;
  for (int i = 0; i < 2000; ++i) {
    controller.arrival = start + i * kPeriod + static_cast<std::int64_t>(random() % 15'000);
    const auto position = controller.send();
    REQUIRE(position.has_value());
    if (i > 15) REQUIRE(position->invalid == "");
    controller.index += 1;
    controller.clock += 20'000;
  }
}

TEST_CASE("HSPO stream: joints come along, in the same packet or one of their own") {
  Controller controller;
  controller.run(20);
  SECTION("in the same packet") {
    Bytes bytes = header(controller.index, controller.clock, 5).u16(1);
    for (int i = 0; i < 6; ++i) bytes.f32(10);
    bytes.u32(0).u32(0).u16(1);
    for (int i = 0; i < 9; ++i) bytes.f32(0.5);
    bytes.u32(0).u32(0);
    REQUIRE(bytes.data.size() == 94);
    const auto position = controller.stream.take(bytes.data, controller.arrival);
    REQUIRE(position.has_value());
    CHECK(position->joints == std::vector<double>(9, 0.5));
  }
  SECTION("before it, with its own number or the same one") {
    const bool own = GENERATE(true, false);
    for (std::uint32_t i = 0; i < 5; ++i) {
      const std::uint32_t number = controller.index + (own ? 2 * i : i);
      CHECK_FALSE(controller.stream.take(joint_packet(number, controller.clock), controller.arrival)
                      .has_value());
      const auto position = controller.stream.take(
          tool_packet(number + (own ? 1 : 0), controller.clock), controller.arrival);
      REQUIRE(position.has_value());
      CHECK(position->joints.size() == 9);
      CHECK(position->invalid == "");
      CHECK(position->seq == 120 + i);
      controller.clock += 20'000;
      controller.arrival += kPeriod;
    }
    CHECK(controller.stream.counts().lost == 0);
  }
  SECTION("joints of another instant are not taken") {
    controller.stream.take(joint_packet(controller.index, controller.clock), controller.arrival);
    controller.pass();
    CHECK(controller.run(1).joints.empty());
  }
}

TEST_CASE("HSPO stream: what is no use is counted and named") {
  Controller controller;
  controller.run(20);
  auto cut = tool_packet(controller.index, controller.clock);
  cut.pop_back();
  CHECK_FALSE(controller.stream.take(cut, controller.arrival).has_value());
  CHECK(controller.stream.counts().malformed == 1);
  CHECK(controller.stream.last_error().find("47 bytes") != std::string::npos);
  const auto other = tool_packet(controller.index, controller.clock, 1, 2);
  CHECK_FALSE(controller.stream.take(other, controller.arrival).has_value());
  CHECK(controller.stream.counts().foreign == 1);
  CHECK(controller.stream.last_error().find("motion group 2") != std::string::npos);
  CHECK(controller.run(1).seq == 120);
}

TEST_CASE("HSPO stream: a controller that reports no actual tool is told so") {
  Controller controller;
  Bytes commanded = header(1, 1000, 2).u16(1);
  for (int i = 0; i < 6; ++i) commanded.f32(1);
  commanded.u32(0).u32(0);
  CHECK_FALSE(controller.stream.take(commanded.data, controller.arrival).has_value());
  CHECK(controller.stream.last_error().find("packets of type 2 come") == 0);
  CHECK(controller.stream.counts().foreign == 1);
}
