// Robot, robot_link and the cell in random turns, each cut off at any place: the robot never moves
// on anything but the whole answer to its own question.
#include <catch2/catch.hpp>
#include <random>

#include "services/robot_link/handshake/handshake.hpp"
#include "tests/robot_link/handshake/registers_and_program.hpp"

using namespace arcstart;
using namespace arcstart::robot_link;

namespace {

class Cell {
 public:
  explicit Cell(unsigned seed) : random_(seed), program_(registers_, 3, 40) {}

  void run(int turns, bool with_cuts) {
    for (int turn = 0; turn < turns; ++turn) {
      now_ += 1000 * (10 + draw(60));
      if (turn % 4 == 0) program_.beat();
      if (draw(2) == 0)
        robot();
      else
        link();
      if (draw(6) == 0) cell();
      if (with_cuts && draw(100) == 0) cut();
    }
  }
  int motions = 0, superseded = 0;

 private:
  int draw(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  void robot() {
    const bool was_moving = program_.is_moving();
    const int writes = registers_.position_writes;
    if (!was_moving) writes_before_ = writes;
    // From the moment it looked back to its done nothing of the answer is written; but that it was
    // withdrawn before robot_link could know of the taking.
    if (was_moving) {
      REQUIRE(writes == writes_before_);
      REQUIRE(registers_[Slot::kVerdict] == kValid);
      const std::int32_t answer = registers_[Slot::kAnswer];
      REQUIRE((answer == registers_[Slot::kTaken] || answer == 0));
    }
    program_.step();
    if (!program_.moved) return;
    ++motions;
    const Motion& motion = *program_.moved;
    REQUIRE(answers_.count(motion.request) == 1);  // answered, and under its own number
    const double answer = motion.positions[0].translation().x();
    REQUIRE(answers_.at(motion.request) == answer);
    for (std::size_t i = 0; i < motion.positions.size(); ++i)
      REQUIRE(motion.positions[i].isApprox(test::positions_of(answer)[i]));
  }
  using Motion = test::Motion;

  void link() {
    const Operation operation = handshake_->next(now_);
    if (draw(20) == 0) cell();  // meanwhile
    handshake_->take(operation, registers_.carry_out(operation), now_);
  }

  void cut() {
    switch (draw(4)) {
      case 0:  // the connection, the last operation done or not
      case 1: {
        const Operation operation = handshake_->next(now_);
        if (draw(2) == 0) registers_.carry_out(operation);
        handshake_->lost();
        break;
      }
      case 2: {  // the process
        const Operation operation = handshake_->next(now_);
        if (draw(2) == 0) registers_.carry_out(operation);
        handshake_.emplace();
        asked_ = 0;
        tell();
        break;
      }
      case 3:
        program_.restart();
        break;
    }
  }

  // What the bus repeats.
  void tell() {
    handshake_->set_ready(true);
    if (scan_) handshake_->newest_scan(scan_->request, running_);
    if (scan_ && !running_ && seam_) handshake_->answer(*seam_);
  }

  void cell() {
    const auto wanted = handshake_->scan_wanted();
    if (wanted && wanted->request != asked_ && !running_) {
      asked_ = wanted->request;
      REQUIRE(registers_[Slot::kAnswer] == 0);  // before the scan begins
      scan_ = wanted;
      running_ = true;
      seam_.reset();
    } else if (running_ && draw(3) == 0) {
      running_ = false;
      seam_.emplace();
      seam_->question = *scan_;
      seam_->verdict = draw(4) == 0 ? 206 : kValid;
      const double salt = 1 + 0.25 * ++salt_;
      seam_->positions = test::positions_of(salt);
      seam_->expires = now_ + 60'000'000;
      if (seam_->verdict == kValid && scan_->request != 0) answers_[scan_->request] = salt;
    } else if (!running_ && draw(30) == 0) {  // somebody else's scan
      scan_ = Question{};
      running_ = true;
      seam_.reset();
      ++superseded;
    }
    tell();
  }

  std::mt19937 random_;
  test::Registers registers_;
  test::RobotProgram program_;
  std::optional<Handshake> handshake_{std::in_place};
  std::int64_t now_ = 1'000'000;
  int writes_before_ = 0;
  std::optional<Question> scan_;
  bool running_ = false;
  std::optional<Answer> seam_;
  std::int32_t asked_ = 0;
  int salt_ = 0;
  std::map<std::int32_t, double> answers_;  // the valid one of each request
};

}  // namespace

TEST_CASE("Handshake: in any order of turns the robot moves on whole answers of its own") {
  int motions = 0, superseded = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Cell cell(seed);
    cell.run(2000, /*with_cuts=*/false);
    motions += cell.motions;
    superseded += cell.superseded;
  }
  CHECK(motions > 400);  // eight a run: nothing hangs
  CHECK(superseded > 300);
}

TEST_CASE("Handshake: robot, link and network cut off at any step, 200 times") {
  int motions = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Cell cell(1000 + seed);
    cell.run(3000, /*with_cuts=*/true);
    motions += cell.motions;
  }
  CHECK(motions > 400);
}
