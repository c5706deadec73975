// A controller's registers and the robot's program on them, one access a step, written after
// docs/robot-link.md and not after the state machine.
#pragma once

#include <array>
#include <map>

#include "services/robot_link/handshake/registers.hpp"

namespace arcstart::test {

struct Registers {
  std::array<std::int32_t, robot_link::kSlots> numbers{};
  robot_link::Positions positions;
  int position_writes = 0;
  bool forgets_positions = false;  // a controller that does not keep what it is given

  std::int32_t& operator[](robot_link::Slot slot) {
    return numbers[static_cast<std::size_t>(slot)];
  }

  robot_link::Reading carry_out(const robot_link::Operation& operation) {
    using Kind = robot_link::Operation::Kind;
    auto& place = positions[static_cast<std::size_t>(operation.place)];
    auto& number = (*this)[operation.slot];
    if (operation.kind == Kind::kWriteNumber) number = operation.number;
    if (operation.kind == Kind::kWritePosition) {
      if (!forgets_positions) place = operation.position;
      ++position_writes;
    }
    return {number, place};
  }
};

// What the robot does with an answer.
struct Motion {
  std::int32_t request;
  robot_link::Positions positions;
};

class RobotProgram {
 public:
  // job, part: of each question.
  RobotProgram(Registers& registers, std::int32_t job, std::int32_t part)
      : r_(registers), job_(job), part_(part) {}

  // The program is aborted and begins from the top.
  void restart() { at_ = 0; }
  bool is_moving() const { return at_ >= 9 && at_ < kDone; }  // between its look back and done
  std::optional<Motion> moved;                                // set for a step
  std::int32_t refused = 0;                                   // number of the last refusal

  // One access to a register.
  void step() {
    using robot_link::Slot;
    moved.reset();
    switch (at_) {
      case 0:
        r_[Slot::kDone] = r_[Slot::kTaken];
        break;
      case 1:
        r_[Slot::kJob] = job_;
        break;
      case 2:
        r_[Slot::kPart] = part_;
        break;
      case 3:
        own_ = r_[Slot::kRequest] + 1;
        break;
      case 4:
        r_[Slot::kRequest] = own_;
        break;
      case 5:
        if (r_[Slot::kAnswer] != own_) return;  // waits here
        break;
      case 6:
        r_[Slot::kTaken] = own_;
        break;
      case 7:
        if (r_[Slot::kAnswer] != own_) at_ = kDone - 1;  // withdrawn meanwhile
        break;
      case 8:  // not before: a refusal may have come in the answer's place
        verdict_ = r_[Slot::kVerdict];
        if (verdict_ != robot_link::kValid) {
          refused = verdict_;
          at_ = kDone - 1;
        }
        break;
      case 9:
      case 10:
      case 11:
        motion_.positions[at_ - 9] = r_.positions[at_ - 9];
        break;
      case 12:
        motion_.request = own_;
        moved = motion_;
        break;
      default:
        break;  // on its way
      case kDone:
        r_[Slot::kDone] = own_;
        at_ = 0;
        return;
    }
    ++at_;
  }
  void beat() { ++r_[robot_link::Slot::kRobotBeat]; }

 private:
  static constexpr std::size_t kDone = 40;  // the step after its motion
  Registers& r_;
  std::int32_t job_, part_;
  std::size_t at_ = 0;
  std::int32_t own_ = 0, verdict_ = 0;
  Motion motion_{};
};

// Positions that name the answer they belong to.
inline robot_link::Positions positions_of(double answer) {
  robot_link::Positions positions;
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i].translation() << answer, static_cast<double>(i), 7;
  return positions;
}

}  // namespace arcstart::test
