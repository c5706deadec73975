// lcm-logger files, read with every length checked before it is believed: liblcm itself crashes on
// a damaged one.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/input_error.hpp"

namespace arcstart {

class EventLogError : public InputError {
 public:
  using InputError::InputError;
};

// Where an event lies in its file.
struct EventEntry {
  std::int64_t timestamp;  // us, when the logger received it
  std::string channel;     // 1 to 63 bytes, none of them NUL
  std::uint64_t offset;    // of its data in the file
  std::uint32_t size;      // of its data
};

// What a walk over the headers finds: the events up to the first damage, and what that is, at which
// byte.
struct EventWalk {
  std::vector<EventEntry> entries;
  std::string damage;  // empty for a sound log
};

// The walk itself, free of files. read_at(offset, bytes) fills bytes from there, false where it
// cannot.
using ReadAt = std::function<bool(std::uint64_t offset, std::span<std::uint8_t> bytes)>;
EventWalk walk_event_log(std::uint64_t size, const ReadAt& read_at);
EventWalk walk_event_log(std::span<const std::uint8_t> bytes);

// A recording: its headers in memory, its data on the disk until asked for.
class EventLog {
 public:
  // Walks all headers. Throws EventLogError where the file cannot be read or holds no event at all;
  // damage further on ends the log there and is told by damage().
  explicit EventLog(const std::string& path);

  const std::vector<EventEntry>& entries() const { return entries_; }
  // An event's data, or its first bytes alone. Throws EventLogError where the file has shrunk or
  // cannot be read any more.
  std::vector<std::uint8_t> read(const EventEntry& entry) const { return read(entry, entry.size); }
  std::vector<std::uint8_t> read(const EventEntry& entry, std::size_t at_most) const;
  const std::string& path() const { return path_; }
  const std::string& damage() const { return damage_; }  // one line, empty for a sound file

 private:
  std::string path_, damage_;
  std::vector<EventEntry> entries_;
  std::shared_ptr<const int> file_;  // descriptor, closed with the last copy
};

// Writes events as lcm-logger does. Throws EventLogError where the disk takes no more.
class EventLogWriter {
 public:
  explicit EventLogWriter(const std::string& path);
  ~EventLogWriter();
  EventLogWriter(const EventLogWriter&) = delete;
  EventLogWriter& operator=(const EventLogWriter&) = delete;
  void write(std::int64_t timestamp, const std::string& channel,
             const std::vector<std::uint8_t>& bytes);
  void close();  // flushes to the disk; throws EventLogError

 private:
  std::string path_;
  std::FILE* file_;
  std::int64_t number_ = 0;
};

}  // namespace arcstart
