// Whether the measurements of one channel come from one sender. The network may double a message;
// two processes that both take themselves for the sender, or a stranger, show in run_id and seq.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>

namespace arcstart {

// bytes; from an image's beginning, enough for what tells two apart: its fields, which take some
// 200, with the checksum of the rest.
inline constexpr std::size_t kImageHead = 512;

class SenderWatch {
 public:
  // calm: of how many messages of one sender alone it takes to forget a second one. By default 1 to
  // 5 s of positions, 18 s of images at 14 Hz.
  explicit SenderWatch(int calm = 250) : calm_needed_(calm) {}

  // Of each message in order of arrival: the start of its process, its count, its bytes. True for
  // one that came before, byte for byte: it is to be left out, and is no loss.
  bool is_repeated(std::int64_t run_id, std::int64_t seq, std::span<const std::uint8_t> bytes);

  // Why what comes now cannot be trusted; empty where one process speaks alone. Two do where one
  // goes on after another has begun (a restarted one never comes back), or where two messages of
  // one run and seq differ. It holds until one alone has spoken for a while, counted in messages so
  // that it does not hang on the clock.
  const std::string& dispute() const { return dispute_; }

 private:
  struct Seen {
    std::int64_t run_id, seq;
    std::uint32_t digest;
  };
  // Enough for a sender that is 100 times slower than the other.
  static constexpr std::size_t kRemembered = 256;

  std::deque<Seen> seen_;  // newest last
  std::string dispute_;
  int calm_needed_;
  int calm_ = 0;  // messages since the last sign of a second sender
};

}  // namespace arcstart
