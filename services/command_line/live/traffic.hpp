// What goes over the bus, a line a channel. Memory is bounded whatever is sent.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/bus/sender_watch.hpp"
#include "services/command_line/recordings/message_facts.hpp"

namespace arcstart::command_line {

class Traffic {
 public:
  static constexpr std::size_t kMostChannels = 500;  // what comes on further ones is only counted

  // One message, of any channel and content. steady: us on the steady clock.
  void take(const std::string& channel, const std::vector<std::uint8_t>& bytes,
            std::int64_t steady);

  // At the start and then once a second: rates are taken over the last five.
  void tick(std::int64_t steady);

  bool is_empty() const { return channels_.empty(); }

  // A line a channel, by name: rate, size, age, gaps, undecodable, state. Age: since the newest was
  // measured, of state messages since it came. utime: us, UTC.
  std::string table(std::int64_t steady, std::int64_t utime) const;
  // The same, an object a channel; keys carry their unit.
  nlohmann::json json(std::int64_t steady, std::int64_t utime) const;
  std::string json_line(std::int64_t steady, std::int64_t utime) const;

 private:
  struct Count {
    std::int64_t messages = 0, bytes = 0;
  };
  struct Channel {
    ChannelKind kind = ChannelKind::kUnknown;
    Count total;
    std::deque<Count> at_ticks;  // totals then; shorter than ticks_ where the channel is younger
    std::int64_t arrival = 0;    // of the newest; us, steady
    std::size_t size = 0;        // of the newest; bytes
    std::int64_t utime = 0;      // of the newest measurement, 0 for others
    std::int64_t run_id = 0, seq = -1;
    std::int64_t gaps = 0;  // messages missing by seq
    std::int64_t undecodable = 0;
    SenderWatch senders;  // of a measurement
    std::string state;    // what the newest state says, printable; of a measurement, two senders
  };
  struct Rates {
    double messages_per_s = 0, bytes_per_s = 0;
  };
  static void note_source(Channel& channel, const std::vector<std::uint8_t>& bytes);
  Rates rates(const Channel& channel, std::int64_t steady) const;
  static double age_s(const Channel& channel, std::int64_t steady, std::int64_t utime);

  std::map<std::string, Channel> channels_;
  std::deque<std::int64_t> ticks_;  // us, steady
  std::int64_t elsewhere_ = 0;      // messages on channels beyond kMostChannels
};

}  // namespace arcstart::command_line
