// The bus: typed messages over LCM, udpm between processes or memq within one.
//
// A receive thread (udpm only) copies what comes into bounded queues; handlers run in handle()
// alone, in the caller's thread and in order of arrival. So no exception and no handler ever
// crosses LCM's C code.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/bus/former_types.hpp"
#include "common/bus/message_checks.hpp"
#include "common/bus/sender_watch.hpp"
#include "common/configuration.hpp"
#include "common/input_error.hpp"

namespace arcstart {

class BusError : public InputError {
 public:
  using InputError::InputError;
};

// Section `bus` of cell.yaml.
struct BusSettings {
  std::string group = "239.255.76.67";  // multicast group
  int port = 7667;
  int image_port =
      0;        // own port for <SENSOR>_IMAGE, so that it need not reach every host; 0: the same
  int ttl = 0;  // 0: this host only; 1: this network
  int receive_buffer_bytes = 4194304;  // asked of the kernel: two full images

  // LCM's own names for it, one a port, images last.
  std::vector<std::string> urls() const;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("group", group);
    visitor("port", port, between(1, 65535));
    visitor("image_port", image_port, between(0, 65535));
    visitor("ttl", ttl, between(0, 255));
    visitor("receive_buffer_bytes", receive_buffer_bytes, between(65536, 1 << 30));
  }
};

// How what has come waits for its handler.
struct Queue {
  std::size_t messages;
  std::size_t bytes;
  bool newest_only;

  static Queue images() { return {30, 128u << 20, false}; }
  static Queue measurements() { return {5000, 64u << 20, false}; }
  static Queue newest() { return {1, 64u << 20, true}; }  // state, preview, monitor
};

class Bus {
 public:
  explicit Bus(const BusSettings& settings);  // udpm; throws BusError with what to do
  static std::unique_ptr<Bus> in_memory();    // memq; publish and handle in one thread
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  // The handler gets every message of the channel that decodes to its last byte and has a meaning
  // (message_checks.hpp); what does not is counted and named in last_error(). A measurement that
  // comes a second time, byte for byte, is left out. Subscribe before the first handle().
  template <class Message>
  void subscribe(const std::string& channel, Queue queue,
                 std::function<void(const Message&)> handler) {
    constexpr bool is_measurement = requires(Message m) { m.run_id, m.seq; };
    SenderWatch* const senders = is_measurement ? &watch_senders(channel) : nullptr;
    subscribe_bytes(
        channel, queue,
        [=, this, handler = std::move(handler)](const Bytes& bytes, const std::string&) {
          Message message{};  // fresh: lcm-gen leaves old elements in a vector whose count is 0
          const int size = static_cast<int>(bytes.size());
          std::string error;
          if (message.decode(bytes.data(), 0, size) != size)
            error = undecodable_reason(bytes, Message::getTypeName());
          else
            error = meaning_error(message);
          if (!error.empty()) return note_undecodable(channel, bytes, error);
          if constexpr (is_measurement) {
            const std::size_t looked_at = std::is_same_v<Message, image_t>
                                              ? std::min(bytes.size(), kImageHead)
                                              : bytes.size();
            if (senders->is_repeated(message.run_id, message.seq,
                                     std::span(bytes).first(looked_at)))
              return;
          }
          ++received_;
          handler(message);
        });
  }

  using Bytes = std::vector<std::uint8_t>;
  // Undecoded; pattern is a regular expression. For the monitor.
  void subscribe_pattern(const std::string& pattern, Queue queue,
                         std::function<void(const Bytes&, const std::string& channel)> handler);

  template <class Message>
  void publish(const std::string& channel, const Message& message) {
    Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    publish_bytes(channel, bytes);
  }
  // What the kernel does not take (no route any more) is told by last_error(): a network that goes
  // for a moment ends no service.
  void publish_bytes(const std::string& channel, const Bytes& bytes);

  // Waits for a message, a wake() or the end of the time, then handles all that waits. True where a
  // message was handled. What a handler throws comes out here.
  bool handle(std::chrono::milliseconds longest_wait);

  // Ends a handle() that waits; for device threads that have something for the main loop.
  void wake();

  std::int64_t received() const { return received_; }  // handled well
  std::int64_t sent() const { return sent_; }
  std::int64_t undecodable() const { return undecodable_; }
  std::int64_t overflowed() const { return overflowed_; }  // fell over a full queue
  std::string last_error() const;                          // of what was not taken in or not sent
  // Why the measurements of a subscribed channel cannot be trusted now: two senders. Empty where
  // there is one. Without a channel: of the first channel of which that is so, with its name.
  std::string dispute(const std::string& channel) const;
  std::string dispute() const;
  // For the log, each once: a channel on which messages of the version before come.
  std::optional<std::string> next_warning();
  std::string buffer_warning() const {
    return buffer_warning_;
  }  // empty where the kernel gave the buffer asked for

 private:
  struct Subscription;
  struct Transport;
  Bus();
  void subscribe_bytes(const std::string& channel, Queue queue,
                       std::function<void(const Bytes&, const std::string& channel)> handler);
  void add_transport(const std::string& url);
  Transport& transport_of(const std::string& channel);
  void take_in(Subscription& subscription, const lcm::ReceiveBuffer& buffer,
               const std::string& channel);
  SenderWatch& watch_senders(const std::string& channel);
  void note_undecodable(const std::string& channel, const Bytes& bytes, const std::string& why);
  bool dispatch_one();

  struct Waiting {
    Subscription* subscription;
    std::string channel;
    Bytes bytes;
  };
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  std::vector<std::unique_ptr<Transport>> transports_;
  std::string buffer_warning_;

  std::deque<std::pair<std::string, SenderWatch>> senders_;  // one a subscription

  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Waiting> waiting_;
  bool woken_ = false;
  std::string last_error_;
  std::set<std::string> former_channels_;  // that were warned of
  std::deque<std::string> warnings_;

  std::atomic<std::int64_t> received_{0}, sent_{0}, undecodable_{0}, overflowed_{0};
};

}  // namespace arcstart
