// The shell around every service: options, configuration, bus, signals, STATUS, systemd's watchdog.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/bus/bus.hpp"
#include "common/configuration.hpp"

namespace arcstart {

// Which chain a process belongs to, and where it keeps what must outlive it.
struct Instance {
  std::string sensor = "LASER0";
  std::string robot = "ROBOT0";
  std::string state_folder;  // exists and can be written

  std::string sensor_channel(const std::string& name) const { return sensor + "_" + name; }
  std::string robot_channel(const std::string& name) const { return robot + "_" + name; }
};

// How the service fares, as its app sees it. The shell adds what the bus knows.
struct Health {
  std::int8_t state = service_status_t::RUNNING;
  std::string last_error;        // what, where and what to do; empty for nothing
  std::string notice;            // stands behind it in STATUS: whether the laser is lit
  std::int64_t lost = 0;         // inputs that should have come and did not
  std::int64_t oldest_age = 0;   // of an input that still waits; us
  std::int64_t received = 0;     // inputs from a device, beside the bus's messages
  std::int64_t undecodable = 0;  // of those, dropped as malformed, strange or out of order
};

// What a service subscribes to, publishes and counts. No mathematics.
class App {
 public:
  virtual ~App() = default;
  // Called after every round of messages and at least 20 times a second: devices, and the
  // repetition of state.
  virtual void tick(std::int64_t now_utime) { (void)now_utime; }
  virtual Health health() const = 0;
};

struct ServiceContext {
  Bus& bus;  // outlives the app
  const Configuration& configuration;
  Instance instance;
  std::int64_t run_id;  // start of the process; us, UTC

  // Reads the service's section and notes its effective text for STATUS.
  template <class Settings>
  Settings settings(const std::string& section) {
    Settings settings = configuration.read<Settings>(section);
    effective_text += write_settings(section, settings);
    return settings;
  }
  std::string effective_text;
};

struct ServiceDescription {
  std::string name;       // as its folder is called: "extraction"
  std::string purpose;    // one line for --help
  bool of_robot = false;  // its STATUS belongs to the robot's instance, not the sensor's
};

// The whole main of a service: parses --cell, --sensor, --robot, --state, builds the bus and the
// app, runs until SIGINT or SIGTERM. Returns the exit code: 0 ended as asked, 1 failed, 2 bad
// options, configuration or bus.
int run_service(int argc, char** argv, const ServiceDescription& description,
                const std::function<std::unique_ptr<App>(ServiceContext&)>& make_app);

// What --state is without being given: systemd's, or one of the user's own.
std::string default_state_folder();

// LASER0_EXTRACTION_STATUS, ROBOT0_ROBOT_POSE_STATUS.
std::string status_channel(const Instance& instance, const ServiceDescription& description);

}  // namespace arcstart
