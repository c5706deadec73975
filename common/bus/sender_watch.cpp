#include "common/bus/sender_watch.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/bus/crc32c.hpp"

namespace arcstart {

bool SenderWatch::is_repeated(std::int64_t run_id, std::int64_t seq,
                              std::span<const std::uint8_t> bytes) {
  const std::uint32_t digest = crc32c(bytes);
  const auto same = std::find_if(seen_.rbegin(), seen_.rend(), [&](const Seen& one) {
    return one.run_id == run_id && one.seq == seq;
  });
  if (same != seen_.rend() && same->digest == digest) return true;
  const bool goes_on = !seen_.empty() && seen_.back().run_id != run_id &&
                       std::any_of(seen_.begin(), seen_.end(),
                                   [&](const Seen& one) { return one.run_id == run_id; });
  ++calm_;
  if (same != seen_.rend()) {
    dispute_ = fmt::format("two senders: messages of run {} with seq {} differ", run_id, seq);
    calm_ = 0;
  } else if (goes_on) {
    dispute_ =
        fmt::format("two senders: runs {} and {} speak by turns",
                    std::min(run_id, seen_.back().run_id), std::max(run_id, seen_.back().run_id));
    calm_ = 0;
  } else if (calm_ >= calm_needed_) {
    dispute_.clear();
  }
  seen_.push_back({run_id, seq, digest});
  if (seen_.size() > kRemembered) seen_.pop_front();
  return false;
}

}  // namespace arcstart
