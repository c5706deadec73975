#include "services/command_line/commands/calibrate_live.hpp"

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <optional>

#include "common/time.hpp"
#include "services/command_line/output/terminal.hpp"
#include "services/command_line/recordings/message_facts.hpp"

namespace arcstart::command_line {
namespace {

constexpr double kAnswer = 5, kCapture = 40, kSolution = 300, kMotion = 30;  // s, longest waits
constexpr std::int64_t kRepeat = 200'000;                                    // us
constexpr double kNotice = 0.6;  // s until an arm that was told to move does

class LiveCalibrator {
 public:
  explicit LiveCalibrator(const LiveCalibration& request)
      : request_(request),
        bus_((request.cell.empty() ? Configuration() : Configuration::from_file(request.cell))
                 .read<BusSettings>("bus")) {
    bus_.subscribe<calibration_capture_t>(
        request.instance.sensor_channel("CALIBRATION_CAPTURE"), Queue::newest(),
        [this](const calibration_capture_t& message) { state_ = message; });
    bus_.subscribe<truth_t>("CELL_TRUTH", Queue::newest(),
                            [this](const truth_t& message) { truth_ = message; });
  }

  int run() {
    if (!listen_until([this] { return state_.has_value(); }, kAnswer))
      return fail(
          fmt::format("no {} within {} s: does arcstart-calibration run, with "
                      "calibration.plate in its cell.yaml?",
                      request_.instance.sensor_channel("CALIBRATION_CAPTURE"), kAnswer));
    listen_until([this] { return truth_.has_value(); }, 1.5);
    if (request_.anew && state_->pose_count > 0 && !order(calibration_command_t::DISCARD, -1))
      return 1;
    if (!(truth_ ? take_poses_of_the_simulator() : take_poses_by_hand())) return 1;
    say("calibrates");
    if (!order(calibration_command_t::SOLVE)) return 1;
    fmt::print("{}\n", printable(state_->verdict, 1000));
    return 0;
  }

 private:
  static void say(const std::string& text) { std::cerr << "calibrate: " << text << "\n"; }
  static int fail(const std::string& why) {
    say(why);
    return 1;
  }

  bool listen_until(const std::function<bool()>& condition, double seconds,
                    const std::function<void()>& repeat = {}) {
    const std::int64_t end = steady_now() + seconds_to_us(seconds);
    for (std::int64_t next = 0; !condition() && steady_now() < end;) {
      if (repeat && steady_now() >= next) {
        repeat();
        next = steady_now() + kRepeat;
      }
      bus_.handle(std::chrono::milliseconds(50));
    }
    return condition();
  }

  // A command, until it is carried out; says why where it was not.
  bool order(std::int8_t action, int pose = 0) {
    calibration_command_t command{};
    command.command_id = utime_now();
    command.action = action;
    command.pose = pose;
    const auto taken = [&] { return state_->command_id == command.command_id; };
    const bool heard = listen_until(taken, kAnswer, [&] {
      command.utime = utime_now();
      bus_.publish(request_.instance.sensor_channel("CALIBRATION_COMMAND"), command);
    });
    const double patience = action == calibration_command_t::SOLVE ? kSolution : kCapture;
    ProgressLine progress;
    const bool done = heard && listen_until(
                                   [&] {
                                     progress.show("calibrate: " + printable(state_->activity));
                                     return taken() && state_->state == calibration_capture_t::IDLE;
                                   },
                                   patience);
    progress.clear();
    if (!done)
      say("arcstart-calibration does not answer: its log says why");
    else if (!state_->refusal.empty())
      say(printable(state_->refusal, 1000));
    return done && state_->refusal.empty();
  }

  // What cannot be used is not kept either: `arcstart calibrate` on the folder gives the same
  // again.
  void tell_pose() {
    const calibration_pose_t pose = state_->poses.back();
    if (!pose.usable) {
      say(fmt::format("pose {}: not usable, discarded: {}", pose.index, printable(pose.reason)));
      order(calibration_command_t::DISCARD, pose.index);
      return;
    }
    constexpr double kDegrees = 180 / std::numbers::pi;
    say(fmt::format("pose {}: usable{}; {}", pose.index,
                    pose.located
                        ? fmt::format(", tilt {:.0f} deg, roll {:.0f} deg, {:.0f} mm",
                                      pose.tilt * kDegrees, pose.roll * kDegrees, pose.distance)
                        : "",
                    printable(state_->advice)));
  }

  bool take_poses_of_the_simulator() {
    for (int number = 1; number <= request_.poses; ++number) {
      cell_command_t command{};
      command.command_id = utime_now();
      command.scene = cell_command_t::PLATE;
      command.seed = request_.seed;
      command.plate_pose = number;
      command.quaternion[0] = 1;
      const bool taken =
          listen_until([&] { return truth_->command_id == command.command_id; }, kMotion,
                       [&] {
                         command.utime = utime_now();
                         bus_.publish("CELL_COMMAND", command);
                       });
      if (!taken) {
        say(fmt::format("the simulated cell does not go to pose {}: its log says why", number));
        return false;
      }
      listen_until([] { return false; }, kNotice);
      listen_until([&] { return !truth_->moving; }, kMotion);
      if (order(calibration_command_t::CAPTURE)) tell_pose();
    }
    return true;
  }

  bool take_poses_by_hand() {
    say("move the robot to a pose, let it stand, and press Enter; s and Enter: solve, d and Enter: "
        "discard the last pose, q and Enter: leave, all poses are kept");
    for (std::string line;;) {
      std::cerr << fmt::format("calibrate: {} poses; next: {} > ", state_->pose_count,
                               printable(state_->advice));
      if (!std::getline(std::cin, line) || line == "q") return false;
      listen_until([] { return false; }, 0.1);  // what has come meanwhile
      if (line == "s") return true;
      if (line == "d") {
        if (!state_->poses.empty())
          order(calibration_command_t::DISCARD, state_->poses.back().index);
      } else if (order(calibration_command_t::CAPTURE)) {
        tell_pose();
      }
    }
  }

  LiveCalibration request_;
  Bus bus_;
  std::optional<calibration_capture_t> state_;
  std::optional<truth_t> truth_;
};

}  // namespace

int calibrate_live(const LiveCalibration& request) { return LiveCalibrator(request).run(); }

}  // namespace arcstart::command_line
