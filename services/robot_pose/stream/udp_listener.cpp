#include "services/robot_pose/stream/udp_listener.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>

namespace arcstart::robot_pose {
namespace {

constexpr std::size_t kLongestDatagram = 2048;
constexpr std::size_t kMostWaiting = 5000;

std::int64_t to_us(const timespec& time) {
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000 + time.tv_nsec / 1000;
}

std::int64_t arrival_of(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec time;
    std::memcpy(&time, CMSG_DATA(part), sizeof time);
    return to_us(time);
  }
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return to_us(now);
}

}  // namespace

UdpListener::UdpListener(std::string address, int port, std::function<void()> notify)
    : address_(std::move(address)), port_(port), notify_(std::move(notify)) {}

UdpListener::~UdpListener() {
  if (thread_.joinable()) {
    eventfd_write(end_, 1);
    thread_.join();
  }
  if (end_ >= 0) close(end_);
  if (socket_ >= 0) close(socket_);
}

void UdpListener::start() {
  const auto fail = [&](const std::string& what_to_do) {
    throw std::runtime_error(fmt::format("cannot listen on UDP {}:{}: {}: {}", address_, port_,
                                         std::strerror(errno), what_to_do));
  };
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(static_cast<std::uint16_t>(port_));
  errno = EINVAL;
  if (inet_pton(AF_INET, address_.c_str(), &here.sin_addr) != 1) fail("give an IPv4 address");
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  end_ = eventfd(0, EFD_CLOEXEC);
  if (socket_ < 0 || end_ < 0) fail("too many open files?");
  const int on = 1;
  setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0)
    fail(errno == EADDRINUSE ? "another program has this port: end it, or set another port"
                             : "is the address one of this host's?");
  socklen_t size = sizeof here;
  getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
  port_ = ntohs(here.sin_port);
  thread_ = std::thread([this] { receive(); });
}

std::optional<Datagram> UdpListener::poll() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return std::nullopt;
  Datagram datagram = std::move(waiting_.front());
  waiting_.pop_front();
  return datagram;
}

void UdpListener::send(const std::vector<std::uint8_t>& bytes, const std::string& address,
                       int port) {
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, address.c_str(), &there.sin_addr) != 1)
    throw std::runtime_error(address + ": not an IPv4 address");
  sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&there),
         sizeof there);
}

void UdpListener::receive() {
  std::vector<std::uint8_t> buffer(kLongestDatagram);
  pollfd events[] = {{socket_, POLLIN, 0}, {end_, POLLIN, 0}};
  while (true) {
    if (::poll(events, 2, -1) < 0 && errno != EINTR) return;
    if (events[1].revents) return;
    if (!(events[0].revents & POLLIN)) continue;
    sockaddr_in sender{};
    iovec place{buffer.data(), buffer.size()};
    alignas(cmsghdr) char control[256];
    msghdr message{};
    message.msg_name = &sender;
    message.msg_namelen = sizeof sender;
    message.msg_iov = &place;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    const ssize_t size = recvmsg(socket_, &message, MSG_DONTWAIT);
    if (size < 0) continue;
    Datagram datagram{{buffer.begin(), buffer.begin() + size}, arrival_of(message), {}};
    char text[INET_ADDRSTRLEN] = {};
    if (inet_ntop(AF_INET, &sender.sin_addr, text, sizeof text)) datagram.sender = text;
    {
      const std::lock_guard lock(mutex_);
      if (waiting_.size() < kMostWaiting)
        waiting_.push_back(std::move(datagram));
      else
        ++overflowed_;
    }
    notify_();
  }
}

}  // namespace arcstart::robot_pose
