// Judge of sound files: liblcm's own lcm::LogFile, reading and writing.
#include "common/bus/event_log.hpp"

#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <random>

using namespace arcstart;
using Catch::Matchers::Contains;

namespace {

struct Event {
  std::int64_t timestamp;
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("arcstart-event-log-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::vector<Event> some_events(int count) {
  std::mt19937 random(7);
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    Event event{1'700'000'000'000'000 + 1000 * i, i % 3 ? "ROBOT0_POSE" : std::string(63, 'x'), {}};
    event.bytes.resize(i == 1 ? 0 : random() % 500);
    for (auto& byte : event.bytes) byte = static_cast<std::uint8_t>(random());
    events.push_back(event);
  }
  events[0].timestamp = -5;  // a clock that was never set
  return events;
}

void write_with_liblcm(const std::string& path, const std::vector<Event>& events) {
  lcm::LogFile log(path, "w");
  REQUIRE(log.good());
  for (const auto& event : events) {
    lcm::LogEvent out{};
    out.timestamp = event.timestamp;
    out.channel = event.channel;
    out.datalen = static_cast<std::int32_t>(event.bytes.size());
    auto bytes = event.bytes;
    out.data = bytes.data();
    REQUIRE(log.writeEvent(&out) == 0);
  }
}

std::vector<std::uint8_t> content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void store(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream out(path, std::ios::binary);
  for (const auto byte : bytes) out.put(static_cast<char>(byte));
}

void check_same(const EventLog& log, const std::vector<Event>& events, std::size_t count) {
  REQUIRE(log.entries().size() == count);
  for (std::size_t i = 0; i < count; ++i) {
    CHECK(log.entries()[i].timestamp == events[i].timestamp);
    CHECK(log.entries()[i].channel == events[i].channel);
    CHECK(log.read(log.entries()[i]) == events[i].bytes);
  }
}

// Where the last event begins in a file of these events.
std::size_t last_event_at(const std::vector<Event>& events) {
  std::size_t at = 0;
  for (std::size_t i = 0; i + 1 < events.size(); ++i)
    at += 28 + events[i].channel.size() + events[i].bytes.size();
  return at;
}

void put_length(std::vector<std::uint8_t>& bytes, std::size_t at, std::int32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
}

}  // namespace

TEST_CASE("an event log that liblcm wrote is read whole") {
  const Folder folder;
  const auto events = some_events(40);
  write_with_liblcm(folder / "a.lcm", events);
  const EventLog log(folder / "a.lcm");
  CHECK(log.damage().empty());
  CHECK(log.path() == folder / "a.lcm");
  check_same(log, events, events.size());
  for (const auto& entry : log.entries()) {
    auto first = log.read(entry);
    first.resize(std::min<std::size_t>(first.size(), 5));
    CHECK(log.read(entry, 5) == first);
  }
}

TEST_CASE("liblcm reads what the event log writer wrote, and the files are the same byte by byte") {
  const Folder folder;
  const auto events = some_events(40);
  EventLogWriter writer(folder / "ours.lcm");
  for (const auto& event : events) writer.write(event.timestamp, event.channel, event.bytes);
  writer.close();

  lcm::LogFile log(folder / "ours.lcm", "r");
  REQUIRE(log.good());
  for (std::size_t i = 0; i < events.size(); ++i) {
    const lcm::LogEvent* event = log.readNextEvent();
    REQUIRE(event);
    CHECK(event->eventnum == static_cast<std::int64_t>(i));
    CHECK(event->timestamp == events[i].timestamp);
    CHECK(event->channel == events[i].channel);
    REQUIRE(event->datalen == static_cast<std::int32_t>(events[i].bytes.size()));
    const auto* data = static_cast<const std::uint8_t*>(event->data);
    CHECK(std::equal(data, data + event->datalen, events[i].bytes.begin()));
  }
  CHECK(log.readNextEvent() == nullptr);

  write_with_liblcm(folder / "theirs.lcm", events);
  CHECK(content(folder / "ours.lcm") == content(folder / "theirs.lcm"));
}

TEST_CASE("a file that is no recording is refused in one clear line") {
  const Folder folder;
  const auto refused = [](const std::string& path) {
    try {
      EventLog{path};
    } catch (const EventLogError& error) {
      const std::string what = error.what();
      CHECK_THAT(what, Contains(path));
      CHECK(what.find('\n') == std::string::npos);
      return what;
    }
    return std::string("was read");
  };
  CHECK_THAT(refused(folder / "missing.lcm"), Contains("No such file"));
  store(folder / "empty.lcm", {});
  CHECK_THAT(refused(folder / "empty.lcm"), Contains("is empty"));
  store(folder / "text.lcm", std::vector<std::uint8_t>(200, 'a'));
  CHECK_THAT(refused(folder / "text.lcm"), Contains("is not an LCM recording"));
  store(folder / "short.lcm", {'a'});
  CHECK_THAT(refused(folder / "short.lcm"), Contains("is not an LCM recording"));
  std::filesystem::create_directory(folder / "folder.lcm");
  CHECK_THAT(refused(folder / "folder.lcm"), Contains("is a folder"));
  REQUIRE(std::system(("mkfifo '" + (folder / "pipe.lcm") + "'").c_str()) == 0);
  CHECK_THAT(refused(folder / "pipe.lcm"), Contains("is no file"));
}

TEST_CASE("a recording cut at any byte of its last event keeps all events before it") {
  const Folder folder;
  auto events = some_events(10);
  events.back().bytes.resize(50);
  write_with_liblcm(folder / "whole.lcm", events);
  const auto whole = content(folder / "whole.lcm");
  const std::size_t last = last_event_at(events);
  for (std::size_t size = last + 1; size < whole.size(); ++size) {
    const EventWalk walk = walk_event_log(std::span(whole).first(size));
    CHECK(walk.entries.size() == events.size() - 1);
    CHECK_THAT(walk.damage, Contains("cut off"));
    CHECK_THAT(walk.damage, Contains("byte " + std::to_string(last)));
  }
  CHECK(walk_event_log(std::span(whole).first(last)).damage.empty());

  store(folder / "cut.lcm", {whole.begin(), whole.end() - 1});
  const EventLog cut(folder / "cut.lcm");
  CHECK_THAT(cut.damage(), Contains("cut off"));
  check_same(cut, events, events.size() - 1);
}

TEST_CASE("a damaged header ends the recording there and is told") {
  auto events = some_events(10);
  std::vector<std::uint8_t> whole;
  {
    const Folder folder;
    write_with_liblcm(folder / "whole.lcm", events);
    whole = content(folder / "whole.lcm");
  }
  const std::size_t last = last_event_at(events);
  const auto damage_after = [&](auto&& spoil) {
    auto bytes = whole;
    spoil(bytes);
    const EventWalk walk = walk_event_log(bytes);
    CHECK(walk.entries.size() == events.size() - 1);
    CHECK_THAT(walk.damage, Contains("byte " + std::to_string(last)));
    return walk.damage;
  };
  for (const std::int32_t length : {0x7fffffff, 0x7ffffff0, 0x10000000})
    CHECK_THAT(damage_after([&](auto& bytes) { put_length(bytes, last + 24, length); }),
               Contains("bytes of data announced"));
  for (const std::int32_t length : {-1, std::numeric_limits<std::int32_t>::min()})
    CHECK_THAT(damage_after([&](auto& bytes) { put_length(bytes, last + 24, length); }),
               Contains("data of -"));
  for (const std::int32_t length :
       {-1, 0, 64, 1000, 0x7fffffff, std::numeric_limits<std::int32_t>::min()})
    CHECK_THAT(damage_after([&](auto& bytes) { put_length(bytes, last + 20, length); }),
               Contains("channel name of"));
  CHECK_THAT(damage_after([&](auto& bytes) { bytes[last] ^= 1; }), Contains("LCM's mark"));
  CHECK_THAT(damage_after([&](auto& bytes) { bytes[last + 30] = 0; }), Contains("NUL"));
}

TEST_CASE("a jump of the event number is no damage") {
  auto events = some_events(3);
  const Folder folder;
  write_with_liblcm(folder / "a.lcm", events);
  auto bytes = content(folder / "a.lcm");
  bytes[last_event_at(events) + 5] = 77;
  const EventWalk walk = walk_event_log(bytes);
  CHECK(walk.damage.empty());
  CHECK(walk.entries.size() == 3);
}

TEST_CASE("a recording that shrinks under its reader is told, not crashed on") {
  const Folder folder;
  const auto events = some_events(10);
  write_with_liblcm(folder / "a.lcm", events);
  const EventLog log(folder / "a.lcm");
  std::filesystem::resize_file(folder / "a.lcm", 100);
  CHECK_THROWS_AS(log.read(log.entries().back()), EventLogError);
}

TEST_CASE("the event log writer says where it cannot write") {
  CHECK_THROWS_AS(EventLogWriter("/nowhere/at/all.lcm"), EventLogError);
  const auto fill_the_disk = [] {
    EventLogWriter writer("/dev/full");
    for (int i = 0; i < 100; ++i) writer.write(1, "A", std::vector<std::uint8_t>(1000));
    writer.close();
  };
  CHECK_THROWS_AS(fill_the_disk(), EventLogError);
  const Folder folder;
  EventLogWriter writer(folder / "a.lcm");
  CHECK_THROWS_AS(writer.write(1, "", {}), EventLogError);
  CHECK_THROWS_AS(writer.write(1, std::string(64, 'x'), {}), EventLogError);
  CHECK_THROWS_AS(writer.write(1, std::string("a\0b", 3), {}), EventLogError);
  writer.close();
  CHECK_THROWS_AS(writer.write(1, "A", {}), EventLogError);
}
