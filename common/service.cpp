#include "common/service.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/bus/loss_watch.hpp"
#include "common/bus/multicast_route.hpp"
#include "common/host/host_clock.hpp"
#include "common/options.hpp"
#include "common/service_role.hpp"
#include "common/time.hpp"
#ifdef ARCSTART_SYSTEMD
#include <systemd/sd-daemon.h>
#endif

namespace arcstart {
namespace {

volatile std::sig_atomic_t end_asked = 0;
void ask_for_end(int) { end_asked = 1; }

// systemd's watchdog is fed from the main loop, so that a hung handler is noticed. Nothing where
// systemd is absent.
void notify_systemd([[maybe_unused]] const char* state) {
#ifdef ARCSTART_SYSTEMD
  sd_notify(0, state);
#endif
}

void open_state_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK) != 0)
    throw ConfigurationError(folder +
                             ": the state folder cannot be written: give another with --state");
}

// Resident memory in bytes, now and at most.
void read_memory(std::int64_t& now, std::int64_t& peak) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) now = std::atoll(line.c_str() + 6) * 1024;
    if (line.starts_with("VmHWM:")) peak = std::atoll(line.c_str() + 6) * 1024;
  }
}

// A network that is not there yet, as after boot, is waited for. False where the end was asked for
// meanwhile.
bool wait_for_route(const BusSettings& settings) {
  if (has_multicast_route(settings.group, settings.port)) return true;
  spdlog::warn(
      "there is no route for multicast to {} yet (ip route add 224.0.0.0/4 dev INTERFACE): it is "
      "waited for",
      settings.group);
  while (!end_asked && !has_multicast_route(settings.group, settings.port)) usleep(200'000);
  return !end_asked;
}

// What is wrong first, then what is to be known.
std::string status_words(const Bus& bus, const Health& health, const std::string& second,
                         const LossWatch& losses) {
  const bool two = !second.empty() && health.state != service_status_t::FAULT;
  std::string words = two ? second : health.last_error;
  const auto add = [&words](const std::string& more) {
    if (!words.empty() && !more.empty()) words += "; ";
    words += more;
  };
  add(losses.words(words));
  if (words.empty()) words = bus.last_error();
  if (words.empty()) words = bus.buffer_warning();
  add(health.notice);
  add("clock " + read_host_clock().words());
  return words;
}

service_status_t make_status(const ServiceContext& context, const ServiceDescription& description,
                             const Health& health, const std::string& second,
                             const LossWatch& losses) {
  const Bus& bus = context.bus;
  service_status_t status{};
  status.utime = utime_now();
  status.host = host_name();
  status.service = description.name;
  status.pid = getpid();
  status.run_id = context.run_id;
  status.state = health.state;
  status.last_error = status_words(bus, health, second, losses);
  status.received = bus.received() + health.received;
  status.sent = bus.sent();
  status.lost = health.lost + bus.overflowed();
  status.undecodable = bus.undecodable() + health.undecodable;
  if (status.state == service_status_t::RUNNING &&
      (losses.is_losing() || !second.empty() || !bus.buffer_warning().empty()))
    status.state = service_status_t::DEGRADED;
  status.oldest_age = health.oldest_age;
  read_memory(status.memory, status.peak_memory);
  status.configuration = context.effective_text;
  status.configuration_hash = fingerprint(context.effective_text);
  return status;
}

void run_loop(ServiceContext& context, const ServiceDescription& description, App& app) {
  const std::string channel = status_channel(context.instance, description);
  const TwinWatch twin(context.bus, channel, description.name, context.run_id);
  std::string told_second;
  std::int64_t next_status = 0;
  LossWatch losses;
  Health told;
  notify_systemd("READY=1");
  while (!end_asked) {
    context.bus.handle(std::chrono::milliseconds(20));
    app.tick(utime_now());
    while (const auto warning = context.bus.next_warning()) spdlog::warn("{}", *warning);
    notify_systemd("WATCHDOG=1");
    const Health health = app.health();
    losses.take(health.lost + context.bus.overflowed(), health.last_error, steady_now(),
                utime_now());
    std::string second = twin.trouble();
    if (second.empty()) second = context.bus.dispute();
    if (second != told_second && !second.empty()) spdlog::warn("{}", second);
    const bool changed = second != told_second || health.state != told.state ||
                         health.last_error != told.last_error || health.notice != told.notice;
    if (health.last_error != told.last_error && !health.last_error.empty())
      spdlog::warn(health.last_error);
    if (health.last_error.empty() && !told.last_error.empty()) spdlog::info("well again");
    if (!changed && steady_now() < next_status) continue;
    context.bus.publish(channel, make_status(context, description, health, second, losses));
    next_status = steady_now() + 1'000'000;
    told = health;
    told_second = second;
  }
  Health last = app.health();
  last.state = service_status_t::STOPPING;
  context.bus.publish(channel, make_status(context, description, last, "", losses));
  notify_systemd("STOPPING=1");
}

}  // namespace

std::string default_state_folder() {
  if (const char* given = std::getenv("STATE_DIRECTORY")) return given;  // systemd's
  if (const char* given = std::getenv("XDG_STATE_HOME")) return std::string(given) + "/arcstart";
  const char* home = std::getenv("HOME");
  return std::string(home ? home : "/tmp") + "/.local/state/arcstart";
}

std::string status_channel(const Instance& instance, const ServiceDescription& description) {
  std::string name = description.name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  return (description.of_robot ? instance.robot : instance.sensor) + "_" + name + "_STATUS";
}

int run_service(int argc, char** argv, const ServiceDescription& description,
                const std::function<std::unique_ptr<App>(ServiceContext&)>& make_app) {
  std::string cell;
  Instance instance;
  instance.state_folder = default_state_folder();
  Program options("arcstart " + description.name + ": " + description.purpose);
  options.option("--cell", cell,
                 "The cell's file, cell.yaml; without it every setting is at its default");
  options.option("--sensor", instance.sensor, "Sensor that this process serves").show_default();
  options.option("--robot", instance.robot, "Robot that carries it").show_default();
  options.option("--state", instance.state_folder, "Folder for what must outlive the process")
      .show_default();
  options.version(ARCSTART_VERSION);
  if (const auto code = options.parse(argc, argv)) return *code;

  spdlog::set_default_logger(spdlog::stderr_logger_mt(description.name));
  spdlog::set_pattern("%H:%M:%S.%e %n: %l: %v");
  struct sigaction action {};
  action.sa_handler = ask_for_end;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  try {
    const Configuration configuration =
        cell.empty() ? Configuration() : Configuration::from_file(cell);
    open_state_folder(instance.state_folder);
    const auto bus_settings = configuration.read<BusSettings>("bus");
    claim_role(description.name, description.of_robot ? instance.robot : instance.sensor,
               status_channel(instance, description), bus_settings);
    if (!wait_for_route(bus_settings)) return 0;
    Bus bus(bus_settings);
    if (!bus.buffer_warning().empty()) spdlog::warn(bus.buffer_warning());
    ServiceContext context{bus, configuration, instance, utime_now(), {}};
    const std::unique_ptr<App> app = make_app(context);
    run_loop(context, description, *app);
    return 0;
  } catch (const InputError& error) {
    spdlog::error(error.what());
    return 2;
  } catch (const std::exception& error) {
    spdlog::error(error.what());
    return 1;
  }
}

}  // namespace arcstart
