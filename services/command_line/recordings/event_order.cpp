#include "services/command_line/recordings/event_order.hpp"

#include <algorithm>
#include <tuple>

namespace arcstart::command_line {
namespace {

constexpr std::int64_t kLargestJump =
    10'000'000;  // us, as everywhere: a single stamp beyond it is an error

// Without overflow: stamps of a damaged recording may be anything.
bool is_far_ahead(std::int64_t time, std::int64_t of_next) {
  std::int64_t ahead = 0;
  return time > of_next && (__builtin_sub_overflow(time, of_next, &ahead) || ahead > kLargestJump);
}

}  // namespace

std::vector<std::int64_t> monotone_times(const std::vector<RecordedMessage>& messages) {
  std::vector<std::int64_t> times;
  times.reserve(messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    std::int64_t time = messages[i].utime;
    if (i + 1 < messages.size() && is_far_ahead(time, messages[i + 1].utime))
      time = times.empty() ? messages[i + 1].utime : times.back();
    times.push_back(times.empty() ? time : std::max(time, times.back()));
  }
  return times;
}

std::vector<RecordedMessage> merge_by_event_time(const std::vector<RecordedStream>& streams) {
  struct Placed {
    std::int64_t time;
    int rank;
    const RecordedMessage* message;
    auto key() const { return std::tuple(time, rank, message->log, message->entry); }
  };
  std::vector<Placed> placed;
  for (const auto& stream : streams) {
    const auto times = monotone_times(stream.messages);
    for (std::size_t i = 0; i < times.size(); ++i)
      placed.push_back({times[i], stream.rank, &stream.messages[i]});
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.key() < b.key(); });

  std::vector<RecordedMessage> merged;
  merged.reserve(placed.size());
  for (const auto& place : placed) merged.push_back(*place.message);
  return merged;
}

}  // namespace arcstart::command_line
