#include "services/seam_finding/scan_collector.hpp"

#include <algorithm>

namespace arcstart {
namespace {

constexpr std::size_t kMostOpen =
    4;  // scans that may be open at a time; hostile ids must not fill memory
constexpr std::size_t kMostProfiles = 20'000;  // of a scan: 20 minutes at 14 Hz

// A scan's end as the next scan's state still tells it.
scan_t previous_of(const scan_t& state) {
  scan_t previous{};
  previous.utime = state.utime;
  previous.run_id = state.run_id;
  previous.state = scan_t::ENDED;
  previous.scan_id = previous.begin_utime = state.previous_scan_id;
  previous.kind = state.previous_kind;
  previous.end_utime = state.previous_end_utime;
  previous.last_seq = state.previous_last_seq;
  previous.images = state.previous_images;
  return previous;
}

}  // namespace

void ScanCollector::take(const scan_t& state) {
  for (auto& [id, scan] : open_)
    if (scan.state && scan.state->state == scan_t::SCANNING && scan.state->run_id != state.run_id &&
        scan.refusal.empty())
      scan.refusal = "sensor_capture restarted within the scan: scan again";
  if (state.previous_scan_id > decided_)
    if (const auto before = open_.find(state.previous_scan_id);
        before != open_.end() &&
        (!before->second.state || before->second.state->state != scan_t::ENDED))
      before->second.state = previous_of(state);
  if (state.state == scan_t::IDLE || state.scan_id <= decided_) return;
  OpenScan& scan = open_[state.scan_id];
  if (!scan.state || scan.state->state != scan_t::ENDED) scan.state = state;
  while (open_.size() > kMostOpen) open_.erase(open_.begin());
}

void ScanCollector::take(const profile_t& profile) {
  if (profile.scan_id == 0) return;
  for (auto& [id, scan] : open_)
    if (id < profile.scan_id) scan.passed = true;
  if (profile.scan_id <= decided_) return;
  OpenScan& scan = open_[profile.scan_id];
  if (scan.profiles.size() < kMostProfiles) scan.profiles.try_emplace(profile.seq, profile);
  while (open_.size() > kMostOpen) open_.erase(open_.begin());
}

bool ScanCollector::is_decided(const OpenScan& scan) const {
  if (!scan.state) return false;
  if (!scan.refusal.empty()) return true;
  if (scan.state->state != scan_t::ENDED) return false;
  return scan.passed || scan.state->images == 0 || scan.profiles.contains(scan.state->last_seq);
}

std::optional<CollectedScan> ScanCollector::next() {
  if (open_.empty() || !is_decided(open_.begin()->second)) return {};
  auto node = open_.extract(open_.begin());
  OpenScan& scan = node.mapped();
  decided_ = node.key();
  CollectedScan collected;
  collected.state = *scan.state;
  collected.refusal = scan.refusal;
  for (auto& [seq, profile] : scan.profiles)
    if (profile.run_id == scan.state->run_id) collected.profiles.push_back(std::move(profile));
  if (scan.state->state == scan_t::ENDED) {
    collected.profiles_lost =
        std::max(0, scan.state->images - static_cast<int>(collected.profiles.size()));
    lost_ += collected.profiles_lost;
  }
  return collected;
}

std::int64_t ScanCollector::waiting() const {
  if (open_.empty()) return 0;
  const OpenScan& scan = open_.begin()->second;
  return scan.state && scan.state->state == scan_t::ENDED && !is_decided(scan)
             ? open_.begin()->first
             : 0;
}

void ScanCollector::give_up(const std::string& reason) {
  if (waiting() != 0) open_.begin()->second.refusal = reason;
}

}  // namespace arcstart
