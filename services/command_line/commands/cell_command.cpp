#include "services/command_line/commands/cell_command.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "common/bus/bus.hpp"
#include "common/options.hpp"
#include "common/service.hpp"
#include "common/time.hpp"
#include "services/command_line/cell/cell_check.hpp"
#include "services/command_line/output/seam_error.hpp"
#include "services/command_line/recordings/message_facts.hpp"

namespace arcstart::command_line {
namespace {

struct CellRequest {
  std::string cell, sensor = "LASER0", robot = "ROBOT0", scene;
  std::int64_t seed = -1;
  bool verdict = false, torch = false;
  bool checked = false;  // `cell check` was asked for
  double timeout_s = 10;
};

template <class Numbers>
std::vector<double> list(const Numbers& numbers) {
  return {std::begin(numbers), std::end(numbers)};
}

void print_truth(const truth_t& truth) {
  const nlohmann::ordered_json json = {
      {"scene", truth.scene == cell_command_t::WORKPIECE ? "workpiece" : "background"},
      {"seed", truth.seed},
      {"joint_type", truth.joint_type},
      {"start", list(truth.start)},
      {"end", list(truth.end)},
      {"direction", list(truth.direction)},
      {"angle", truth.angle}};
  fmt::print("{}\n", json.dump(2));
}

// Sends the command at 5 Hz until CELL_TRUTH shows it.
int change_scene(Bus& bus, const CellRequest& request) {
  cell_command_t command{};
  command.command_id = utime_now();
  command.scene =
      request.scene == "workpiece" ? cell_command_t::WORKPIECE : cell_command_t::BACKGROUND;
  command.seed = request.seed;
  command.quaternion[0] = 1;
  std::optional<truth_t> truth;
  bus.subscribe<truth_t>("CELL_TRUTH", Queue::newest(), [&](const truth_t& message) {
    if (message.command_id == command.command_id) truth = message;
  });
  const std::int64_t end = steady_now() + seconds_to_us(request.timeout_s);
  for (std::int64_t next = 0; !truth && steady_now() < end;
       bus.handle(std::chrono::milliseconds(50))) {
    if (steady_now() < next) continue;
    command.utime = utime_now();
    bus.publish("CELL_COMMAND", command);
    next = steady_now() + 200'000;
  }
  if (!truth) {
    fmt::print(stderr,
               "cell: no simulated cell answers within {} s: does arcstart-cell-simulator run, and "
               "no search in it?\n",
               request.timeout_s);
    return 1;
  }
  print_truth(*truth);
  return 0;
}

// The seam that stands on the bus beside the truth.
int compare(Bus& bus, const CellRequest& request) {
  std::optional<truth_t> truth;
  std::optional<seam_t> seam;
  bus.subscribe<truth_t>("CELL_TRUTH", Queue::newest(),
                         [&](const truth_t& message) { truth = message; });
  bus.subscribe<seam_t>(request.sensor + "_SEAM", Queue::newest(), [&](const seam_t& message) {
    if (message.verdict != seam_t::BACKGROUND_STORED) seam = message;
  });
  const std::int64_t end = steady_now() + seconds_to_us(request.timeout_s);
  while (!(truth && seam) && steady_now() < end) bus.handle(std::chrono::milliseconds(50));
  if (!truth || !seam) {
    fmt::print(stderr, "cell: {} within {} s\n",
               !truth ? "no CELL_TRUTH: no simulated cell runs" : "no seam of a workpiece scan",
               request.timeout_s);
    return 1;
  }
  if (truth->joint_type.empty()) {
    fmt::print(stderr, "cell: there is no seam in the scene\n");
    return 1;
  }
  const auto row = [](const char* name, const double answer[3], const double right[3],
                      const char* unit) {
    fmt::print("{:<10}{:>10.3f}{:>10.3f}{:>10.3f}   {:>10.3f}{:>10.3f}{:>10.3f} {}\n", name,
               answer[0], answer[1], answer[2], right[0], right[1], right[2], unit);
  };
  if (seam->verdict == seam_t::FOUND) {
    fmt::print("{:<10}{:>30}   {:>30}\n", "in base", "answer", "truth");
    row("start", seam->start, truth->start, "mm");
    row("end", seam->end, truth->end, "mm");
    row("direction", seam->direction, truth->direction, "");
  }
  fmt::print("{}\n", verdict_line(*seam, *truth));
  return seam->verdict == seam_t::FOUND && !seam_error(*seam, *truth).wrong ? 0 : 1;
}

// Where the simulated robot's program put the torch's tip, beside the seam's true start.
int measure_torch(Bus& bus, const CellRequest& request) {
  std::optional<truth_t> truth;
  std::optional<delivery_t> delivery;
  bus.subscribe<truth_t>("CELL_TRUTH", Queue::newest(),
                         [&](const truth_t& message) { truth = message; });
  bus.subscribe<delivery_t>(request.robot + "_DELIVERY", Queue::newest(),
                            [&](const delivery_t& message) { delivery = message; });
  const auto done = [&] {
    if (!truth || truth->moving || !delivery) return false;
    const bool refused = delivery->verdict != 0 && delivery->verdict != delivery_t::VALID;
    return delivery->progress == delivery_t::DONE ||
           (refused && delivery->progress >= delivery_t::DELIVERED);
  };
  const std::int64_t end = steady_now() + seconds_to_us(request.timeout_s);
  while (!done() && steady_now() < end) bus.handle(std::chrono::milliseconds(50));
  if (!done()) {
    fmt::print(stderr, "cell: {} within {} s\n",
               !truth      ? "no CELL_TRUTH: no simulated cell runs"
               : !delivery ? "no DELIVERY: robot_link does not run"
                           : "the robot's program has not come to its end",
               request.timeout_s);
    return 1;
  }
  if (delivery->verdict != delivery_t::VALID) {
    fmt::print(stderr, "cell: the robot was refused: {} ({})\n", printable(delivery->reason),
               delivery->verdict);
    return 1;
  }
  const double off = std::hypot(truth->tool_position[0] - truth->start[0],
                                truth->tool_position[1] - truth->start[1],
                                truth->tool_position[2] - truth->start[2]);
  fmt::print("torch at the start: {:.2f} mm from the true seam start\n", off);
  return 0;
}

}  // namespace

void add_cell_command(CLI::App& parent, int& exit_code) {
  auto request = std::make_shared<CellRequest>();
  Command command(parent, "cell",
                  "check: is this host fit for its cell? Else the simulated cell: change its "
                  "scene, or hold the "
                  "seam that was found against the truth");
  add_cell_check(command, request->checked, exit_code);
  command
      .option("--scene", request->scene,
              "Show the empty table or the work: background or workpiece")
      .one_of({"background", "workpiece"});
  command.option("--seed", request->seed, "Seed of the scene; without it the one in force stays");
  command.flag("--verdict", request->verdict,
               "Print the seam on the bus beside the truth; exit 0 where it is right");
  command.flag("--torch", request->torch,
               "Wait for the robot's program, and print how far its torch stands from the seam's "
               "true start");
  command.option("--robot", request->robot, "Robot whose torch is meant").show_default();
  command.option("--cell", request->cell, "The cell's file, for its bus; without it the defaults");
  command.option("--sensor", request->sensor, "Sensor whose seam is meant").show_default();
  command.option("--timeout", request->timeout_s, "Longest wait for an answer; s").show_default();
  command.run([request, &exit_code] {
    if (request->checked) return;
    if (int{request->verdict} + int{request->torch} + int{!request->scene.empty()} != 1) {
      fmt::print(stderr, "cell: give one of --scene, --verdict and --torch\n");
      exit_code = 2;
      return;
    }
    const Configuration configuration =
        request->cell.empty() ? Configuration() : Configuration::from_file(request->cell);
    Bus bus(configuration.read<BusSettings>("bus"));
    exit_code = request->torch     ? measure_torch(bus, *request)
                : request->verdict ? compare(bus, *request)
                                   : change_scene(bus, *request);
  });
}

}  // namespace arcstart::command_line
