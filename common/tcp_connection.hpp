// A TCP connection to a controller, with the kernel's arrival time, that another thread can end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace arcstart {

class TcpConnection {
 public:
  TcpConnection();
  ~TcpConnection();
  TcpConnection(const TcpConnection&) = delete;
  TcpConnection& operator=(const TcpConnection&) = delete;

  // Why there is no connection, one line with what to look at; empty: there is one. service: what
  // must hold at the controller for it to listen, as "RTDE allowed there".
  std::string open(const std::string& address, int port, std::int64_t longest_us,
                   const std::string& service);
  void close();

  enum class Received { kBytes, kNothing, kClosed, kEnded };
  // Waits for bytes; kNothing: none came in time; kEnded: end() was called.
  Received receive(std::vector<std::uint8_t>& bytes, std::int64_t& arrival_utime,
                   std::int64_t longest_us);
  bool send(const std::vector<std::uint8_t>& bytes);  // false: the connection has gone

  // True: end() was called meanwhile.
  bool sleep(std::int64_t us);
  void end();  // from any thread, for good

 private:
  int wait(int socket, short events, std::int64_t longest_us);

  int socket_ = -1;
  int end_;  // eventfd
};

}  // namespace arcstart
