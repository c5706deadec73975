// arcstart: what a person types. A subcommand a job.
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <iostream>

#include "common/input_error.hpp"
#include "common/options.hpp"
#include "services/command_line/commands/calibrate_command.hpp"
#include "services/command_line/commands/cell_command.hpp"
#include "services/command_line/commands/check_command.hpp"
#include "services/command_line/commands/extract_command.hpp"
#include "services/command_line/commands/find_seam_command.hpp"
#include "services/command_line/commands/import_command.hpp"
#include "services/command_line/commands/monitor_command.hpp"
#include "services/command_line/commands/replay_command.hpp"
#include "services/command_line/commands/scan_command.hpp"
#include "services/command_line/commands/time_offset_command.hpp"
#include "services/command_line/output/standard_output.hpp"

namespace {

void complain(const arcstart::Program& program, const std::exception& error) {
  const std::string command = program.command();
  std::cerr << (command.empty() ? "arcstart" : command) << ": " << error.what() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  using namespace arcstart;
  using namespace arcstart::command_line;
  // What the stages have to say in replay goes to standard error; standard output is for results.
  spdlog::set_default_logger(spdlog::stderr_logger_mt("arcstart"));
  spdlog::set_level(spdlog::level::warn);
  spdlog::set_pattern("%n: %l: %v");
  Program program("arcstart: finds where a welding robot is to strike the arc");
  program.version(ARCSTART_VERSION);
  program.require_command();
  program.footer("arcstart COMMAND --help tells all of a command.");
  int exit_code = 0;
  add_scan_command(program.app(), exit_code);
  add_replay_command(program.app(), exit_code);
  add_import_command(program.app(), exit_code);
  add_extract_command(program.app(), exit_code);
  add_find_seam_command(program.app(), exit_code);
  add_calibrate_command(program.app(), exit_code);
  add_time_offset_command(program.app(), exit_code);
  add_check_command(program.app(), exit_code);
  add_monitor_command(program.app(), exit_code);
  add_cell_command(program.app(), exit_code);
  try {
    const int code = program.parse(argc, argv).value_or(exit_code);
    check_standard_output();
    return code;
  } catch (const std::exception& error) {
    complain(program, error);
    return dynamic_cast<const InputError*>(&error) != nullptr ? 2 : 1;
  }
}
