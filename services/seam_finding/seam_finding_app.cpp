#include "services/seam_finding/seam_finding_app.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "common/time.hpp"

namespace arcstart {

SeamFindingApp::SeamFindingApp(Bus& bus, const SeamFindingSettings& settings,
                               const Instance& instance)
    : bus_(bus),
      settings_(settings),
      seam_channel_(instance.sensor_channel("SEAM")),
      store_(instance, settings.backgrounds_kept, settings.results_kept) {
  std::vector<std::string> warnings;
  for (const CollectedScan& scan : store_.backgrounds(warnings))
    backgrounds_.push_back(std::make_unique<StoredBackground>(scan, settings_));
  if (auto seam = store_.newest_seam(warnings)) {
    answered_scan_ = seam->scan_id;
    answer_ = std::move(seam->bytes);
    collector_.skip(answered_scan_);
  }
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
  if (!backgrounds_.empty())
    spdlog::info("background scan {} found again", backgrounds_.back()->scan_id());
  bus.subscribe<scan_t>(instance.sensor_channel("SCAN"), Queue::measurements(),
                        [this](const scan_t& state) { take(state); });
  bus.subscribe<profile_t>(instance.sensor_channel("PROFILE"), Queue::measurements(),
                           [this](const profile_t& profile) { take(profile); });
}

void SeamFindingApp::take(const scan_t& state) {
  if (state.state == scan_t::SCANNING && state.scan_id > answered_scan_) answer_.clear();
  collector_.take(state);
  answer_decided();
}

void SeamFindingApp::take(const profile_t& profile) {
  heard_ = steady_now();
  collector_.take(profile);
  answer_decided();
}

void SeamFindingApp::answer_decided() {
  while (const auto scan = collector_.next()) {
    if (scan->state.kind == scan_t::BACKGROUND)
      take_background(*scan);
    else
      send(scan->state.scan_id, answer_workpiece(*scan, background_for(*scan), settings_));
  }
}

void SeamFindingApp::take_background(const CollectedScan& scan) {
  const std::string error = background_error(scan);
  seam_t receipt = answer_background(scan, error);
  if (error.empty()) {
    backgrounds_.push_back(std::make_unique<StoredBackground>(scan, settings_));
    if (static_cast<int>(backgrounds_.size()) > settings_.backgrounds_kept)
      backgrounds_.erase(backgrounds_.begin());
    try {
      store_.keep_background(scan);
      store_error_.clear();
    } catch (const ScanStoreError& failure) {
      store_error_ = failure.what();
      receipt.remark = "kept in memory alone, lost with a restart: " + store_error_;
    }
  }
  send(scan.state.scan_id, receipt);
}

const StoredBackground* SeamFindingApp::background_for(const CollectedScan& scan) const {
  std::string error;
  const std::string calibration = calibration_of(scan, error);
  for (auto background = backgrounds_.rbegin(); background != backgrounds_.rend(); ++background)
    if ((*background)->scan_id() < scan.state.scan_id &&
        (*background)->calibration_id() == calibration)
      return background->get();
  return nullptr;
}

void SeamFindingApp::send(std::int64_t scan_id, const seam_t& seam) {
  answer_.resize(static_cast<std::size_t>(seam.getEncodedSize()));
  seam.encode(answer_.data(), 0, static_cast<int>(answer_.size()));
  answered_scan_ = scan_id;
  try {
    store_.keep_seam(scan_id, answer_);
  } catch (const ScanStoreError& failure) {
    store_error_ = failure.what();  // the answer is right all the same, and goes out
  }
  bus_.publish_bytes(seam_channel_, answer_);
  next_repeat_ = steady_now() + 1'000'000;
}

void SeamFindingApp::tick(std::int64_t) {
  const std::int64_t now = steady_now();
  if (!answer_.empty() && now >= next_repeat_) {
    bus_.publish_bytes(seam_channel_, answer_);
    next_repeat_ = now + 1'000'000;
  }
  if (collector_.waiting() == 0) heard_ = now;
  if (now - heard_ < seconds_to_us(settings_.dead_chain_s)) return;
  collector_.give_up(fmt::format(
      "the chain is dead: no profile for {} s after the scan's end; see the STATUS of its services",
      settings_.dead_chain_s));
  answer_decided();
}

Health SeamFindingApp::health() const {
  Health health;
  health.lost = collector_.lost();
  if (!store_error_.empty()) {
    health.state = service_status_t::FAULT;
    health.last_error = store_error_;
  }
  return health;
}

}  // namespace arcstart
