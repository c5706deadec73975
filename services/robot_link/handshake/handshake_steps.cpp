// Handshake: the steps in which an answer is withdrawn, written and read back.
#include <cmath>

#include "services/robot_link/handshake/handshake.hpp"

namespace arcstart::robot_link {
namespace {

// Controllers keep positions in 32-bit floats or round to 0.001 mm and 0.001 deg, in which a UR's
// metres are rounded, too: five such steps, far below what a weld asks for.
constexpr double kSamePlace = 0.005;                  // mm
constexpr double kSameTurn = 0.005 * EIGEN_PI / 180;  // rad

bool are_same(const RigidTransform& a, const RigidTransform& b) {
  const Eigen::Quaterniond turn(a.linear().transpose() * b.linear());
  return (a.translation() - b.translation()).norm() <= kSamePlace &&
         2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) <= kSameTurn;
}

}  // namespace

void Handshake::begin_steps() {
  aimed_ = false;
  place_ = 0;
  if (answer_ != 0)
    step_ = Step::kWithdraw;
  else if (!free_)
    step_ = Step::kLookTaken;
  else if (target_.request == 0 || target_.verdict == 0)
    step_ = Step::kSettled;
  else
    step_ = target_.verdict == kValid ? Step::kWritePosition : Step::kWriteVerdict;
}

Operation Handshake::step() const {
  switch (step_) {
    case Step::kWithdraw:
      return Operation::write(Slot::kAnswer, 0);
    case Step::kLookTaken:
      return Operation::read(Slot::kTaken);
    case Step::kLookDone:
      return Operation::read(Slot::kDone);
    case Step::kWritePosition:
      return Operation::write(kPlaces[place_], target_.positions[place_]);
    case Step::kReadPosition:
      return Operation::read(kPlaces[place_]);
    case Step::kWriteVerdict:
      return Operation::write(Slot::kVerdict, target_.verdict);
    case Step::kReadVerdict:
      return Operation::read(Slot::kVerdict);
    case Step::kWriteAnswer:
      return Operation::write(Slot::kAnswer, target_.request);
    default:
      return Operation::read(Slot::kAnswer);  // kConfirm, kReadAnswer
  }
}

// The target may have changed since next(): what was done counts all the same, the steps then
// begin again.
void Handshake::take_step(const Operation& done, const Reading& reading) {
  switch (step_) {
    case Step::kWithdraw:
      free_ = false;
      step_ = Step::kConfirm;
      break;
    case Step::kConfirm:
      answer_ = reading.number;
      if (answer_ != 0) ++read_back_differed_;
      begin_steps();
      break;
    case Step::kLookTaken:
      step_ = Step::kLookDone;
      break;
    case Step::kLookDone:
      free_ = !locked();
      begin_steps();
      break;
    case Step::kWritePosition:
      if (++place_ < kPlaces.size()) break;
      place_ = 0;
      step_ = Step::kReadPosition;
      break;
    case Step::kReadPosition:
      if (!aimed_ && !are_same(reading.position, target_.positions[place_])) return differs();
      if (++place_ == kPlaces.size()) step_ = Step::kWriteVerdict;
      break;
    case Step::kWriteVerdict:
      verdict_ = done.number;
      step_ = Step::kReadVerdict;
      break;
    case Step::kReadVerdict:
      if (reading.number != verdict_) return differs();
      step_ = Step::kWriteAnswer;
      break;
    case Step::kWriteAnswer:
      answer_ = done.number;
      free_ = false;
      step_ = Step::kReadAnswer;
      break;
    case Step::kReadAnswer:
      if (reading.number != answer_) return differs();
      step_ = Step::kSettled;
      break;
    case Step::kSettled:
      break;
  }
}

// Another writes there, or the controller does not keep what it is given.
void Handshake::differs() {
  ++read_back_differed_;
  refuse(kReadBack);
}

}  // namespace arcstart::robot_link
