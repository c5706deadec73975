// What a host has for a cell: disk, buffers for the network, a way for multicast.
#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace arcstart {

struct DiskSpace {
  std::int64_t free = -1,
               size = -1;  // bytes, of what a process without rights may use; -1: not known
};
// Of the file system that the folder lies on, or will lie on where it is not there yet.
DiskSpace disk_space(const std::string& folder);

// Of a socket, bytes: how much of the receive buffer that is asked for the kernel grants
// (net.core.rmem_max); what was asked for where that cannot be found out.
int granted_receive_buffer(int asked);

// UDP datagrams that this host (this network namespace) dropped since its start because nobody took
// them from a socket in time; -1: not known.
std::int64_t datagrams_dropped(std::istream& snmp);  // of /proc/net/snmp
std::int64_t datagrams_dropped();

// By which interface what goes to a group leaves; empty where there is no route.
std::string multicast_interface(std::istream& routes, const std::string& group);  // /proc/net/route
std::string multicast_interface(const std::string& group);

}  // namespace arcstart
