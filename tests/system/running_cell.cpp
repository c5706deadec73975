#include "tests/system/running_cell.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/time.hpp"
#include "paths.hpp"
#include "services/command_line/output/seam_error.hpp"

namespace arcstart {
namespace {

std::string read_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Replaces "section.key: value" in the text of a cell file; adds what is not there.
std::string changed(const std::string& text, const std::vector<std::string>& changes) {
  YAML::Node cell = YAML::Load(text);
  for (const std::string& change : changes) {
    const std::size_t dot = change.find('.'), colon = change.find(": ");
    cell[change.substr(0, dot)][change.substr(dot + 1, colon - dot - 1)] =
        YAML::Load(change.substr(colon + 2));
  }
  return YAML::Dump(cell) + "\n";
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const std::string& error_file,
                 const std::string& output_file) {
  std::vector<char*> argv;
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing outlives the test
  dup2(open(error_file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644), 2);
  dup2(open(output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), 1);
  execv(argv[0], argv.data());
  _exit(127);
}

Process::~Process() {
  if (wait(0)) return;
  send(SIGTERM);
  if (wait(5)) return;
  send(SIGKILL);
  wait(5);
}

void Process::send(int signal) {
  if (!code_) kill(pid_, signal);
}

std::optional<int> Process::wait(double seconds) {
  for (const std::int64_t end = steady_now() + seconds_to_us(seconds); !code_;) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_)
      code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    else if (steady_now() >= end)
      break;
    else
      usleep(5000);
  }
  return code_;
}

std::string program(const std::string& name) {
  return std::string(ARCSTART_BUILD) + "/bin/" + name;
}

Output run(const std::vector<std::string>& arguments, double seconds) {
  const std::string base = fmt::format("/tmp/arcstart-run-{}-{}", getpid(), steady_now());
  Process process(arguments, base + ".err", base + ".out");
  const std::optional<int> code = process.wait(seconds);
  Output output{code.value_or(-1), read_file(base + ".out"), read_file(base + ".err")};
  std::filesystem::remove(base + ".out");
  std::filesystem::remove(base + ".err");
  return output;
}

RunningCell::RunningCell(const std::string& name, const std::vector<std::string>& changes)
    : folder_(std::string(ARCSTART_BUILD) + "/tests/system/" + name) {
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_ + "/state");
  std::vector<std::string> all = changes;
  const std::string calibration = folder_ + "/LASER0.calibration.yaml";
  all.push_back("calibration.file: " + calibration);
  all.push_back("cell_simulator.calibration_file: " + calibration);
  std::ofstream(cell_file()) << changed(
      read_file(std::string(ARCSTART_SOURCE) + "/scripts/simulated_cell.yaml"), all);

  bus_ = std::make_unique<Bus>(BusSettings{});
  bus_->subscribe<image_t>("LASER0_IMAGE", Queue::images(), [this](const image_t& m) {
    heard_.images.push_back(m);
    heard_.images.back().data.clear();
    heard_.image_heard[m.scan_id] = steady_now();
  });
  bus_->subscribe<stripe_t>("LASER0_STRIPE", Queue::measurements(),
                            [this](const stripe_t& m) { heard_.stripes.push_back(m); });
  bus_->subscribe<profile_t>("LASER0_PROFILE", Queue::measurements(),
                             [this](const profile_t& m) { heard_.profiles.push_back(m); });
  bus_->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(),
                                [this](const robot_pose_t& m) { heard_.poses.push_back(m); });
  bus_->subscribe<seam_t>("LASER0_SEAM", Queue::measurements(), [this](const seam_t& m) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(m.getEncodedSize()));
    m.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    heard_.seam_heard.try_emplace(m.scan_id, steady_now());
    if (std::find(heard_.seam_bytes.begin(), heard_.seam_bytes.end(), bytes) !=
        heard_.seam_bytes.end())
      return;
    heard_.seams.push_back(m);
    heard_.seam_bytes.push_back(bytes);
  });
  bus_->subscribe<scan_t>("LASER0_SCAN", Queue::measurements(),
                          [this](const scan_t& m) { heard_.scan = m; });
  bus_->subscribe<truth_t>("CELL_TRUTH", Queue::newest(),
                           [this](const truth_t& m) { heard_.truth = m; });
  for (const auto& service : services())
    bus_->subscribe<service_status_t>(
        status_channel({}, {service, "", service == "robot_pose"}), Queue::newest(),
        [this, service](const service_status_t& m) { heard_.statuses[service] = m; });
  bus_->handle(std::chrono::milliseconds(1));
  load_.kept_up({});  // from now on
}

bool RunningCell::machine_kept_up() {
  std::vector<pid_t> pids;
  for (const auto& [service, process] : processes_) pids.push_back(process->pid());
  return load_.kept_up(pids);
}

RunningCell::~RunningCell() {
  for (auto& [service, process] : processes_) process->send(SIGTERM);
}

void RunningCell::change(const std::vector<std::string>& changes) {
  const std::string text = changed(read_file(cell_file()), changes);
  std::ofstream(cell_file()) << text;
}

const std::vector<std::string>& RunningCell::services() {
  static const std::vector<std::string> names = {"cell_simulator", "calibration", "robot_pose",
                                                 "sensor_capture", "extraction",  "reconstruction",
                                                 "seam_finding"};
  return names;
}

void RunningCell::start(const std::string& service, const std::vector<std::string>& options) {
  std::string name = "arcstart-" + service;
  std::replace(name.begin(), name.end(), '_', '-');
  std::vector<std::string> arguments = {program(name), "--cell", cell_file(), "--state",
                                        folder_ + "/state"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  heard_.statuses.erase(service);
  processes_[service] = std::make_unique<Process>(arguments, folder_ + "/" + service + ".log");
}

void RunningCell::start_all() {
  for (const auto& service : services()) start(service);
}

void RunningCell::kill_9(const std::string& service) {
  process(service).send(SIGKILL);
  process(service).wait(5);
}

void RunningCell::terminate(const std::string& service) {
  process(service).send(SIGTERM);
  process(service).wait(5);
}

std::string RunningCell::log_of(const std::string& service) const {
  return read_file(folder_ + "/" + service + ".log");
}

service_status_t RunningCell::status(const std::string& service) const {
  const auto found = heard_.statuses.find(service);
  return found == heard_.statuses.end() ? service_status_t{} : found->second;
}

void RunningCell::listen(double seconds) {
  listen_until([] { return false; }, seconds);
}

bool RunningCell::listen_until(const std::function<bool()>& condition, double seconds) {
  for (const std::int64_t end = steady_now() + seconds_to_us(seconds);
       !condition() && steady_now() < end;)
    bus_->handle(std::chrono::milliseconds(20));
  return condition();
}

bool RunningCell::wait_until_ready(double seconds) {
  return listen_until(
      [this] {
        for (const auto& [service, process] : processes_) {
          const auto status = heard_.statuses.find(service);
          if (status == heard_.statuses.end() ||
              status->second.state > service_status_t::DEGRADED ||
              status->second.state == service_status_t::STARTING)
            return false;
        }
        return !heard_.poses.empty() && heard_.scan.has_value();
      },
      seconds);
}

std::int64_t RunningCell::command(std::int8_t action, std::int8_t kind, double longest_duration,
                                  std::int64_t id) {
  scan_command_t command{};
  command.utime = command.command_id = id != 0 ? id : utime_now();
  command.action = action;
  command.kind = kind;
  command.longest_duration = longest_duration;
  bus_->publish("LASER0_SCAN_COMMAND", command);
  return command.command_id;
}

std::optional<seam_t> RunningCell::seam_of(std::int64_t scan_id) const {
  for (const seam_t& seam : heard_.seams)
    if (seam.scan_id == scan_id) return seam;
  return {};
}

bool RunningCell::send_to_cell(std::int8_t scene, std::int64_t seed) {
  cell_command_t command{};
  command.command_id = command.utime = utime_now();
  command.scene = scene;
  command.seed = seed;
  command.quaternion[0] = 1;
  return listen_until(
      [&] {
        if (heard_.truth && heard_.truth->command_id == command.command_id) return true;
        bus_->publish("CELL_COMMAND", command);
        bus_->handle(std::chrono::milliseconds(200));
        return false;
      },
      30);
}

bool RunningCell::change_scene(bool workpiece, std::int64_t seed) {
  return send_to_cell(workpiece ? cell_command_t::WORKPIECE : cell_command_t::BACKGROUND, seed);
}

bool RunningCell::wait_for_arm() { return send_to_cell(cell_command_t::KEEP, -1); }

std::int64_t RunningCell::begin_scan(std::int8_t kind) {
  if (!wait_for_arm()) return 0;
  const std::int64_t id = utime_now();
  const auto began = [&] {
    if (heard_.scan && heard_.scan->command_id == id) return true;
    command(scan_command_t::START, kind, 20, id);  // again: a packet may be lost
    bus_->handle(std::chrono::milliseconds(200));
    return false;
  };
  return listen_until(began, 30) ? heard_.scan->scan_id : 0;
}

std::optional<seam_t> RunningCell::scan(std::int8_t kind, double seconds) {
  const std::int64_t scan_id = begin_scan(kind);
  if (scan_id == 0) return {};
  listen_until([&] { return seam_of(scan_id).has_value(); }, seconds);
  return seam_of(scan_id);
}

bool RunningCell::finds_right_seam() {
  for (int attempt = 0; attempt < 3; ++attempt) {
    machine_kept_up();
    const auto seam = scan(scan_t::WORKPIECE);
    if (seam && seam->verdict == seam_t::FOUND)
      return !command_line::seam_error(*seam, *heard_.truth).wrong;
    if (machine_kept_up()) return false;
  }
  fmt::print(stderr, "running cell: the machine did not keep up, no seam was judged\n");
  return true;
}

}  // namespace arcstart
