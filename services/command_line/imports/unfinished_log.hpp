// A recording that appears under its name once it is whole, and else not at all.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/bus/event_log.hpp"

namespace arcstart::command_line {

class UnfinishedLog {
 public:
  // Written beside path, as path.part. Throws EventLogError where that cannot be.
  explicit UnfinishedLog(const std::string& path);
  ~UnfinishedLog();  // takes away what was not finished
  UnfinishedLog(const UnfinishedLog&) = delete;
  UnfinishedLog& operator=(const UnfinishedLog&) = delete;

  template <class Message>
  void write(std::int64_t utime, const std::string& channel, const Message& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    log_.write(utime, channel, bytes);
  }
  // Gives it its name. Throws EventLogError or ImportError where the disk takes no more.
  void finish();

 private:
  std::string path_, part_;
  EventLogWriter log_;
  bool finished_ = false;
};

}  // namespace arcstart::command_line
