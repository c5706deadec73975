#include "services/command_line/commands/monitor_command.hpp"

#include <unistd.h>

#include <csignal>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/options.hpp"
#include "common/time.hpp"
#include "services/command_line/live/scan_client.hpp"
#include "services/command_line/live/traffic.hpp"
#include "services/command_line/output/seam_json.hpp"
#include "services/command_line/recordings/message_facts.hpp"

namespace arcstart::command_line {
namespace {

constexpr std::int64_t kSecond = 1'000'000;  // us
constexpr std::size_t kMostSeams = 10000;    // remembered, so that none is told twice

struct MonitorOptions {
  std::string cell;
  bool once = false, json = false, print_urls = false, seams = false;
  double seconds = 0;      // 0: until Ctrl-C
  double until_ready = 0;  // s, 0: not asked for
};

volatile std::sig_atomic_t end_asked = 0;

void print(const MonitorOptions& options, const Traffic& traffic, const Bus& bus) {
  if (options.json) {
    std::cout << traffic.json_line(steady_now(), utime_now()) << std::endl;
    return;
  }
  // On a terminal each table stands in the place of the one before.
  if (isatty(STDOUT_FILENO) && !options.once) std::cout << "\033[H\033[J";
  std::cout << traffic.table(steady_now(), utime_now());
  if (bus.overflowed() > 0)
    std::cout << "the monitor itself fell behind and missed " << bus.overflowed() << " messages\n";
  std::cout << std::endl;
}

std::function<bool()> until_asked(double seconds) {
  std::signal(SIGINT, [](int) { end_asked = 1; });
  std::signal(SIGTERM, [](int) { end_asked = 1; });
  const std::int64_t end = seconds > 0 ? steady_now() + seconds_to_us(seconds)
                                       : std::numeric_limits<std::int64_t>::max();
  return [end] { return end_asked || steady_now() >= end; };
}

// Each SEAM once, as it comes.
int watch_seams(Bus& bus, const std::function<bool()>& is_over) {
  std::set<std::pair<std::string, std::int64_t>> told;
  bool all_found = true;
  bus.subscribe_pattern(
      "(?s).*_SEAM", Queue::measurements(),
      [&](const Bus::Bytes& bytes, const std::string& channel) {
        seam_t seam;
        if (!decode(bytes, seam).empty() || !told.insert({channel, seam.scan_id}).second) return;
        // A sender may invent scans without end.
        if (told.size() > kMostSeams) told.erase(told.begin());
        std::cout << seam_to_json_line(seam) << std::endl;
        all_found &= seam.verdict == seam_t::FOUND || seam.verdict == seam_t::BACKGROUND_STORED;
      });
  while (!is_over()) bus.handle(std::chrono::milliseconds(50));
  if (told.empty()) std::cerr << "monitor: no seam came\n";
  return !told.empty() && all_found ? 0 : 1;
}

// Waits until every service that a scan needs states that it works, and names those that do not.
int wait_until_ready(Bus& bus, const std::function<bool()>& is_over) {
  const Instance instance;
  std::map<std::string, service_status_t> heard;  // by service
  for (const auto& service : chain_services())
    bus.subscribe<service_status_t>(
        status_channel(instance, service), Queue::newest(),
        [&heard, name = service.name](const service_status_t& status) { heard[name] = status; });
  std::string missing;
  do {
    bus.handle(std::chrono::milliseconds(50));
    missing.clear();
    for (const auto& service : chain_services()) {
      const auto found = heard.find(service.name);
      if (found == heard.end())
        missing += "; " + service.name + " is not heard";
      else if (found->second.state != service_status_t::RUNNING &&
               found->second.state != service_status_t::DEGRADED)
        missing += "; " + service.name + ": " + printable(found->second.last_error);
    }
    if (missing.empty()) return 0;
  } while (!is_over());
  std::cerr << "monitor: not ready" << missing << "\n";
  return 1;
}

int run(const MonitorOptions& options) {
  const Configuration configuration =
      options.cell.empty() ? Configuration() : Configuration::from_file(options.cell);
  const auto settings = configuration.read<BusSettings>("bus");
  if (options.print_urls) {
    for (const auto& url : settings.urls()) std::cout << url << "\n";
    return 0;
  }
  Bus bus(settings);
  if (!bus.buffer_warning().empty()) std::cerr << "monitor: " << bus.buffer_warning() << "\n";
  const auto is_over = until_asked(options.seconds > 0 ? options.seconds : options.once ? 2 : 0);
  if (options.until_ready > 0) return wait_until_ready(bus, until_asked(options.until_ready));
  if (options.seams) return watch_seams(bus, is_over);
  Traffic traffic;
  // (?s): a channel's name may hold a line feed, and must show all the same.
  bus.subscribe_pattern("(?s).*", Queue::measurements(),
                        [&](const Bus::Bytes& bytes, const std::string& channel) {
                          // LCM sends that to itself whenever a process starts.
                          if (channel != "LCM_SELF_TEST")
                            traffic.take(channel, bytes, steady_now());
                        });
  traffic.tick(steady_now());
  for (std::int64_t next = steady_now() + kSecond; !is_over();) {
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
  auto options = std::make_shared<MonitorOptions>();
  Command command(parent, "monitor", "Show what is on the bus, a line a channel");
  command.option(
      "--cell", options->cell,
      "The cell's file, cell.yaml, of which the section bus is used; without it the bus is at its "
      "defaults");
  command.flag("--once", options->once, "Listen for 2 s (or --seconds), print one table and end");
  command.option("--seconds", options->seconds, "End after so many seconds").between(0.1, 1e7);
  command.flag("--json", options->json,
               "Print each table as one line of JSON, an object a channel");
  command
      .flag("--seams", options->seams,
            "Instead of the table print each SEAM once, one JSON object a line; exit 0 where "
            "all are found or "
            "backgrounds stored")
      .excludes({"--once", "--json"});
  command
      .option("--until-ready", options->until_ready,
              "Instead of the table wait, at most so many seconds, until every service that a "
              "scan needs works; exit 1 names those that do not")
      .between(0.1, 1e7)
      .excludes({"--once", "--json", "--seams"});
  command
      .flag("--print-urls", options->print_urls,
            "Only print the bus's LCM URLs, one a port, images last, and end")
      .for_scripts();
  command.footer(
      "A table a second until Ctrl-C: on a terminal over the one before, else one after the "
      "other.\n"
      "rate and kB/s are means of the last 5 s; size is the newest message's; age is the time "
      "since the newest\n"
      "image, position, stripe or profile was measured, for other channels since it came; gaps "
      "counts messages\n"
      "missing by their seq; undecodable those that are no message of the channel's type.\n"
      "Exit: 0 something was heard; 1 nothing was; 2 bad input.");
  command.run([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace arcstart::command_line
