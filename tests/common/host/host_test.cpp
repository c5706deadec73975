// What is said of a host, from the kernel's own texts as they stand in its manual pages; and what
// this host says of itself, held against other calls.
#include <sys/timex.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/host/host_clock.hpp"
#include "common/host/host_resources.hpp"

using namespace arcstart;

TEST_CASE("a clock is synchronised where the kernel says so and its error is bounded") {
  timex told{};
  told.maxerror = 1234;
  CHECK(host_clock(TIME_OK, told).words() == "synchronised within 1.2 ms");
  CHECK(host_clock(-1, told).words() == "not synchronised");
  told.status = STA_UNSYNC | STA_PLL;
  CHECK_FALSE(host_clock(TIME_ERROR, told).is_synchronised);
  told.status = STA_PLL;
  told.maxerror = 16'000'000;
  CHECK_FALSE(host_clock(TIME_OK, told).is_synchronised);

  timex now{};
  ntp_adjtime(&now);
  CHECK(read_host_clock().is_synchronised == ((now.status & STA_UNSYNC) == 0));
}

TEST_CASE("disk: of a folder that is not there, the file system on which it would lie") {
  const DiskSpace here = disk_space("/tmp"), deeper = disk_space("/tmp/not/there/yet");
  const auto other = std::filesystem::space("/tmp");
  CHECK(here.size == static_cast<std::int64_t>(other.capacity));
  CHECK(deeper.size == here.size);
  CHECK(here.free > 0);
  CHECK(here.free <= here.size);
}

TEST_CASE("a socket gets no more of a receive buffer than the kernel allows") {
  CHECK(granted_receive_buffer(100'000) == 100'000);
  int allowed = 0;
  if (!(std::ifstream("/proc/sys/net/core/rmem_max") >> allowed)) return;  // not shown here
  CHECK(granted_receive_buffer(allowed) == allowed);
  CHECK(granted_receive_buffer(allowed + 100'000) == allowed);
}

TEST_CASE("datagrams that were dropped are counted by their column's name") {
  std::istringstream told(
      "Ip: Forwarding DefaultTTL\nIp: 1 64\n"
      "Udp: InDatagrams NoPorts InErrors OutDatagrams RcvbufErrors SndbufErrors\n"
      "Udp: 100 2 34 90 33 1\n");
  CHECK(datagrams_dropped(told) == 33);
  std::istringstream nothing("Udp: InDatagrams\nUdp: 100\n");
  CHECK(datagrams_dropped(nothing) == -1);
  CHECK(datagrams_dropped() >= 0);
}

TEST_CASE("multicast leaves by the interface of the longest mask that fits") {
  const std::string head =
      "Iface Destination Gateway Flags RefCnt Use Metric Mask MTU Window IRTT\n";
  const std::string wan = "eth0 00000000 0101A8C0 0003 0 0 0 00000000 0 0 0\n";   // default
  const std::string cell = "eth1 000000E0 00000000 0001 0 0 0 000000F0 0 0 0\n";  // 224.0.0.0/4
  const auto by = [&](const std::string& routes) {
    std::istringstream text(head + routes);
    return multicast_interface(text, "239.255.76.67");
  };
  CHECK(by("").empty());
  CHECK(by(wan) == "eth0");
  CHECK(by(wan + cell) == "eth1");
  CHECK(by(cell + wan) == "eth1");
  CHECK(by("eth2 0000A8C0 00000000 0001 0 0 0 0000FFFF 0 0 0\n").empty());  // 192.168.0.0/16
  CHECK(by("eth1 000000E0 00000000 0000 0 0 0 000000F0 0 0 0\n").empty());  // not up
}
