#include "services/seam_finding/scan/scan_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "common/bus/event_log.hpp"

namespace arcstart::seam_finding {
namespace {

namespace fs = std::filesystem;

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class Message>
std::optional<Message> decoded(const std::vector<std::uint8_t>& bytes) {
  Message message{};
  const int size = static_cast<int>(bytes.size());
  if (message.decode(bytes.data(), 0, size) != size || !meaning_error(message).empty()) return {};
  return message;
}

// What the name of a file says: the how-many-th it is, and the scan. Scans count times of a clock
// that may have been set back since, so that they give no order.
struct StoredName {
  std::int64_t order = 0, scan_id = 0;
  auto operator<=>(const StoredName&) const = default;
};

std::string file_name(const std::string& prefix, const StoredName& name) {
  return fmt::format("{}-{:08d}-{:020d}.lcm", prefix, name.order, name.scan_id);
}

// Nothing where it is no such name. Former ones hold the scan alone: they are older than all
// others.
std::optional<StoredName> stored_name(const std::string& file, const std::string& prefix) {
  if (!file.starts_with(prefix + "-") || !file.ends_with(".lcm")) return {};
  std::int64_t numbers[2] = {0, 0};
  int count = 0;
  const char* at = file.data() + prefix.size() + 1;
  const char* const stop = file.data() + file.size() - 4;  // ".lcm"
  while (count < 2) {
    const auto [end, error] = std::from_chars(at, stop, numbers[count]);
    if (error != std::errc()) return {};
    ++count;
    if (end == stop)
      return count == 2 ? StoredName{numbers[0], numbers[1]} : StoredName{0, numbers[0]};
    if (*end != '-') return {};
    at = end + 1;
  }
  return {};
}

}  // namespace

ScanStore::ScanStore(const Instance& instance, int backgrounds_kept, int results_kept)
    : sensor_(instance.sensor), backgrounds_kept_(backgrounds_kept), results_kept_(results_kept) {
  if (instance.state_folder.empty()) return;
  folder_ = instance.state_folder + "/" + instance.sensor + "-" + instance.robot;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw ScanStoreError(folder_ + ": " + error.message() + ": give another folder with --state");
}

void ScanStore::write(const std::string& name, const std::vector<Event>& events) const {
  const std::string path = folder_ + "/" + name, beside = path + ".part";
  try {
    EventLogWriter log(beside);
    for (const Event& event : events) log.write(event.timestamp, event.channel, event.bytes);
    log.close();
    fs::rename(beside, path);
  } catch (const std::exception& failure) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw ScanStoreError(
        fmt::format("{}: free some space, or give another folder with --state", failure.what()));
  }
}

void ScanStore::keep_background(const CollectedScan& scan) {
  if (folder_.empty()) return;
  std::vector<Event> events;
  for (const profile_t& profile : scan.profiles)
    events.push_back({profile.utime, sensor_ + "_PROFILE", encoded(profile)});
  events.push_back({scan.state.end_utime, sensor_ + "_SCAN", encoded(scan.state)});
  write(next_name("background", scan.state.scan_id), events);
  prune("background", backgrounds_kept_);
}

void ScanStore::keep_seam(std::int64_t scan_id, const std::vector<std::uint8_t>& bytes) {
  if (folder_.empty()) return;
  write(next_name("seam", scan_id), {{scan_id, sensor_ + "_SEAM", bytes}});
  prune("seam", results_kept_);
}

std::vector<std::string> ScanStore::files(const std::string& prefix) const {
  std::vector<std::string> paths;
  if (folder_.empty()) return paths;
  std::vector<std::pair<StoredName, std::string>> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error))
    if (const auto name = stored_name(entry.path().filename(), prefix))
      found.emplace_back(*name, entry.path());
  std::sort(found.begin(), found.end());
  for (auto& [name, path] : found) paths.push_back(std::move(path));
  return paths;
}

std::string ScanStore::next_name(const std::string& prefix, std::int64_t scan_id) const {
  const std::vector<std::string> all = files(prefix);
  const std::int64_t last =
      all.empty() ? 0 : stored_name(fs::path(all.back()).filename(), prefix)->order;
  return file_name(prefix, {last + 1, scan_id});
}

void ScanStore::prune(const std::string& prefix, int kept) const {
  const std::vector<std::string> all = files(prefix);
  std::error_code error;
  for (std::size_t i = 0; i + static_cast<std::size_t>(kept) < all.size(); ++i)
    fs::remove(all[i], error);
}

std::vector<CollectedScan> ScanStore::backgrounds(std::vector<std::string>& warnings) const {
  std::vector<CollectedScan> scans;
  for (const std::string& path : files("background")) {
    try {
      const EventLog log(path);
      CollectedScan scan;
      bool whole = false;  // its state is written last
      for (const EventEntry& entry : log.entries()) {
        if (entry.channel == sensor_ + "_PROFILE") {
          if (auto profile = decoded<profile_t>(log.read(entry)))
            scan.profiles.push_back(std::move(*profile));
        } else if (const auto state = decoded<scan_t>(log.read(entry))) {
          scan.state = *state;
          whole = true;
        }
      }
      scan.profiles_lost = std::max(0, scan.state.images - static_cast<int>(scan.profiles.size()));
      if (!whole || !log.damage().empty())
        throw EventLogError(path + ": damaged, or of another version");
      scans.push_back(std::move(scan));
    } catch (const EventLogError& error) {
      warnings.push_back(fmt::format("{}: this background is left out", error.what()));
    }
  }
  return scans;
}

std::optional<StoredSeam> ScanStore::newest_seam(std::vector<std::string>& warnings) const {
  const std::vector<std::string> all = files("seam");
  for (auto path = all.rbegin(); path != all.rend(); ++path) {
    try {
      const EventLog log(*path);
      const std::vector<std::uint8_t> bytes = log.read(log.entries().front());
      if (const auto seam = decoded<seam_t>(bytes)) return StoredSeam{seam->scan_id, bytes};
      warnings.push_back(*path + ": of another version: this answer is left out");
    } catch (const EventLogError& error) {
      warnings.push_back(fmt::format("{}: this answer is left out", error.what()));
    }
  }
  return {};
}

std::vector<std::int64_t> ScanStore::answered_scans() const {
  std::vector<std::int64_t> scans;
  for (const std::string& path : files("seam"))
    scans.push_back(stored_name(fs::path(path).filename(), "seam")->scan_id);
  return scans;
}

}  // namespace arcstart::seam_finding
