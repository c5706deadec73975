#include "common/host/host_resources.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace arcstart {

DiskSpace disk_space(const std::string& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(there, error) && there.has_relative_path())
    there = there.parent_path();
  struct statvfs space {};
  if (statvfs(there.c_str(), &space) != 0) return {};
  const auto block = static_cast<std::int64_t>(space.f_frsize);
  return {static_cast<std::int64_t>(space.f_bavail) * block,
          static_cast<std::int64_t>(space.f_blocks) * block};
}

int granted_receive_buffer(int asked) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return asked;
  int granted = 0;
  socklen_t size = sizeof granted;
  setsockopt(probe, SOL_SOCKET, SO_RCVBUF, &asked, sizeof asked);
  getsockopt(probe, SOL_SOCKET, SO_RCVBUF, &granted, &size);
  close(probe);
  return granted / 2;  // Linux doubles what it grants for its own bookkeeping
}

// Two lines "Udp:", names and then numbers.
std::int64_t datagrams_dropped(std::istream& snmp) {
  std::vector<std::string> names;
  for (std::string line; std::getline(snmp, line);) {
    if (!line.starts_with("Udp:")) continue;
    std::istringstream words(line);
    std::vector<std::string> columns;
    for (std::string word; words >> word;) columns.push_back(word);
    if (names.empty()) {
      names = columns;
      continue;
    }
    for (std::size_t i = 0; i < names.size() && i < columns.size(); ++i)
      if (names[i] == "RcvbufErrors") return std::atoll(columns[i].c_str());
  }
  return -1;
}

std::int64_t datagrams_dropped() {
  std::ifstream file("/proc/net/snmp");
  return datagrams_dropped(file);
}

// Columns: interface, destination, gateway, flags, three numbers, mask, ...; addresses as the
// kernel keeps them, in hexadecimal. The longest mask that fits wins.
std::string multicast_interface(std::istream& routes, const std::string& group) {
  in_addr wanted{};
  if (inet_pton(AF_INET, group.c_str(), &wanted) != 1) return "";
  std::string best;
  std::uint32_t longest = 0;
  for (std::string line; std::getline(routes, line);) {
    std::istringstream words(line);
    std::string name, gateway, skipped;
    std::uint32_t destination = 0, flags = 0, mask = 0;
    if (!(words >> name >> std::hex >> destination >> gateway >> flags >> skipped >> skipped >>
          skipped >> mask))
      continue;
    constexpr std::uint32_t kUp = 1;  // RTF_UP
    if ((flags & kUp) == 0 || (wanted.s_addr & mask) != destination) continue;
    if (!best.empty() && ntohl(mask) <= longest) continue;
    best = name;
    longest = ntohl(mask);
  }
  return best;
}

std::string multicast_interface(const std::string& group) {
  std::ifstream file("/proc/net/route");
  return multicast_interface(file, group);
}

}  // namespace arcstart
