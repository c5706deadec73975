#include "services/command_line/commands/scan_command.hpp"

#include <csignal>
#include <iostream>
#include <memory>

#include "common/bus/value_checks.hpp"
#include "common/options.hpp"
#include "common/time.hpp"
#include "services/command_line/live/scan_client.hpp"
#include "services/command_line/output/seam_json.hpp"
#include "services/command_line/output/terminal.hpp"
#include "services/command_line/recordings/message_facts.hpp"

namespace arcstart::command_line {
namespace {

struct ScanOptions {
  std::string kind, cell;
  Instance instance;
  ScanRequest request;
};

volatile std::sig_atomic_t stop_asked = 0;

// The second Ctrl-C ends the program at once.
void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_asked = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int run(ScanOptions options) {
  options.request.kind = options.kind == "background" ? scan_t::BACKGROUND : scan_t::WORKPIECE;
  const Configuration configuration =
      options.cell.empty() ? Configuration() : Configuration::from_file(options.cell);
  Bus bus(configuration.read<BusSettings>("bus"));
  ScanClient client(bus, options.instance, options.request);
  ProgressLine progress;
  catch_interrupts();
  while (!client.is_done()) {
    client.tick(steady_now(), utime_now());
    progress.show(client.progress());
    bus.handle(std::chrono::milliseconds(50));
    if (stop_asked) client.stop();
  }
  progress.clear();

  if (!client.seam()) {
    std::cerr << "scan: " << client.failure() << "\n";
    return 1;
  }
  if (!client.stranger().empty()) std::cerr << "scan: " << client.stranger() << "\n";
  const seam_t& seam = *client.seam();
  std::cout << seam_to_json_text(seam) << "\n";
  if (seam.verdict == seam_t::FOUND || seam.verdict == seam_t::BACKGROUND_STORED) return 0;
  std::cerr << "scan: no seam: " << printable(seam.reason) << "\n";
  return 1;
}

}  // namespace

void add_scan_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<ScanOptions>();
  Command command(parent, "scan",
                  "Run one scan in a live cell and print its SEAM as JSON (mm and rad)");
  command
      .option(
          "--kind", options->kind,
          "background: the empty cell, to be told from the work later; workpiece: find the seam")
      .required()
      .one_of({"background", "workpiece"});
  command.option(
      "--cell", options->cell,
      "The cell's file, cell.yaml, of which the section bus is used; without it the bus is at its "
      "defaults");
  command.option("--sensor", options->instance.sensor, "Sensor that scans").show_default();
  command.option("--robot", options->instance.robot, "Robot that carries it").show_default();
  command
      .option("--duration", options->request.longest_duration_s,
              "Longest duration of the scan, s; it may end earlier by Ctrl-C, or when the "
              "tool stands still "
              "where the cell is configured so")
      .show_default()
      .between(0.1, 3600.0);
  command
      .option("--timeout", options->request.timeout_s,
              "Longest wait, s, for the scan to begin, and for its seam after its end")
      .show_default()
      .between(0.1, 3600.0);
  const auto name = [](const std::string& text) {
    return is_name(text) ? "" : std::string("must be one line of at most 256 bytes");
  };
  command
      .option("--part", options->request.part,
              "Identifies the workpiece; comes back in the SEAM as `part`")
      .check(name);
  command
      .option(
          "--job", options->request.job,
          "Name of the job that the scan belongs to; comes back as `job`. Where cell.yaml has a "
          "section jobs, jobs/NAME.yaml says what holds for it")
      .check(name);
  command.option("--request", options->request.number,
                 "Number of whoever asks, not 0; comes back as `request`");
  command.footer(
      "Ctrl-C stops the scan and prints what it gave; a second one ends this program alone.\n"
      "Exit: 0 seam found or background stored; 1 ambiguous, refused, or no answer; 2 bad input.");
  command.run([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace arcstart::command_line
