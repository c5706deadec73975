#include "common/tcp_connection.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

#include "common/time.hpp"

namespace arcstart {
namespace {

constexpr std::size_t kAtOnce = 4096;  // bytes
constexpr int kTimeout = 0, kReady = 1, kEndAsked = 2;

// Of the newest bytes read.
std::int64_t arrival_of_bytes(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec time;
    std::memcpy(&time, CMSG_DATA(part), sizeof time);
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000 + time.tv_nsec / 1000;
  }
  return utime_now();
}

std::string why_not(int error, const std::string& service) {
  if (error == ECONNREFUSED)
    return "it refuses the connection: is the robot on, " + service + ", and the port right?";
  if (error == ETIMEDOUT) return "it does not answer: is the robot on, and the address right?";
  return fmt::format("{}: is this host in the robot's network?", std::strerror(error));
}

}  // namespace

TcpConnection::TcpConnection() : end_(eventfd(0, EFD_CLOEXEC)) {}

TcpConnection::~TcpConnection() {
  close();
  ::close(end_);
}

void TcpConnection::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void TcpConnection::end() { eventfd_write(end_, 1); }

int TcpConnection::wait(int socket, short events, std::int64_t longest_us) {
  pollfd waiting[] = {{end_, POLLIN, 0}, {socket, events, 0}};
  const timespec longest{longest_us / 1'000'000, longest_us % 1'000'000 * 1000};
  const int ready = ppoll(waiting, socket >= 0 ? 2 : 1, &longest, nullptr);
  if (waiting[0].revents) return kEndAsked;
  return ready > 0 ? kReady : kTimeout;
}

bool TcpConnection::sleep(std::int64_t us) { return wait(-1, 0, us) == kEndAsked; }

std::string TcpConnection::open(const std::string& address, int port, std::int64_t longest_us,
                                const std::string& service) {
  close();
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, address.c_str(), &there.sin_addr) != 1) return "not an IPv4 address";
  socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_ < 0) return why_not(errno, service);
  const int on = 1;
  setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  int error = 0;
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof there) != 0) {
    error = errno;
    if (error == EINPROGRESS) {
      error = ETIMEDOUT;
      if (wait(socket_, POLLOUT, longest_us) == kReady) {
        socklen_t size = sizeof error;
        getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
      }
    }
  }
  if (error == 0) return {};
  close();
  return why_not(error, service);
}

TcpConnection::Received TcpConnection::receive(std::vector<std::uint8_t>& bytes,
                                               std::int64_t& arrival_utime,
                                               std::int64_t longest_us) {
  const int ready = wait(socket_, POLLIN, longest_us);
  if (ready == kEndAsked) return Received::kEnded;
  if (ready == kTimeout) return Received::kNothing;
  bytes.resize(kAtOnce);
  iovec place{bytes.data(), bytes.size()};
  alignas(cmsghdr) char control[256];
  msghdr message{};
  message.msg_iov = &place;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t size = recvmsg(socket_, &message, MSG_DONTWAIT);
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return Received::kNothing;
  if (size <= 0) return Received::kClosed;
  arrival_utime = arrival_of_bytes(message);
  return Received::kBytes;
}

bool TcpConnection::send(const std::vector<std::uint8_t>& bytes) {
  // Requests are short; what the kernel does not take at once goes to a controller that is gone.
  return bytes.empty() || ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
                              static_cast<ssize_t>(bytes.size());
}

}  // namespace arcstart
