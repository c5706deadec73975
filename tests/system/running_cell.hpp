// A whole simulated cell out of real processes, over real multicast, for tests in a private
// network.
#pragma once

#include <sys/types.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/service.hpp"
#include "tests/system/machine_load.hpp"

namespace arcstart {

// A child process, its standard error in a file. Ended by the destructor at the latest.
class Process {
 public:
  Process(const std::vector<std::string>& arguments, const std::string& error_file,
          const std::string& output_file = "/dev/null");
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal);
  std::optional<int> wait(
      double seconds);  // exit code, 128 + signal where one ended it; nothing while it runs
  bool is_running() { return !wait(0); }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
  std::optional<int> code_;
};

// What one channel carried, in order.
struct Heard {
  std::vector<image_t> images;  // without their bytes
  std::vector<stripe_t> stripes;
  std::vector<profile_t> profiles;
  std::vector<robot_pose_t> poses;
  std::vector<seam_t> seams;  // each answer once
  std::vector<std::vector<std::uint8_t>> seam_bytes;
  std::optional<scan_t> scan;
  std::optional<truth_t> truth;
  std::map<std::string, service_status_t> statuses;  // by service
  std::map<std::int64_t, std::int64_t> image_heard,
      seam_heard;  // us, steady, by scan_id: last image, first seam
};

class RunningCell {
 public:
  // A folder of its own under the build's; `changes`: lines "section.key: value" that replace those
  // of scripts/simulated_cell.yaml. Starts nothing yet.
  RunningCell(const std::string& name, const std::vector<std::string>& changes = {});
  ~RunningCell();

  // The same for services that are started from now on.
  void change(const std::vector<std::string>& changes);

  static const std::vector<std::string>& services();
  void start(const std::string& service, const std::vector<std::string>& options = {});
  void start_all();
  void kill_9(const std::string& service);
  void terminate(const std::string& service);
  Process& process(const std::string& service) { return *processes_.at(service); }

  Bus& bus() { return *bus_; }
  const Heard& heard() const { return heard_; }
  service_status_t status(const std::string& service) const;  // newest, empty where none came
  void forget() { heard_ = {}; }
  std::string folder() const { return folder_; }
  std::string cell_file() const { return folder_ + "/cell.yaml"; }
  std::string log_of(const std::string& service) const;  // its standard error so far

  void listen(double seconds);
  bool listen_until(const std::function<bool()>& condition, double seconds);
  // Every started service states RUNNING or DEGRADED with the calibration, camera and positions
  // there.
  bool wait_until_ready(double seconds = 60);
  // Whether the machine kept up since the start, or since this was asked last: the kernel dropped
  // no packet in this network, and no service waited for a processor for a fifth of the time. Where
  // it did not, images and positions are lost by nobody's fault.
  bool machine_kept_up();

  // Through LASER0_SCAN_COMMAND as an operator does; the answer, or nothing where none came in
  // time.
  // id: of the command, 0 for a new one; returned.
  std::int64_t command(std::int8_t action, std::int8_t kind, double longest_duration = 20,
                       std::int64_t id = 0);
  // Its id when it has begun, 0 where it did not in time.
  std::int64_t begin_scan(std::int8_t kind);
  std::optional<seam_t> scan(std::int8_t kind, double seconds = 60);
  // Scans the workpiece, again where it was refused while the machine did not keep up, three times
  // at most. False where an answer is wrong, or a refusal or silence has no such excuse.
  bool finds_right_seam();
  std::optional<seam_t> seam_of(std::int64_t scan_id) const;
  // Both are carried out when the arm rests where a search begins.
  bool change_scene(bool workpiece, std::int64_t seed);
  bool wait_for_arm();

 private:
  bool send_to_cell(std::int8_t scene, std::int64_t seed);

  std::string folder_;
  std::unique_ptr<Bus> bus_;
  std::map<std::string, std::unique_ptr<Process>> processes_;
  Heard heard_;
  MachineLoad load_;
};

// Runs a program to its end: exit code, standard output and standard error.
struct Output {
  int code;
  std::string out, err;
};
Output run(const std::vector<std::string>& arguments, double seconds = 60);
std::string program(const std::string& name);  // in the build's bin/

}  // namespace arcstart

// REQUIRE, of a test case in which a cell runs: what fails while the machine does not keep up is
// not judged, and ends the case.
#define ARCSTART_REQUIRE_OF(cell, condition)                             \
  do {                                                                   \
    const bool holds = static_cast<bool>(condition);                     \
    if (!holds && !(cell).machine_kept_up()) {                           \
      WARN("the machine did not keep up: " #condition " is not judged"); \
      return;                                                            \
    }                                                                    \
    INFO(#condition);                                                    \
    REQUIRE(holds);                                                      \
  } while (false)
