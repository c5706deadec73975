#include "services/command_line/cell/host_checks.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>

namespace arcstart::command_line {
namespace {

// bytes: half a minute of a recording with images, of 2 MB 14 times a second.
constexpr std::int64_t kDiskMin = 1'000'000'000;

CheckLine clock_line(const HostClock& clock, bool alone) {
  if (alone && !clock.is_synchronised)
    return {"clock", clock.words() + "; the cell is this host alone (bus: ttl 0), which needs none",
            ""};
  return {"clock", clock.words(),
          clock.is_synchronised ? ""
                                : "apt install chrony; in /etc/chrony/chrony.conf 'server "
                                  "CELL-MASTER iburst minpoll 2 maxpoll 4'; systemctl restart "
                                  "chrony (docs/connect-a-robot.md)"};
}

CheckLine route_line(const std::string& interface, const BusSettings& bus) {
  const bool alone = bus.ttl == 0;
  if (interface.empty())
    return {"route", "no route for multicast to " + bus.group,
            fmt::format("ip route add 224.0.0.0/4 dev {}", alone ? "lo" : "INTERFACE")};
  if (!alone && interface == "lo")
    return {"route", bus.group + " leaves by lo: no other host hears this one (bus: ttl is not 0)",
            "ip route replace 224.0.0.0/4 dev INTERFACE"};
  return {"route", fmt::format("{} leaves by {}, ttl {}", bus.group, interface, bus.ttl), ""};
}

CheckLine buffer_line(const HostFacts& facts, const BusSettings& bus) {
  const std::string dropped =
      facts.dropped > 0 ? fmt::format("; {} datagrams were dropped since the start", facts.dropped)
                        : "";
  if (facts.receive_buffer >= bus.receive_buffer_bytes)
    return {"buffers", fmt::format("{} bytes, as asked for{}", bus.receive_buffer_bytes, dropped),
            ""};
  return {"buffers",
          fmt::format("{} of the {} bytes asked for: images will be lost{}", facts.receive_buffer,
                      bus.receive_buffer_bytes, dropped),
          fmt::format("sysctl -w net.core.rmem_max={} (as root, on the host and not in a "
                      "container), or scripts/setup",
                      bus.receive_buffer_bytes)};
}

CheckLine disk_line(const HostFacts& facts) {
  if (!facts.is_writable)
    return {"disk", facts.state_folder + ": the state folder cannot be written",
            fmt::format("mkdir -p {0} && chown $USER {0}, or another with --state",
                        facts.state_folder)};
  const std::string words =
      fmt::format("{:.1f} of {:.1f} GB free for {}", static_cast<double>(facts.disk.free) * 1e-9,
                  static_cast<double>(facts.disk.size) * 1e-9, facts.state_folder);
  if (facts.disk.free >= kDiskMin) return {"disk", words, ""};
  return {"disk", words,
          fmt::format("du -xh --max-depth=2 {} | sort -h | tail: remove old recordings",
                      facts.state_folder)};
}

}  // namespace

HostFacts host_facts(const BusSettings& bus, const std::string& state_folder) {
  HostFacts facts;
  facts.clock = read_host_clock();
  facts.interface = multicast_interface(bus.group);
  facts.receive_buffer = granted_receive_buffer(bus.receive_buffer_bytes);
  facts.dropped = datagrams_dropped();
  facts.disk = disk_space(state_folder);
  facts.state_folder = state_folder;
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(state_folder, error);
  while (!std::filesystem::exists(there, error) && there.has_relative_path())
    there = there.parent_path();
  facts.is_writable =
      std::filesystem::is_directory(there, error) && access(there.c_str(), W_OK) == 0;
  return facts;
}

std::vector<CheckLine> host_checks(const HostFacts& facts, const BusSettings& bus) {
  return {clock_line(facts.clock, bus.ttl == 0), route_line(facts.interface, bus),
          buffer_line(facts, bus), disk_line(facts)};
}

}  // namespace arcstart::command_line
