#include "common/bus/event_log.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

namespace arcstart {
namespace {

// Event header, all big-endian: sync word u32, event number i64, timestamp i64 us, channel length
// i32, data length i32.
constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
constexpr std::size_t kHeaderSize = 28;
constexpr std::size_t kLongestChannel = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH

std::uint64_t big_endian(const std::uint8_t* bytes, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return value;
}

void append_big_endian(std::uint64_t value, int count, std::uint8_t*& at) {
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8)
    *at++ = static_cast<std::uint8_t>(value >> shift);
}

// Reads all of bytes, over short reads and interrupts.
bool read_fully(int file, std::uint64_t offset, std::span<std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = pread(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    offset += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

std::string system_reason() { return std::strerror(errno); }

}  // namespace

EventWalk walk_event_log(std::uint64_t size, const ReadAt& read_at) {
  EventWalk walk;
  std::array<std::uint8_t, kHeaderSize + kLongestChannel> head;
  std::uint64_t at = 0;
  const auto ends_with = [&](const std::string& why) {
    walk.damage = fmt::format("event {} at byte {}: {}", walk.entries.size(), at, why);
    return walk;
  };
  while (at < size) {
    const std::uint64_t left = size - at;
    // Header and channel name in one reading: the name is longer than that only in a damaged file.
    const auto head_bytes = std::min<std::uint64_t>(left, head.size());
    if (!read_at(at, std::span(head).first(head_bytes))) return ends_with("cannot be read");
    if (head_bytes >= 4 && big_endian(head.data(), 4) != kSyncWord)
      return ends_with("does not begin with LCM's mark");
    if (left < kHeaderSize) return ends_with("cut off in its header");

    const auto timestamp = static_cast<std::int64_t>(big_endian(&head[12], 8));
    const auto channel_length = static_cast<std::int32_t>(big_endian(&head[20], 4));
    const auto data_length = static_cast<std::int32_t>(big_endian(&head[24], 4));
    if (channel_length < 1 || channel_length > static_cast<std::int32_t>(kLongestChannel))
      return ends_with(fmt::format("channel name of {} bytes, 1 to {} are possible", channel_length,
                                   kLongestChannel));
    if (data_length < 0) return ends_with(fmt::format("data of {} bytes", data_length));
    const auto name_length = static_cast<std::uint32_t>(channel_length);
    const auto data_size = static_cast<std::uint32_t>(data_length);
    if (left < kHeaderSize + name_length) return ends_with("cut off in its channel name");
    if (left - kHeaderSize - name_length < data_size)
      return ends_with(fmt::format("cut off: {} bytes of data announced, {} there", data_size,
                                   left - kHeaderSize - name_length));
    const auto* name = &head[kHeaderSize];
    if (std::find(name, name + name_length, 0) != name + name_length)
      return ends_with("channel name with a NUL in it");

    walk.entries.push_back({timestamp, std::string(name, name + name_length),
                            at + kHeaderSize + name_length, data_size});
    at += kHeaderSize + name_length + data_size;
  }
  return walk;
}

EventWalk walk_event_log(std::span<const std::uint8_t> bytes) {
  return walk_event_log(bytes.size(), [bytes](std::uint64_t offset, std::span<std::uint8_t> out) {
    if (offset > bytes.size() || out.size() > bytes.size() - offset) return false;
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
    return true;
  });
}

EventLog::EventLog(const std::string& path) : path_(path) {
  // Not blocking: a named pipe is no recording, and must not hang whoever asks.
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw EventLogError(fmt::format("{}: cannot be opened: {}", path, system_reason()));
  file_ = std::shared_ptr<const int>(new int(file), [](const int* descriptor) {
    ::close(*descriptor);
    delete descriptor;
  });
  struct stat about {};
  if (fstat(file, &about) != 0)
    throw EventLogError(fmt::format("{}: cannot be read: {}", path, system_reason()));
  if (S_ISDIR(about.st_mode))
    throw EventLogError(fmt::format("{}: is a folder, not an LCM recording", path));
  if (!S_ISREG(about.st_mode))
    throw EventLogError(fmt::format("{}: is no file, so no LCM recording", path));
  if (about.st_size == 0) throw EventLogError(fmt::format("{}: is empty, no LCM recording", path));

  EventWalk walk = walk_event_log(static_cast<std::uint64_t>(about.st_size),
                                  [file](std::uint64_t offset, std::span<std::uint8_t> bytes) {
                                    return read_fully(file, offset, bytes);
                                  });
  if (walk.entries.empty())
    throw EventLogError(fmt::format("{}: is not an LCM recording ({})", path, walk.damage));
  entries_ = std::move(walk.entries);
  damage_ = std::move(walk.damage);
}

std::vector<std::uint8_t> EventLog::read(const EventEntry& entry, std::size_t at_most) const {
  std::vector<std::uint8_t> bytes(std::min<std::size_t>(entry.size, at_most));
  if (!read_fully(*file_, entry.offset, bytes))
    throw EventLogError(fmt::format("{}: {} bytes at byte {} cannot be read any more", path_,
                                    entry.size, entry.offset));
  return bytes;
}

EventLogWriter::EventLogWriter(const std::string& path)
    : path_(path), file_(std::fopen(path.c_str(), "wbe")) {
  if (!file_) throw EventLogError(fmt::format("{}: cannot be written: {}", path, system_reason()));
}

EventLogWriter::~EventLogWriter() {
  if (file_) std::fclose(file_);
}

void EventLogWriter::write(std::int64_t timestamp, const std::string& channel,
                           const std::vector<std::uint8_t>& bytes) {
  if (!file_) throw EventLogError(fmt::format("{}: is closed already", path_));
  if (channel.empty() || channel.size() > kLongestChannel ||
      channel.find('\0') != std::string::npos)
    throw EventLogError(fmt::format("{}: '{}' is no channel name, 1 to {} characters are", path_,
                                    channel, kLongestChannel));
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw EventLogError(fmt::format("{}: a message of {} bytes is too long", path_, bytes.size()));

  std::array<std::uint8_t, kHeaderSize> header;
  std::uint8_t* at = header.data();
  append_big_endian(kSyncWord, 4, at);
  append_big_endian(static_cast<std::uint64_t>(number_), 8, at);
  append_big_endian(static_cast<std::uint64_t>(timestamp), 8, at);
  append_big_endian(channel.size(), 4, at);
  append_big_endian(bytes.size(), 4, at);
  if (std::fwrite(header.data(), 1, header.size(), file_) != header.size() ||
      std::fwrite(channel.data(), 1, channel.size(), file_) != channel.size() ||
      (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()))
    throw EventLogError(fmt::format("{}: cannot be written: {}", path_, system_reason()));
  ++number_;
}

void EventLogWriter::close() {
  if (!file_) return;
  std::FILE* const file = std::exchange(file_, nullptr);
  const bool flushed = std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  const std::string why = flushed ? "" : system_reason();
  const bool closed = std::fclose(file) == 0;
  if (!flushed || !closed)
    throw EventLogError(
        fmt::format("{}: cannot be written: {}", path_, flushed ? system_reason() : why));
}

}  // namespace arcstart
