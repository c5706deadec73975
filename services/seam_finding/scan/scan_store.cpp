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

// "background-" and the scan_id in 20 digits: names sort as times do.
std::string file_name(const std::string& prefix, std::int64_t scan_id) {
  return fmt::format("{}-{:020d}.lcm", prefix, scan_id);
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
  write(file_name("background", scan.state.scan_id), events);
  prune("background", backgrounds_kept_);
}

void ScanStore::keep_seam(std::int64_t scan_id, const std::vector<std::uint8_t>& bytes) {
  if (folder_.empty()) return;
  write(file_name("seam", scan_id), {{scan_id, sensor_ + "_SEAM", bytes}});
  prune("seam", results_kept_);
}

std::vector<std::string> ScanStore::files(const std::string& prefix) const {
  std::vector<std::string> found;
  if (folder_.empty()) return found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(prefix + "-") && name.ends_with(".lcm")) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
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
  for (const std::string& path : files("seam")) {
    const std::string number = fs::path(path).stem().string().substr(std::string("seam-").size());
    std::int64_t scan_id = 0;
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), scan_id);
    if (error == std::errc() && end == number.data() + number.size()) scans.push_back(scan_id);
  }
  return scans;
}

}  // namespace arcstart::seam_finding
