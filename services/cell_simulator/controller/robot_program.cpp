#include "services/cell_simulator/controller/robot_program.hpp"

#include <fmt/core.h>

namespace arcstart::cell_simulator {
namespace {

// The registers' order, as docs/robot-link.md tells it.
constexpr int kRequest = 0, kJob = 1, kPart = 2, kTaken = 3, kDone = 4, kRobotBeat = 5,
              kLinkBeat = 6, kVerdict = 8, kAnswer = 9;
constexpr std::int64_t kBeat = 200'000;            // us
constexpr std::int64_t kLinkSilent = 1'000'000;    // us: two beats
constexpr std::int64_t kLongestWait = 90'000'000;  // us, for an answer
constexpr int kMostQuestions = 3;
constexpr int kScanAgainFrom = 100, kScanAgainTo = 199;  // refusals by what helps

}  // namespace

void RobotProgram::start(int part) {
  part_ = part;
  asked_ = 0;
  stopped_.clear();
  step_ = Step::kClear;
}

void RobotProgram::stop(const std::string& why) {
  stopped_ = why;
  step_ = Step::kIdle;
}

// Ends the question, and asks another where the refusal says that it helps.
void RobotProgram::ask_again(std::int32_t refusal) {
  number(kDone) = own_;
  if (refusal < kScanAgainFrom || refusal > kScanAgainTo || asked_ >= kMostQuestions)
    return stop(fmt::format("refused: {}", refusal));
  step_ = Step::kAsk;
}

// A motion instruction reads a position register in the active frame and tool.
RigidTransform RobotProgram::flange_for(const PositionRegister& position) const {
  const auto frame = static_cast<std::size_t>(settings_.user_frame);
  const auto tool = static_cast<std::size_t>(settings_.tool);
  return from_xyzwpr(memory_.frames[frame]) * from_xyzwpr(position.position) *
         from_xyzwpr(memory_.tools[tool]).inverse();
}

std::optional<RigidTransform> RobotProgram::tick(std::int64_t now, bool at_rest) {
  const std::lock_guard lock(memory_.mutex);
  if (now >= beat_due_) {
    number(kRobotBeat) = number(kRobotBeat) + 1;
    beat_due_ = now + kBeat;
  }
  if (number(kLinkBeat) != link_beat_ || link_beat_changed_ == 0) {
    link_beat_ = number(kLinkBeat);
    link_beat_changed_ = now;
  }
  const bool link_silent = now - link_beat_changed_ > kLinkSilent;
  switch (step_) {
    case Step::kIdle:
    case Step::kStands:
      return std::nullopt;
    case Step::kClear:
      number(kDone) = number(kTaken);
      step_ = Step::kAsk;
      return std::nullopt;
    case Step::kAsk:
      if (link_silent) return std::nullopt;  // waits for robot_link
      number(kJob) = settings_.job;
      number(kPart) = part_;
      own_ = number(kRequest) + 1;
      number(kRequest) = own_;
      ++asked_;
      step_since_ = now;
      step_ = Step::kWait;
      return std::nullopt;
    case Step::kWait:
      if (link_silent)
        stop("robot_link is silent");
      else if (now - step_since_ > kLongestWait)
        stop("no answer came");
      else if (number(kAnswer) == own_)
        step_ = Step::kTake;
      return std::nullopt;
    case Step::kTake:
      number(kTaken) = own_;
      step_ = Step::kLookBack;
      return std::nullopt;
    case Step::kLookBack:
      if (number(kAnswer) == own_)
        step_ = Step::kVerdict;
      else
        ask_again(kScanAgainFrom);  // withdrawn meanwhile
      return std::nullopt;
    case Step::kVerdict:
      if (number(kVerdict) == 1)
        step_ = Step::kCopy;
      else
        ask_again(static_cast<std::int32_t>(number(kVerdict)));
      return std::nullopt;
    case Step::kCopy:
      for (std::size_t i = 0; i < copied_.size(); ++i)
        copied_[i] = memory_.positions[static_cast<std::size_t>(settings_.first_position) + i];
      step_ = Step::kApproach;
      return std::nullopt;
    case Step::kApproach:
      if (!at_rest) return std::nullopt;
      step_ = Step::kStart;
      return flange_for(copied_[0]);
    case Step::kStart:
      if (!at_rest) return std::nullopt;
      step_ = Step::kArrive;
      return flange_for(copied_[1]);
    case Step::kArrive:
      if (!at_rest) return std::nullopt;
      number(kDone) = own_;
      step_ = Step::kStands;
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace arcstart::cell_simulator
