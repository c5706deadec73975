#include "services/command_line/cell/cell_check.hpp"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "common/time.hpp"
#include "services/command_line/cell/census.hpp"
#include "services/command_line/cell/host_checks.hpp"

namespace arcstart::command_line {
namespace {

struct CheckOptions {
  std::string cell;
  Instance instance;
  double seconds = 3;  // STATUS and CALIBRATION come at 1 Hz, and one may be lost
};

std::vector<CheckLine> look(const CheckOptions& options) {
  const Configuration configuration =
      options.cell.empty() ? Configuration() : Configuration::from_file(options.cell);
  const auto settings = configuration.read<BusSettings>("bus");
  const HostFacts facts = host_facts(settings, options.instance.state_folder);
  if (facts.interface.empty()) {
    std::vector<CheckLine> lines = host_checks(facts, settings);
    lines.push_back({"bus", "not looked at", "mend the route, then look again"});
    return lines;
  }
  Bus bus(settings);
  const Census census(bus, options.instance);
  const std::int64_t end = steady_now() + seconds_to_us(options.seconds);
  while (steady_now() < end) bus.handle(std::chrono::milliseconds(50));
  const std::string cell = options.cell.empty() ? "CELL.yaml" : options.cell;
  std::vector<CheckLine> lines = host_checks(facts, settings);
  for (CheckLine& line : census.lines(ARCSTART_VERSION, cell)) lines.push_back(std::move(line));
  return lines;
}

int run(const CheckOptions& options) {
  const std::vector<CheckLine> lines = look(options);
  std::cout << to_text(lines, isatty(STDOUT_FILENO) != 0);
  return std::all_of(lines.begin(), lines.end(),
                     [](const CheckLine& line) { return line.mended_by.empty(); })
             ? 0
             : 1;
}

}  // namespace

void add_cell_check(Command& cell, bool& given, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  options->instance.state_folder = default_state_folder();
  Command command(
      cell, "check",
      "Whether this host is fit for its cell: clock, route, buffers, disk, calibration, "
      "versions, who is on the bus");
  command.option("--cell", options->cell, "The cell's file, for its bus; without it the defaults");
  command.option("--sensor", options->instance.sensor, "Sensor whose chain is meant")
      .show_default();
  command.option("--robot", options->instance.robot, "Robot that carries it").show_default();
  command
      .option("--state", options->instance.state_folder,
              "Folder in which the services keep what must outlive them")
      .show_default();
  command.option("--seconds", options->seconds, "How long to listen; s")
      .show_default()
      .between(0.1, 600.0);
  command.footer(
      "To be run on each host of a cell, while its services run. A line each: good, or MEND with "
      "the command that mends it beneath.\n"
      "Exit: 0 all is good; 1 something is to be mended; 2 bad input.");
  command.run([options, &given, &exit_code] {
    given = true;
    exit_code = run(*options);
  });
}

}  // namespace arcstart::command_line
