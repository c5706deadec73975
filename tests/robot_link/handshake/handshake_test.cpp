#include "services/robot_link/handshake/handshake.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "tests/robot_link/handshake/registers_and_program.hpp"

using namespace arcstart;
using namespace arcstart::robot_link;
using arcstart::test::positions_of;

namespace {

constexpr std::int64_t kRequestTime = 66'000;  // us: a FANUC controller's

struct Talk {
  test::Registers registers;
  Handshake handshake;
  std::int64_t now = 1'000'000;
  bool robot_beats = true;
  std::vector<Operation> done;

  void step() {
    const Operation operation = handshake.next(now);
    done.push_back(operation);
    now += kRequestTime;
    if (robot_beats) ++registers[Slot::kRobotBeat];
    handshake.take(operation, registers.carry_out(operation), now);
  }
  void run(int steps) {
    while (steps-- > 0) step();
  }
  void ask(std::int32_t request, std::int32_t job = 2, std::int32_t part = 77) {
    registers[Slot::kJob] = job;
    registers[Slot::kPart] = part;
    registers[Slot::kRequest] = request;
  }
  Answer valid(std::int32_t request, double mark) {
    return {{request, 2, 77}, kValid, positions_of(mark), now + 60'000'000};
  }
  // A question asked, scanned and answered.
  void deliver(std::int32_t request, double mark) {
    ask(request);
    run(20);
    handshake.newest_scan(request, true);
    run(5);
    handshake.newest_scan(request, false);
    handshake.answer(valid(request, mark));
    run(20);
  }
};

}  // namespace

TEST_CASE("Handshake: the course of a question") {
  Talk talk;
  talk.handshake.set_ready(true);
  talk.run(20);
  CHECK(talk.registers[Slot::kStatus] == static_cast<int>(Status::kReady));
  CHECK_FALSE(talk.handshake.scan_wanted());

  talk.ask(5);
  talk.run(20);
  REQUIRE(talk.handshake.scan_wanted() == Question{5, 2, 77});
  CHECK(talk.registers[Slot::kStatus] == static_cast<int>(Status::kBusy));
  talk.handshake.newest_scan(5, true);
  talk.run(8);
  CHECK_FALSE(talk.handshake.scan_wanted());
  CHECK(talk.registers[Slot::kStatus] == static_cast<int>(Status::kScanning));
  talk.handshake.newest_scan(5, false);
  talk.run(8);
  CHECK(talk.registers[Slot::kStatus] == static_cast<int>(Status::kScanEnded));

  talk.handshake.answer(talk.valid(5, 12.5));
  talk.run(20);
  CHECK(talk.registers[Slot::kAnswer] == 5);
  CHECK(talk.registers[Slot::kVerdict] == kValid);
  CHECK(talk.registers[Slot::kStatus] == static_cast<int>(Status::kAnswered));
  CHECK(talk.registers.positions[2].translation().x() == 12.5);
  CHECK(talk.handshake.report().progress == Handshake::Progress::kDelivered);
  talk.registers[Slot::kTaken] = 5;
  talk.run(8);
  CHECK(talk.handshake.report().progress == Handshake::Progress::kTaken);
  talk.registers[Slot::kDone] = 5;
  talk.run(8);
  CHECK(talk.handshake.report().progress == Handshake::Progress::kDone);
  CHECK(talk.registers[Slot::kStatus] == static_cast<int>(Status::kReady));
  CHECK_FALSE(talk.handshake.scan_wanted());
}

TEST_CASE("Handshake: values are written and read back before the number, validity 0 before them") {
  Talk talk;
  talk.deliver(5, 1);
  talk.registers[Slot::kTaken] = talk.registers[Slot::kDone] = 5;
  talk.done.clear();
  talk.deliver(6, 2);
  std::vector<std::string> order;
  for (const Operation& operation : talk.done) {
    using Kind = Operation::Kind;
    if (operation.kind == Kind::kWritePosition) order.push_back("write");
    if (operation.kind == Kind::kReadPosition) order.push_back("read");
    const bool answer = operation.slot == Slot::kAnswer, verdict = operation.slot == Slot::kVerdict;
    if (operation.kind == Kind::kWriteNumber && answer)
      order.push_back("answer " + std::to_string(operation.number));
    if (operation.kind == Kind::kReadNumber && answer) order.push_back("answer?");
    if (operation.kind == Kind::kWriteNumber && verdict) order.push_back("verdict");
    if (operation.kind == Kind::kReadNumber && verdict) order.push_back("verdict?");
  }
  CHECK(order == std::vector<std::string>{"answer 0", "answer?", "write", "write", "write", "read",
                                          "read", "read", "verdict", "verdict?", "answer 6",
                                          "answer?"});
}

TEST_CASE("Handshake: a later workpiece scan withdraws what was not taken, and nothing else") {
  Talk talk;
  talk.deliver(5, 1);
  SECTION("not taken") {
    talk.handshake.newest_scan(0, true);
    talk.step();
    talk.step();  // a beat may come first
    CHECK(talk.registers[Slot::kAnswer] == 0);
    talk.run(12);
    CHECK(talk.registers[Slot::kAnswer] == 5);
    CHECK(talk.registers[Slot::kVerdict] == kSuperseded);
  }
  SECTION("taken") {
    talk.registers[Slot::kTaken] = 5;
    talk.run(6);
    const int writes = talk.registers.position_writes;
    talk.handshake.newest_scan(0, true);
    talk.run(30);
    CHECK(talk.registers[Slot::kAnswer] == 5);
    CHECK(talk.registers[Slot::kVerdict] == kValid);
    talk.ask(6);  // not before done
    talk.run(30);
    CHECK(talk.registers[Slot::kAnswer] == 5);
    CHECK_FALSE(talk.handshake.scan_wanted());
    CHECK(talk.registers.position_writes == writes);
    talk.registers[Slot::kDone] = 5;
    talk.run(30);
    CHECK(talk.registers[Slot::kAnswer] == 0);
    CHECK(talk.handshake.scan_wanted() == Question{6, 2, 77});
  }
}

TEST_CASE("Handshake: after a restart equal is delivered, and old is withdrawn") {
  Talk talk;
  talk.deliver(5, 1);
  const int writes = talk.registers.position_writes;
  talk.handshake = Handshake();
  SECTION("equal") {
    talk.run(12);
    talk.handshake.newest_scan(5, false);
    talk.handshake.answer(talk.valid(5, 1));
    talk.run(30);
    CHECK(talk.registers[Slot::kAnswer] == 5);
    CHECK(talk.registers.position_writes == writes);
    CHECK(talk.handshake.report().progress == Handshake::Progress::kDelivered);
  }
  SECTION("equal, and too old meanwhile") {
    talk.run(12);
    talk.handshake.answer({{5, 2, 77}, kTooOld, {}, 0});
    talk.run(30);
    CHECK(talk.registers[Slot::kVerdict] == kTooOld);
  }
  SECTION("old: the robot asked again meanwhile") {
    talk.ask(6);
    talk.run(30);
    CHECK(talk.registers[Slot::kAnswer] == 0);
    talk.handshake.answer(talk.valid(5, 1));
    talk.run(30);
    CHECK(talk.registers[Slot::kAnswer] == 6);  // nobody scans for it any more
    CHECK(talk.registers[Slot::kVerdict] == kAskAgain);
    CHECK_FALSE(talk.handshake.scan_wanted());
  }
  SECTION("its scan still runs") {
    talk.ask(6);
    talk.run(12);
    talk.handshake.newest_scan(6, true);
    talk.run(50);
    CHECK_FALSE(talk.handshake.scan_wanted());
    CHECK(talk.registers[Slot::kStatus] == static_cast<int>(Status::kScanning));
    talk.handshake.answer(talk.valid(6, 3));
    talk.run(30);
    CHECK(talk.registers[Slot::kVerdict] == kValid);
    CHECK(talk.registers.positions[0].translation().x() == 3);
  }
}

TEST_CASE("Handshake: an answer of another question, job or part is none") {
  Talk talk;
  talk.run(12);
  talk.ask(5);
  talk.run(20);
  for (const Question other : {Question{4, 2, 77}, Question{5, 3, 77}, Question{5, 2, 78}}) {
    Answer answer = talk.valid(5, 1);
    answer.question = other;
    talk.handshake.answer(answer);
  }
  talk.run(30);
  CHECK(talk.registers[Slot::kAnswer] == 0);
  CHECK(talk.registers.position_writes == 0);
}

TEST_CASE("Handshake: a refusal brings its number and no position") {
  Talk talk;
  talk.run(12);
  talk.ask(5);
  talk.run(20);
  talk.handshake.answer({{5, 2, 77}, 206, {}, 0});
  talk.run(20);
  CHECK(talk.registers[Slot::kAnswer] == 5);
  CHECK(talk.registers[Slot::kVerdict] == 206);
  CHECK(talk.registers.position_writes == 0);
}

TEST_CASE("Handshake: what is not taken in time, or by a robot that is silent, is withdrawn") {
  Talk talk;
  talk.deliver(5, 1);
  SECTION("time") {
    talk.now += 61'000'000;
    talk.run(12);
    CHECK(talk.registers[Slot::kVerdict] == kTooOld);
  }
  SECTION("silence") {
    talk.robot_beats = false;
    talk.run(60);
    CHECK(talk.registers[Slot::kVerdict] == kRobotSilent);
    talk.ask(6);
    talk.run(20);
    CHECK_FALSE(talk.handshake.scan_wanted());
  }
}

TEST_CASE("Handshake: a controller that does not keep the positions is given no number as valid") {
  Talk talk;
  talk.registers.forgets_positions = true;
  talk.deliver(5, 1);
  CHECK(talk.registers[Slot::kVerdict] == kReadBack);
  CHECK(talk.handshake.report().read_back_differed == 1);
}

TEST_CASE("Handshake: the beat is at least 2 Hz at 66 ms a request, in a delivery, too") {
  Talk talk;
  talk.handshake.set_ready(true);
  talk.deliver(5, 1);
  talk.registers[Slot::kTaken] = talk.registers[Slot::kDone] = 5;
  talk.deliver(6, 2);
  std::int64_t last = 0, longest = 0, count = 0;
  for (std::size_t i = 12; i < talk.done.size(); ++i) {
    if (talk.done[i].kind != Operation::Kind::kWriteNumber || talk.done[i].slot != Slot::kLinkBeat)
      continue;
    const auto time = static_cast<std::int64_t>(i) * kRequestTime;
    if (last != 0) longest = std::max(longest, time - last);
    last = time;
    ++count;
  }
  CHECK(count > 8);
  CHECK(longest <= 500'000);
}
