// reconstruction's app on a bus of its own, with all that it publishes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/bus/calibration_message.hpp"
#include "services/reconstruction/reconstruction_app.hpp"
#include "tests/reconstruction/synthetic_cell.hpp"

namespace arcstart::test {

using namespace reconstruction;

constexpr std::int64_t kSecond = 1'000'000;  // us
using Bytes = std::vector<std::uint8_t>;

// One message on its way to the app.
struct Event {
  std::int64_t arrival;  // us after kBegin
  std::string channel;
  Bytes bytes;
};

template <class Message>
Event event(std::int64_t arrival, const std::string& channel, const Message& message) {
  Event result{arrival, channel, Bytes(static_cast<std::size_t>(message.getEncodedSize()))};
  message.encode(result.bytes.data(), 0, static_cast<int>(result.bytes.size()));
  return result;
}

struct Chain {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  ReconstructionApp app;
  std::vector<Bytes> bytes;
  std::vector<profile_t> profiles;

  explicit Chain(const ReconstructionSettings& settings = {}) : app(*bus, settings, Instance{}) {
    bus->subscribe_pattern(
        "LASER0_PROFILE", Queue::measurements(),
        [this](const Bytes& message, const std::string&) { bytes.push_back(message); });
    bus->subscribe<profile_t>("LASER0_PROFILE", Queue::measurements(),
                              [this](const profile_t& profile) { profiles.push_back(profile); });
  }
  template <class Message>
  void send(const std::string& channel, const Message& message) {
    send(event(0, channel, message));
  }
  void send(const Event& sent) {
    bus->publish_bytes(sent.channel, sent.bytes);
    bus->handle(std::chrono::milliseconds(0));
  }
  void stripe(const stripe_t& message) { send("LASER0_STRIPE", message); }
  void positions(std::int64_t from, std::int64_t to) {
    for (std::int64_t time = from; time <= to; time += 20'000) send("ROBOT0_POSE", pose_at(time));
  }
};

inline calibration_t calibration() { return to_message(true_calibration()); }

}  // namespace arcstart::test
