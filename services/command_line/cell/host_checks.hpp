// Whether this host is fit for a cell. What is looked at is given, so that each can be tried.
#pragma once

#include "common/bus/bus.hpp"
#include "common/host/host_clock.hpp"
#include "common/host/host_resources.hpp"
#include "services/command_line/cell/check_line.hpp"

namespace arcstart::command_line {

struct HostFacts {
  HostClock clock;
  std::string interface;      // that multicast leaves by; empty where there is no route
  int receive_buffer = 0;     // bytes, that a socket gets
  std::int64_t dropped = -1;  // datagrams; -1: not known
  DiskSpace disk;
  std::string state_folder;
  bool is_writable = false;  // the state folder, or where it would be made
};

// Of this host, now.
HostFacts host_facts(const BusSettings& bus, const std::string& state_folder);

// bus: ttl 0 says that the cell is this host alone.
std::vector<CheckLine> host_checks(const HostFacts& facts, const BusSettings& bus);

}  // namespace arcstart::command_line
