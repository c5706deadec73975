#include "services/seam_finding/scan/scan_collector.hpp"

#include <algorithm>
#include <arcstart/seam_t.hpp>
#include <utility>

#include "services/seam_finding/scan/scan_limits.hpp"

namespace arcstart::seam_finding {
namespace {

// As in scan_limits.hpp.
constexpr std::size_t kMostOpen = 4;
constexpr std::size_t kMostAnswered = 1000;

bool are_same(const profile_t& a, const profile_t& b) {
  const auto bytes_of = [](const profile_t& profile) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(profile.getEncodedSize()));
    profile.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
  };
  return bytes_of(a) == bytes_of(b);
}

// A scan's end as the next scan's state still tells it; known: what was heard of it before.
scan_t previous_of(const scan_t& state, const std::optional<scan_t>& known) {
  scan_t previous{};
  if (known) {
    previous.command_id = known->command_id;
    previous.start_command_id = known->start_command_id;
    previous.request = known->request;
    previous.job = known->job;
    previous.part = known->part;
  }
  previous.clock_difference = known ? known->clock_difference : 0;
  previous.clock_bound = known ? known->clock_bound : -1;
  previous.utime = state.utime;
  previous.run_id = state.run_id;
  previous.state = scan_t::ENDED;
  previous.scan_id = previous.begin_utime = state.previous_scan_id;
  previous.kind = state.previous_kind;
  previous.end_utime = state.previous_end_utime;
  previous.end_cause = state.previous_end_cause;
  previous.first_seq = state.previous_first_seq;
  previous.last_seq = state.previous_last_seq;
  previous.images = state.previous_images;
  previous.lost = state.previous_lost;
  return previous;
}

}  // namespace

bool ScanCollector::OpenScan::is_decided() const {
  if (!refusal.empty()) return true;
  return has_ended() && (state->images == 0 || newest_seq >= state->last_seq);
}

ScanCollector::OpenScan* ScanCollector::find(std::int64_t scan_id) {
  const auto scan = std::find_if(open_.begin(), open_.end(),
                                 [&](const OpenScan& open) { return open.scan_id == scan_id; });
  return scan == open_.end() ? nullptr : &*scan;
}

ScanCollector::OpenScan* ScanCollector::find_or_open(std::int64_t scan_id, std::int64_t run_id) {
  if (std::find(answered_.begin(), answered_.end(), scan_id) != answered_.end()) return nullptr;
  if (OpenScan* scan = find(scan_id)) return scan;
  if (open_.size() == kMostOpen) open_.pop_front();
  open_.emplace_back();
  open_.back().scan_id = scan_id;
  open_.back().run_id = run_id;
  return &open_.back();
}

// A restarted sensor_capture never resumes a scan. Which of its profiles had come when that was
// heard hangs on the two channels' pace, so none of them counts.
void ScanCollector::refuse_older_runs(std::int64_t run_id) {
  for (OpenScan& scan : open_) {
    if (scan.run_id < run_id && !scan.has_ended()) refuse(scan, seam_t::SENSOR_CAPTURE_RESTARTED);
  }
}

void ScanCollector::refuse(OpenScan& scan, std::int16_t code) {
  if (scan.refusal.empty()) scan.refusal = refuse_scan(code);
  scan.profiles.clear();
}

void ScanCollector::watch_senders(const scan_t& state) {
  senders_.is_repeated(state.run_id, state.utime, {});
  if (!senders_.dispute().empty())
    for (OpenScan& scan : open_) refuse(scan, seam_t::TWO_SENDERS);
  // Whether another run is a restarted sensor_capture or a second one its next word tells.
  if (state.run_id == std::exchange(newest_run_, state.run_id)) refuse_older_runs(state.run_id);
}

void ScanCollector::take_end_of_previous(const scan_t& state) {
  if (state.previous_scan_id == 0) return;
  if (OpenScan* scan = find(state.previous_scan_id); scan && !scan->has_ended())
    scan->state = previous_of(state, scan->state);
}

void ScanCollector::take(const scan_t& state) {
  watch_senders(state);
  take_end_of_previous(state);
  if (state.state == scan_t::IDLE || state.scan_id == 0) return;
  OpenScan* scan = find_or_open(state.scan_id, state.run_id);
  if (scan && !scan->has_ended()) scan->state = state;
}

void ScanCollector::take(const profile_t& profile) {
  for (OpenScan& scan : open_)
    if (scan.run_id == profile.run_id) scan.newest_seq = std::max(scan.newest_seq, profile.seq);
  if (profile.scan_id == 0) return;
  OpenScan* scan = find_or_open(profile.scan_id, profile.run_id);
  if (!scan || scan->run_id != profile.run_id || !scan->refusal.empty()) return;
  scan->newest_seq = std::max(scan->newest_seq, profile.seq);
  const auto [known, is_new] = scan->profiles.try_emplace(profile.seq, profile);
  if (is_new)
    scan->points += profile.x.size();
  else if (!are_same(known->second, profile))
    return refuse(*scan, seam_t::TWO_SENDERS);
  if (scan->profiles.size() <= kMostProfiles && scan->points <= kMostPoints) return;
  refuse(*scan, seam_t::TOO_MANY_POINTS);
}

std::optional<CollectedScan> ScanCollector::next() {
  const auto decided = std::find_if(open_.begin(), open_.end(),
                                    [](const OpenScan& scan) { return scan.is_decided(); });
  if (decided == open_.end()) return {};
  // One heard of earlier, of which no end was ever told, will not end any more.
  OpenScan& first = open_.front();
  if (!first.is_decided()) {
    first.refusal = refuse_scan(seam_t::END_NOT_REPORTED);
    first.profiles.clear();
  }
  CollectedScan scan = close(first);
  open_.pop_front();
  skip(scan.state.scan_id);
  return scan;
}

CollectedScan ScanCollector::close(OpenScan& scan) {
  CollectedScan collected;
  if (scan.state) {
    collected.state = *scan.state;
  } else {
    collected.state.run_id = scan.run_id;
    collected.state.scan_id = collected.state.begin_utime = scan.scan_id;
    collected.state.kind = scan_t::WORKPIECE;
    collected.state.first_seq = collected.state.last_seq = -1;
  }
  collected.refusal = scan.refusal;
  for (auto& [seq, profile] : scan.profiles) collected.profiles.push_back(std::move(profile));
  if (scan.has_ended() && scan.refusal.empty()) {
    collected.profiles_lost =
        std::max(0, scan.state->images - static_cast<int>(collected.profiles.size()));
    lost_ += collected.profiles_lost;
  }
  return collected;
}

bool ScanCollector::awaits_profiles() const {
  return std::any_of(open_.begin(), open_.end(),
                     [](const OpenScan& scan) { return scan.has_ended() && !scan.is_decided(); });
}

void ScanCollector::give_up(const ScanRefusal& refusal) {
  for (OpenScan& scan : open_)
    if (!scan.is_decided()) scan.refusal = refusal;
}

void ScanCollector::skip(std::int64_t scan_id) {
  answered_.push_back(scan_id);
  if (answered_.size() > kMostAnswered) answered_.pop_front();
}

}  // namespace arcstart::seam_finding
