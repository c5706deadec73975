// The order in which recorded messages are replayed: by when each was measured, not by when the
// logger got it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace arcstart::command_line {

// One message of a recording. Messages of one channel of one file keep the order in which they
// stand.
struct RecordedMessage {
  std::int64_t utime;    // inside the message; us
  std::size_t log;       // which file
  std::size_t entry;     // which event in it
  std::int64_t scan_id;  // 0 where it belongs to none
};

// A channel of one file. Of streams with the same time, that of the lower rank goes first, then
// that of the earlier file, so that the order depends on nothing but what was recorded.
struct RecordedStream {
  int rank;
  std::vector<RecordedMessage> messages;
};

// utimes made monotone: a stamp that goes back takes the time of its forerunner, and so does a
// single one more than 10 s ahead of what follows it (else it would hold back all that comes
// after).
std::vector<std::int64_t> monotone_times(const std::vector<RecordedMessage>& messages);

// All messages by event time. However a recording's channels were delayed against each other, the
// order is the same.
std::vector<RecordedMessage> merge_by_event_time(const std::vector<RecordedStream>& streams);

}  // namespace arcstart::command_line
