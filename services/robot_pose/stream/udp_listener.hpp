// Datagrams with the kernel's arrival time, received by a thread of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace arcstart::robot_pose {

struct Datagram {
  std::vector<std::uint8_t> bytes;
  std::int64_t arrival_utime;  // us, UTC: when the kernel took it in (SO_TIMESTAMPNS)
  std::string sender;          // IPv4 address
};

class UdpListener {
 public:
  // notify: called from the receiving thread after each datagram; it must outlive this object.
  UdpListener(std::string address, int port, std::function<void()> notify);
  ~UdpListener();
  UdpListener(const UdpListener&) = delete;
  UdpListener& operator=(const UdpListener&) = delete;

  // Throws std::runtime_error with what to do where the port cannot be had.
  void start();

  std::optional<Datagram> poll();

  // From the port listened to. What cannot be sent is lost, as on the way. Throws
  // std::runtime_error where the address is none.
  void send(const std::vector<std::uint8_t>& bytes, const std::string& address, int port);

  int port() const { return port_; }  // the one given by the kernel where 0 was asked
  std::int64_t overflowed() const { return overflowed_; }  // dropped because nobody polled

 private:
  void receive();

  std::string address_;
  int port_;
  std::function<void()> notify_;
  int socket_ = -1;
  int end_ = -1;  // eventfd
  std::thread thread_;
  std::mutex mutex_;
  std::deque<Datagram> waiting_;
  std::atomic<std::int64_t> overflowed_{0};
};

}  // namespace arcstart::robot_pose
