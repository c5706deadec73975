// The robot's own program, as it would run in a FANUC controller (docs/robot-link.md): it asks
// robot_link through the registers, waits, takes the answer and moves. It knows registers alone.
#pragma once

#include <optional>
#include <string>

#include "services/cell_simulator/controller/controller_memory.hpp"

namespace arcstart::cell_simulator {

struct RobotProgramSettings {
  int first_number = 91, first_position = 91;  // R[], PR[]
  int user_frame = 1, tool = 1;                // UFRAME_NUM, UTOOL_NUM
  int job = 1;
};

// Times in us. Used by one thread; the registers are others', too.
class RobotProgram {
 public:
  // The memory outlives it.
  RobotProgram(const RobotProgramSettings& settings, ControllerMemory& memory)
      : settings_(settings), memory_(memory) {}

  // The operator presses cycle start for this workpiece.
  void start(int part);

  // At 2 Hz and more; one step of the program each. at_rest: the arm does not move. Where the
  // flange (tool0, in base) is to go to, where a motion begins.
  std::optional<RigidTransform> tick(std::int64_t now, bool at_rest);

  bool is_done() const { return step_ == Step::kStands; }  // the torch stands at the start
  std::string stopped() const { return stopped_; }         // why; empty where it has not

 private:
  enum class Step {
    kIdle,
    kClear,
    kAsk,
    kWait,
    kTake,
    kLookBack,
    kVerdict,
    kCopy,
    kApproach,
    kStart,
    kArrive,
    kStands,
  };
  double& number(int index) {
    return memory_.numbers[static_cast<std::size_t>(settings_.first_number + index)];
  }
  RigidTransform flange_for(const PositionRegister& position) const;
  void ask_again(std::int32_t refusal);
  void stop(const std::string& why);

  RobotProgramSettings settings_;
  ControllerMemory& memory_;
  Step step_ = Step::kIdle;
  int part_ = 0, asked_ = 0;
  double own_ = 0;  // request number
  std::int64_t beat_due_ = 0;
  double link_beat_ = 0;
  std::int64_t link_beat_changed_ = 0, step_since_ = 0;
  std::array<PositionRegister, 3> copied_{};
  std::string stopped_;
};

}  // namespace arcstart::cell_simulator
