#include "services/seam_finding/seam_finding_app.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "common/bus/calibration_message.hpp"
#include "common/time.hpp"
#include "services/seam_finding/scan/answer_mark.hpp"
#include "services/seam_finding/scan/scan_limits.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr std::int64_t kRepetition = 1'000'000;  // us

}  // namespace

SeamFindingApp::SeamFindingApp(Bus& bus, const SeamFindingSettings& settings,
                               const Instance& instance, JobBook jobs)
    : bus_(bus),
      settings_(settings),
      jobs_(std::move(jobs)),
      seam_channel_(instance.sensor_channel("SEAM")),
      store_(instance, settings.backgrounds_kept, settings.results_kept) {
  std::vector<std::string> warnings;
  for (const CollectedScan& scan : store_.backgrounds(warnings))
    if (background_error(scan, settings_).empty()) remember(scan);
  if (!backgrounds_.empty())
    spdlog::info("background scan {} found again", backgrounds_.back()->scan_id());
  for (const std::int64_t scan_id : store_.answered_scans()) collector_.skip(scan_id);
  if (auto seam = store_.newest_seam(warnings)) {
    answered_scan_ = seam->scan_id;
    answer_ = std::move(seam->bytes);
    answer_mark_ = answer_mark(answered_scan_, answer_);
  }
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
  // By then a running scan has told of itself: its state comes at 5 Hz.
  next_repeat_ = steady_now() + kRepetition;
  bus.subscribe<scan_t>(instance.sensor_channel("SCAN"), Queue::measurements(),
                        [this](const scan_t& state) { take(state); });
  bus.subscribe<calibration_t>(instance.sensor_channel("CALIBRATION"), Queue::measurements(),
                               [this](const calibration_t& message) { take(message); });
  bus.subscribe<profile_t>(instance.sensor_channel("PROFILE"), Queue::measurements(),
                           [this](const profile_t& profile) { take(profile); });
}

void SeamFindingApp::take(const scan_t& state) {
  if (state.state == scan_t::SCANNING && state.scan_id != answered_scan_) answer_.clear();
  // Read as the scan begins, so that what holds is stated before the answer.
  if (state.state == scan_t::SCANNING) jobs_.take(state.scan_id, state.job);
  const bool awaited = collector_.awaits_profiles();
  collector_.take(state);
  // The end of a scan is told again and again, and is no sign of life of the chain behind it.
  if (state.state == scan_t::SCANNING || (!awaited && collector_.awaits_profiles()))
    alive_ = steady_now();
  answer_decided();
}

void SeamFindingApp::take(const profile_t& profile) {
  alive_ = steady_now();
  collector_.take(profile);
  running_.take(profile, profile.count > 0 ? background_for(profile.scan_id, profile.calibration_id)
                                           : nullptr);
  answer_decided();
}

// Tells how sure the answer is, no more: reconstruction says what is wrong with a calibration.
void SeamFindingApp::take(const calibration_t& message) {
  std::erase_if(calibrations_, [&](const Calibration& one) { return one.id == message.id; });
  try {
    calibrations_.push_back(calibration_from_message(message));
  } catch (const CalibrationError&) {
    return;
  }
  // As many as there are backgrounds: a seam needs one of its own calibration.
  if (calibrations_.size() > static_cast<std::size_t>(settings_.backgrounds_kept))
    calibrations_.erase(calibrations_.begin());
}

void SeamFindingApp::answer_decided() {
  while (const auto scan = collector_.next())
    send(scan->state.kind == scan_t::BACKGROUND ? take_background(*scan) : take_workpiece(*scan));
}

seam_t SeamFindingApp::take_workpiece(const CollectedScan& scan) {
  const JobInForce& job = jobs_.take(scan.state.scan_id, scan.state.job);
  if (!job.refusal.empty() && scan.refusal.empty()) {
    CollectedScan refused = scan;
    refused.refusal = {seam_t::CALL, job.refusal};
    return answer_workpiece(refused, {}, nullptr, settings_);
  }
  const StoredBackground* background = background_for(scan.state.scan_id, calibration_of(scan));
  return answer_workpiece(scan, running_.finish(scan, background), background, job.settings,
                          calibration_for(scan));
}

seam_t SeamFindingApp::take_background(const CollectedScan& scan) {
  ScanRefusal error = background_error(scan, settings_);
  const JobInForce& job = jobs_.take(scan.state.scan_id, scan.state.job);
  if (error.empty() && !job.refusal.empty()) error = {seam_t::CALL, job.refusal};
  seam_t receipt = answer_background(scan, error);
  if (!error.empty()) return receipt;
  remember(scan);
  try {
    store_.keep_background(scan);
    background_store_error_.clear();
  } catch (const ScanStoreError& failure) {
    background_store_error_ = failure.what();
    spdlog::error("{}", background_store_error_);
    receipt.remark += "kept in memory alone, lost with a restart: " + background_store_error_;
  }
  return receipt;
}

void SeamFindingApp::remember(const CollectedScan& scan) {
  backgrounds_.push_back(std::make_unique<StoredBackground>(scan, settings_));
  std::size_t points = 0, kept = 0;  // but for the newest no more than one scan's
  for (auto one = backgrounds_.rbegin(); one != backgrounds_.rend(); ++one) {
    points += (*one)->points();
    if (kept > 0 &&
        (points > kMostPoints || kept >= static_cast<std::size_t>(settings_.backgrounds_kept)))
      break;
    ++kept;
  }
  backgrounds_.erase(backgrounds_.begin(), backgrounds_.end() - static_cast<std::ptrdiff_t>(kept));
}

const Calibration* SeamFindingApp::calibration_for(const CollectedScan& scan) const {
  const std::string id = calibration_of(scan);
  for (const Calibration& calibration : calibrations_)
    if (calibration.id == id) return &calibration;
  return nullptr;
}

const StoredBackground* SeamFindingApp::background_for(std::int64_t scan_id,
                                                       const std::string& calibration) const {
  const std::string& job = jobs_.settings(scan_id).background_job;
  for (auto background = backgrounds_.rbegin(); background != backgrounds_.rend(); ++background)
    if ((*background)->scan_id() < scan_id && (*background)->calibration_id() == calibration &&
        (job.empty() || (*background)->job() == job))
      return background->get();
  return nullptr;
}

void SeamFindingApp::send(const seam_t& seam) {
  answer_.resize(static_cast<std::size_t>(seam.getEncodedSize()));
  seam.encode(answer_.data(), 0, static_cast<int>(answer_.size()));
  answered_scan_ = seam.scan_id;
  answer_mark_ = answer_mark(answered_scan_, answer_);
  last_error_ = seam.verdict == seam_t::REFUSED
                    ? fmt::format("scan {} refused: {}", seam.scan_id, seam.reason)
                    : "";
  try {
    store_.keep_seam(seam.scan_id, answer_);
    store_error_.clear();
  } catch (const ScanStoreError& failure) {
    store_error_ = failure.what();  // the answer is right all the same, and goes out
    spdlog::error("{}", store_error_);
  }
  bus_.publish_bytes(seam_channel_, answer_);
  next_repeat_ = steady_now() + kRepetition;
}

void SeamFindingApp::tick(std::int64_t) {
  const std::int64_t now = steady_now();
  if (!answer_.empty() && now >= next_repeat_) {
    bus_.publish_bytes(seam_channel_, answer_);
    next_repeat_ = now + kRepetition;
  }
  if (!collector_.is_open() || now - alive_ < seconds_to_us(settings_.dead_chain_s)) return;
  collector_.give_up(refuse_scan(
      collector_.awaits_profiles() ? seam_t::NO_PROFILES : seam_t::SENSOR_CAPTURE_SILENT,
      fmt::format("{}", settings_.dead_chain_s)));
  answer_decided();
}

Health SeamFindingApp::health() const {
  Health health;
  health.lost = collector_.lost();
  const std::string& fault = store_error_.empty() ? background_store_error_ : store_error_;
  health.last_error = fault.empty() ? last_error_ : fault;
  if (!answer_.empty()) health.notice = answer_mark_;
  if (!fault.empty()) health.state = service_status_t::FAULT;
  return health;
}

}  // namespace arcstart::seam_finding
