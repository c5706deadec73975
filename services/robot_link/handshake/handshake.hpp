// The talk between robot_link and the robot's own program, as a state machine without I/O: it says
// which register to read or write next, and is told what came of it. README.md has its table.
//
// What makes it safe: an answer counts only while kAnswer holds the robot's own request number.
// kAnswer is set to 0 before any other value of the answer changes, and to the number after all of
// them were read back. The robot writes kTaken and then reads kAnswer again; robot_link writes
// kAnswer := 0 and then reads kTaken again: whoever comes second sees the other (Dekker's flags,
// E. W. Dijkstra, EWD 123). Only then it reads kVerdict: a refusal under the same number may have
// come in a withdrawn answer's place. From kTaken to kDone nothing of an answer is written.
#pragma once

#include <optional>

#include "services/robot_link/handshake/refusals.hpp"
#include "services/robot_link/handshake/registers.hpp"

namespace arcstart::robot_link {

// us, on the steady clock.
struct HandshakeTimes {
  std::int64_t beat =
      300'000;  // between two of kLinkBeat: two requests of 66 ms later 2 Hz hold still
  std::int64_t robot_silent = 1'500'000;  // of kRobotBeat: three that were missed at 2 Hz
  // For a request that was there when this process began: until then its scan or its answer is
  // heard of, SCAN and SEAM being repeated at 1 Hz and more.
  std::int64_t recall = 2'500'000;
};

struct Question {
  std::int32_t request = 0, job = 0, part = 0;
  bool operator==(const Question&) const = default;
};

struct Answer {
  Question question;
  std::int32_t verdict = 0;  // kValid or a refusal number
  Positions positions{};     // of a valid one
  std::int64_t expires = 0;  // of a valid one that was not taken by then; us, steady
};

class Handshake {
 public:
  explicit Handshake(const HandshakeTimes& times = {}) : times_(times) {}

  // The controller's side. next() is to be carried out, then take() told; lost(): the connection
  // ended, and whether the last operation was carried out is not known. now: us, steady.
  Operation next(std::int64_t now);
  void take(const Operation& done, const Reading& reading, std::int64_t now);
  void lost();

  // The cell's side.
  void set_ready(bool ready) { ready_ = ready; }
  // The newest workpiece scan known is that of this request (0: nobody's); running or ended.
  void newest_scan(std::int64_t request, bool running);
  // Counts only where it is the pending question's, which has no answer yet.
  void answer(const Answer& answer);

  // The question that waits for an answer; nothing where none does.
  std::optional<Question> pending() const;
  // The same while a scan of it is still to be started.
  std::optional<Question> scan_wanted() const;

  enum class Progress { kNothing, kPending, kWriting, kDelivered, kTaken, kDone };
  struct Report {
    Progress progress = Progress::kNothing;
    Question question;                    // the last that was read
    std::int32_t verdict = 0;             // of its answer, 0: none yet
    bool robot_alive = false;             // its beat moves
    std::int32_t read_back_differed = 0;  // times
  };
  Report report() const;

 private:
  enum class Step {
    kSettled,  // the controller holds what it is to hold
    kWithdraw,
    kConfirm,
    kLookTaken,
    kLookDone,
    kWritePosition,
    kReadPosition,
    kWriteVerdict,
    kReadVerdict,
    kWriteAnswer,
    kReadAnswer,
  };
  struct Target {
    std::int32_t request = 0, verdict = 0;  // 0: no answer is to stand there
    Positions positions{};
    std::int64_t expires = 0;
  };
  // Between the robot's kTaken and kDone.
  bool locked() const { return taken_ != 0 && taken_ != done_; }
  bool is_pending() const { return question_.request != 0 && target_.request != question_.request; }
  bool is_open() const;  // a valid answer that was not taken
  void aim(const Target& target);
  void refuse(std::int32_t number);
  void judge(std::int64_t now);

  void take_number(Slot slot, std::int32_t number, std::int64_t now);
  void take_question();
  void get_acquainted(std::int64_t now);

  void begin_steps();
  Operation step() const;
  void take_step(const Operation& done, const Reading& reading);
  void differs();
  Status status() const;

  HandshakeTimes times_;
  bool ready_ = false;

  // The controller's registers as last read or written.
  std::int32_t request_ = 0, job_ = 0, part_ = 0, taken_ = 0, done_ = 0, robot_beat_ = 0;
  std::int32_t answer_ = 0, verdict_ = 0, link_beat_ = 0;
  std::optional<Status> shown_;
  std::int64_t beat_due_ = 0;

  bool acquainted_ = false;  // all were read since the connection was made
  std::size_t look_ = 0;     // which is read next: getting acquainted, of a question, watching
  bool reading_question_ = false;
  std::int32_t job_is_of_ = 0;  // the number that stood there when the job was read
  enum class Doing { kOwn, kStep, kQuestion, kWatch } doing_ = Doing::kOwn;  // by next()

  // Of kRobotBeat.
  std::int64_t beat_changed_ = 0;
  bool beat_moves_ = false;  // it was seen to, since the connection was made
  bool robot_silent_ = false;

  Question question_;                             // the last that was read
  bool scan_begun_ = false, scan_ended_ = false;  // of it
  bool first_ = true;                             // connection of this process
  bool recalled_ = false;                         // the question was there when this process began
  std::int64_t recall_until_ = 0;

  Target target_;         // what the controller is to hold
  bool adopted_ = false;  // it held it when this process began
  bool aimed_ = false;    // the target changed since the steps began
  Step step_ = Step::kSettled;
  std::size_t place_ = 0;  // of a step with a position
  bool free_ = false;      // kAnswer is 0, and kTaken was seen to be none after it
  std::int32_t read_back_differed_ = 0;
};

}  // namespace arcstart::robot_link
