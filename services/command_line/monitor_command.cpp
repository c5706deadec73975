#include "services/command_line/monitor_command.hpp"

#include <unistd.h>

#include <csignal>
#include <iostream>
#include <limits>
#include <memory>

#include "common/bus.hpp"
#include "common/time.hpp"
#include "services/command_line/traffic.hpp"

namespace arcstart {
namespace {

constexpr std::int64_t kSecond = 1'000'000;  // us

struct Options {
  std::string cell;
  bool once = false, json = false;
  double seconds = 0;  // 0: until Ctrl-C
};

volatile std::sig_atomic_t end_asked = 0;

void print(const Options& options, const Traffic& traffic, const Bus& bus) {
  if (options.json) {
    std::cout << traffic.json(steady_now(), utime_now()).dump() << std::endl;
    return;
  }
  // On a terminal each table stands in the place of the one before.
  if (isatty(STDOUT_FILENO) && !options.once) std::cout << "\033[H\033[J";
  std::cout << traffic.table(steady_now(), utime_now());
  if (bus.overflowed() > 0)
    std::cout << "the monitor itself fell behind and missed " << bus.overflowed() << " messages\n";
  std::cout << std::endl;
}

int run(const Options& options) {
  const Configuration configuration =
      options.cell.empty() ? Configuration() : Configuration::from_file(options.cell);
  Bus bus(configuration.read<BusSettings>("bus"));
  if (!bus.buffer_warning().empty()) std::cerr << "monitor: " << bus.buffer_warning() << "\n";
  Traffic traffic;
  // (?s): a channel's name may hold a line feed, and must show all the same.
  bus.subscribe_pattern("(?s).*", Queue::measurements(),
                        [&](const Bus::Bytes& bytes, const std::string& channel) {
                          traffic.take(channel, bytes, steady_now());
                        });
  std::signal(SIGINT, [](int) { end_asked = 1; });
  std::signal(SIGTERM, [](int) { end_asked = 1; });

  const std::int64_t begin = steady_now();
  const double seconds = options.seconds > 0 ? options.seconds : options.once ? 2 : 0;
  const std::int64_t end =
      seconds > 0 ? begin + seconds_to_us(seconds) : std::numeric_limits<std::int64_t>::max();
  traffic.tick(begin);
  for (std::int64_t next = begin + kSecond; !end_asked && steady_now() < end;) {
    bus.handle(std::chrono::milliseconds(50));
    if (steady_now() < next) continue;
    next += kSecond;
    if (!options.once) print(options, traffic, bus);
    traffic.tick(steady_now());
  }
  if (options.once) print(options, traffic, bus);
  if (!traffic.is_empty()) return 0;
  std::cerr << "monitor: nothing is heard: do services run, on this group and port, and with a ttl "
               "that lets them "
               "reach this host?\n";
  return 1;
}

}  // namespace

void add_monitor_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = parent.add_subcommand("monitor", "Show what is on the bus, a line a channel");
  command->add_option(
      "--cell", options->cell,
      "The cell's file, cell.yaml, of which the section bus is used; without it the bus is at its "
      "defaults");
  command->add_flag("--once", options->once,
                    "Listen for 2 s (or --seconds), print one table and end");
  command->add_option("--seconds", options->seconds, "End after so many seconds")
      ->check(CLI::Range(0.1, 1e7));
  command->add_flag("--json", options->json,
                    "Print each table as one line of JSON, an object a channel");
  command->footer(
      "A table a second until Ctrl-C: on a terminal over the one before, else one after the "
      "other.\n"
      "rate and kB/s are means of the last 5 s; size is the newest message's; age is the time "
      "since the newest\n"
      "image, position, stripe or profile was measured, for other channels since it came; gaps "
      "counts messages\n"
      "missing by their seq; undecodable those that are no message of the channel's type.\n"
      "Exit: 0 something was heard; 1 nothing was; 2 bad input.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace arcstart
