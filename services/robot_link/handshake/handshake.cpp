#include "services/robot_link/handshake/handshake.hpp"

#include <array>
#include <limits>

namespace arcstart::robot_link {
namespace {

// The controller's number first: it says whether anything was delivered.
constexpr std::array kAcquaintance = {Slot::kAnswer, Slot::kVerdict, Slot::kTaken,
                                      Slot::kDone,   Slot::kRequest, Slot::kJob,
                                      Slot::kPart,   Slot::kRequest, Slot::kRobotBeat};
// Of a new number: job and part were written before it, and it must still be there after them.
constexpr std::array kOfQuestion = {Slot::kJob, Slot::kPart, Slot::kRequest};
constexpr std::array kWatched = {Slot::kRobotBeat, Slot::kRequest, Slot::kTaken, Slot::kDone};
constexpr std::int32_t kBeats = 1'000'000;        // the link's count: whole in a 32-bit float, too
constexpr std::size_t kWatchedWithoutAnswer = 2;  // of these: nothing can be taken then

}  // namespace

// ---- the cell's side

void Handshake::newest_scan(std::int64_t request, bool running) {
  if (question_.request != 0 && request == question_.request) {
    scan_begun_ = true;
    scan_ended_ = !running;
    recalled_ = false;
    return;
  }
  if (target_.verdict != kValid) return;
  if (is_open())
    refuse(kSuperseded);
  else
    aim({target_.request, 0, {}, 0});
}

void Handshake::answer(const Answer& answer) {
  if (adopted_ && answer.question.request == target_.request) {
    adopted_ = false;
    if (answer.verdict != kValid && target_.verdict == kValid)
      refuse(answer.verdict);
    else
      target_.expires = answer.expires;
    return;
  }
  if (!is_pending() || answer.question != question_) return;
  recalled_ = false;
  aim({answer.question.request, answer.verdict, answer.positions, answer.expires});
}

std::optional<Question> Handshake::pending() const {
  return acquainted_ && is_pending() ? std::optional(question_) : std::nullopt;
}

// Only when nothing of the former answer stands any more.
std::optional<Question> Handshake::scan_wanted() const {
  return free_ && !scan_begun_ && !recalled_ ? pending() : std::nullopt;
}

Handshake::Report Handshake::report() const {
  Report report;
  report.question = question_;
  report.robot_alive = beat_moves_ && !robot_silent_;
  report.read_back_differed = read_back_differed_;
  if (question_.request == 0) return report;
  report.progress = Progress::kPending;
  if (target_.request != question_.request) return report;
  report.verdict = target_.verdict;
  const bool stands = acquainted_ && step_ == Step::kSettled && !aimed_;
  report.progress = done_ == target_.request    ? Progress::kDone
                    : taken_ == target_.request ? Progress::kTaken
                    : stands                    ? Progress::kDelivered
                                                : Progress::kWriting;
  return report;
}

// ---- time

bool Handshake::is_open() const {
  return target_.request != 0 && target_.verdict == kValid && taken_ != target_.request &&
         done_ != target_.request;
}

void Handshake::judge(std::int64_t now) {
  if (is_open() && now > target_.expires) refuse(kTooOld);
  if ((is_open() || is_pending()) && robot_silent_) refuse(kRobotSilent);
  if (is_pending() && recalled_ && now > recall_until_) refuse(kAskAgain);
}

void Handshake::refuse(std::int32_t number) { aim({question_.request, number, {}, 0}); }

void Handshake::aim(const Target& target) {
  target_ = target;
  aimed_ = true;
  adopted_ = false;
}

// ---- the controller's side

void Handshake::lost() {
  acquainted_ = beat_moves_ = robot_silent_ = reading_question_ = free_ = false;
  look_ = 0;
  shown_.reset();
}

Operation Handshake::next(std::int64_t now) {
  if (!acquainted_) return Operation::read(kAcquaintance[look_]);
  judge(now);
  doing_ = Doing::kOwn;
  if (now >= beat_due_) return Operation::write(Slot::kLinkBeat, link_beat_ % kBeats + 1);
  if (!locked() && aimed_) begin_steps();
  if (!locked() && step_ != Step::kSettled) {
    doing_ = Doing::kStep;
    return step();
  }
  if (shown_ != status())
    return Operation::write(Slot::kStatus, static_cast<std::int32_t>(status()));
  if (!locked() && request_ > 0 && request_ != question_.request && beat_moves_ && !robot_silent_) {
    if (!reading_question_) look_ = 0;
    reading_question_ = true;
    doing_ = Doing::kQuestion;
    return Operation::read(kOfQuestion[look_]);
  }
  reading_question_ = false;
  doing_ = Doing::kWatch;
  if (look_ >= (answer_ != 0 || locked() ? kWatched.size() : kWatchedWithoutAnswer)) look_ = 0;
  return Operation::read(kWatched[look_]);
}

void Handshake::take(const Operation& done, const Reading& reading, std::int64_t now) {
  const bool is_number = done.kind == Operation::Kind::kReadNumber;
  if (is_number) take_number(done.slot, reading.number, now);
  if (!acquainted_) {
    if (++look_ == kAcquaintance.size()) get_acquainted(now);
    return;
  }
  switch (doing_) {
    case Doing::kOwn:
      if (done.slot == Slot::kLinkBeat) {
        link_beat_ = done.number;
        beat_due_ = now + times_.beat;
      } else {
        shown_ = static_cast<Status>(done.number);
      }
      break;
    case Doing::kStep:
      take_step(done, reading);
      break;
    case Doing::kQuestion:
      if (++look_ == kOfQuestion.size()) take_question();
      break;
    case Doing::kWatch:
      ++look_;
      break;
  }
}

void Handshake::take_number(Slot slot, std::int32_t number, std::int64_t now) {
  switch (slot) {
    case Slot::kRequest:
      request_ = number;
      break;
    case Slot::kJob:
      job_ = number;
      job_is_of_ = request_;
      break;
    case Slot::kPart:
      part_ = number;
      break;
    case Slot::kTaken:
      taken_ = number;
      break;
    case Slot::kDone:
      done_ = number;
      break;
    case Slot::kRobotBeat:
      if (acquainted_ && number != robot_beat_) {
        beat_moves_ = true;
        robot_silent_ = false;
        beat_changed_ = now;
      }
      robot_beat_ = number;
      if (acquainted_ && now - beat_changed_ > times_.robot_silent) robot_silent_ = true;
      break;
    case Slot::kAnswer:
      if (!acquainted_) answer_ = number;
      break;
    case Slot::kVerdict:
      if (!acquainted_) verdict_ = number;
      break;
    default:
      break;
  }
}

// All was read. What stands there is kept where it is what is to stand there.
void Handshake::get_acquainted(std::int64_t now) {
  acquainted_ = true;
  look_ = 0;
  beat_changed_ = now;
  beat_due_ = now;
  free_ = false;
  if (first_ && request_ > 0 && job_is_of_ == request_) {
    question_ = {request_, job_, part_};
    if (answer_ == request_) {
      target_ = {request_, verdict_, {}, std::numeric_limits<std::int64_t>::max()};
      adopted_ = true;
    } else if (done_ != request_) {
      recalled_ = true;
      recall_until_ = now + times_.recall;
    } else {
      target_.request = request_;  // was answered and dealt with, and need not stand there
    }
  }
  first_ = false;
  const bool as_aimed = answer_ == target_.request && verdict_ == target_.verdict;
  step_ = Step::kSettled;
  aimed_ = !as_aimed || answer_ == 0;
}

// Its job and part were read between two looks at the same number.
void Handshake::take_question() {
  reading_question_ = false;
  look_ = 0;
  if (job_is_of_ != request_) return;
  question_ = {request_, job_, part_};
  scan_begun_ = scan_ended_ = recalled_ = false;
  aim({});
}

Status Handshake::status() const {
  if (question_.request != 0 && done_ != question_.request) {
    if (!is_pending()) return Status::kAnswered;
    return scan_ended_ ? Status::kScanEnded : scan_begun_ ? Status::kScanning : Status::kBusy;
  }
  return ready_ ? Status::kReady : Status::kNotReady;
}

}  // namespace arcstart::robot_link
