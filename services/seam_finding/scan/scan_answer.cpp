#include "services/seam_finding/scan/scan_answer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "services/seam_finding/answer/accuracy.hpp"
#include "services/seam_finding/answer/weld_order.hpp"
#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/paper/find_seam_as_in_the_paper.hpp"
#include "services/seam_finding/referee/ruling.hpp"
#include "services/seam_finding/scan/clock_share.hpp"
#include "services/seam_finding/scan/cloud_builder.hpp"
#include "services/seam_finding/scan/covariance_message.hpp"
#include "services/seam_finding/scan/seam_message.hpp"

namespace arcstart::seam_finding {
namespace {

seam_t empty_answer(const CollectedScan& scan) {
  seam_t seam = empty_seam();
  // A scan that never ended is dated by its begin, so that the answer depends on no arrival.
  seam.utime = scan.state.end_utime != 0 ? scan.state.end_utime : scan.state.begin_utime;
  seam.run_id = scan.state.run_id;
  seam.scan_id = scan.state.scan_id;
  seam.command_id = scan.state.start_command_id;
  seam.request = scan.state.request;
  seam.job = scan.state.job;
  seam.part = scan.state.part;
  const ScanBalance balance = balance_of(scan);
  for (const profile_t& profile : scan.profiles) seam.points += profile.count;
  seam.stripes = balance.stripes;
  seam.stripes_empty = balance.empty;
  seam.stripes_overlit = balance.overlit;
  seam.stripes_unusable = balance.unusable;
  seam.stripes_without_pose = balance.without_pose;
  seam.images_lost = balance.images_lost;
  seam.profiles_lost = balance.profiles_lost;
  return seam;
}

seam_t refused(seam_t seam, const ScanRefusal& refusal) {
  seam.verdict = seam_t::REFUSED;
  seam.refusal = refusal.code;
  seam.reason = refusal.words;
  return seam;
}

seam_t refused(seam_t seam, std::int16_t code) {
  return refused(std::move(seam), refuse_scan(code));
}

// overlit: the code where most of the missing were too bright, otherwise: where not.
ScanRefusal refuse_missing(const ScanBalance& balance, int missing, std::size_t all,
                           std::int16_t overlit, std::int16_t otherwise) {
  return refuse_scan(
      2 * balance.overlit > missing ? overlit : otherwise,
      fmt::format("{} of {} stripes are missing: {}", missing, all, balance.losses()));
}

int& counter_of(ScanBalance& balance, const profile_t& profile) {
  if (profile.count > 0) return balance.stripes;
  if (showed_nothing(profile)) return balance.empty;
  switch (profile.why) {
    case profile_t::TOO_MUCH_LIGHT:
      return balance.overlit;
    case profile_t::INCOMPLETE_IMAGE:
      return balance.incomplete;
    case profile_t::LASER_OFF:
    case profile_t::UNREADABLE_IMAGE:
    case profile_t::UNKNOWN_ENCODING:
      return balance.unusable;
    default:
      return balance.without_pose;
  }
}

int missing_of(const ScanCloud& cloud) {
  return static_cast<int>(std::count_if(
      cloud.stripes.begin(), cloud.stripes.end(),
      [](const ScanStripe& stripe) { return stripe.seen == ScanStripe::Seen::kMissing; }));
}

// Clocks displace both ends: they are named before an end that was not seen.
void judge_clocks(seam_t& seam, const CollectedScan& scan, const SeamFindingSettings& settings) {
  const std::string remark = clock_remark(scan, settings.clock_displacement_max_mm);
  if (seam.verdict != seam_t::FOUND || remark.empty()) return;
  seam.remark = remark + seam.remark;
  if (seam.usable != seam_t::CONTRADICTED) seam.usable = seam_t::CLOCKS_APART;
}

bool two_missing_in_a_row(const ScanCloud& cloud) {
  return std::adjacent_find(cloud.stripes.begin(), cloud.stripes.end(),
                            [](const ScanStripe& a, const ScanStripe& b) {
                              return a.seen == ScanStripe::Seen::kMissing &&
                                     b.seen == ScanStripe::Seen::kMissing;
                            }) != cloud.stripes.end();
}

}  // namespace

std::string ScanBalance::losses() const {
  std::string text;
  if (images_lost > 0)
    text += fmt::format("{} images lost at the camera{}; ", images_lost,
                        incomplete > 0 ? fmt::format(", {} of them incomplete", incomplete) : "");
  if (overlit > 0) text += fmt::format("{} images with too much light; ", overlit);
  if (unusable > 0) text += fmt::format("{} images without laser, or unreadable; ", unusable);
  if (profiles_lost > 0) text += fmt::format("{} stripes lost on their way; ", profiles_lost);
  if (without_pose > 0) text += fmt::format("{} stripes without position; ", without_pose);
  return text;
}

ScanBalance balance_of(const CollectedScan& scan) {
  ScanBalance balance;
  for (const profile_t& profile : scan.profiles) ++counter_of(balance, profile);
  // The camera's count has the incomplete ones in it, where it is known.
  balance.images_lost = std::max(scan.state.lost, balance.incomplete);
  balance.profiles_lost = scan.profiles_lost;
  return balance;
}

ScanCloud cloud_of(const CollectedScan& scan) {
  if (scan.profiles.empty()) return {};
  CloudBuilder builder(scan.state.first_seq);
  for (const profile_t& profile : scan.profiles) builder.add(profile);
  builder.miss_until(scan.state.last_seq + 1);
  return builder.take_cloud();
}

std::string calibration_of(const CollectedScan& scan) {
  for (const profile_t& profile : scan.profiles)
    if (profile.count > 0 && !profile.calibration_id.empty()) return profile.calibration_id;
  return "";
}

bool calibration_changed(const CollectedScan& scan) {
  const std::string id = calibration_of(scan);
  return std::any_of(scan.profiles.begin(), scan.profiles.end(), [&](const profile_t& profile) {
    return profile.why == profile_t::CALIBRATION_CHANGED ||
           (profile.count > 0 && profile.calibration_id != id);
  });
}

StoredBackground::StoredBackground(const CollectedScan& scan, const SeamFindingSettings& settings)
    : scan_id_(scan.state.scan_id), cloud_(std::make_unique<ScanCloud>(cloud_of(scan))) {
  calibration_id_ = calibration_of(scan);
  job_ = scan.state.job;
  if (settings.background_rule == BackgroundRule::kNeighbours)
    model_ = std::make_unique<NeighbourBackground>(*cloud_, settings.background_neighbours,
                                                   settings.background_distance());
  else
    model_ = std::make_unique<SurfaceBackground>(*cloud_, settings.background_distance());
}

ScanRefusal background_error(const CollectedScan& scan, const SeamFindingSettings& settings) {
  if (!scan.refusal.empty()) return scan.refusal;
  const ScanBalance balance = balance_of(scan);
  if (calibration_changed(scan)) return refuse_scan(seam_t::CALIBRATION_CHANGED);
  if (const ScanRefusal refusal = clock_refusal(scan, settings.clock_displacement_max_mm);
      !refusal.empty())
    return refusal;
  if (scan.state.end_cause == scan_t::CAMERA_LOST) return refuse_scan(seam_t::CAMERA_LOST);
  const ScanCloud cloud = cloud_of(scan);
  const int missing = missing_of(cloud);
  if (scan.profiles.empty() && scan.state.images > 0)
    return refuse_missing(balance, scan.state.images, scan.state.images, seam_t::BACKGROUND_OVERLIT,
                          seam_t::BACKGROUND_INCOMPLETE);
  if (20 * missing > static_cast<int>(cloud.stripes.size()) || two_missing_in_a_row(cloud))
    return refuse_missing(balance, missing, cloud.stripes.size(), seam_t::BACKGROUND_OVERLIT,
                          seam_t::BACKGROUND_INCOMPLETE);
  if (balance.stripes == 0) return refuse_scan(seam_t::BACKGROUND_EMPTY);
  return {};
}

seam_t answer_background(const CollectedScan& scan, const ScanRefusal& error) {
  seam_t seam = empty_answer(scan);
  seam.calibration_id = calibration_of(scan);
  if (!error.empty()) return refused(seam, error);
  seam.verdict = seam_t::BACKGROUND_STORED;
  seam.background_points = seam.points;
  seam.remark = balance_of(scan).losses();
  return seam;
}

seam_t answer_workpiece(const CollectedScan& scan, const StoredBackground* background,
                        const SeamFindingSettings& settings, const Calibration* calibration) {
  return answer_workpiece(scan, prepare(scan, background), background, settings, calibration);
}

PreparedScan prepare(const CollectedScan& scan, const StoredBackground* background) {
  PreparedScan prepared{cloud_of(scan), {}, {}, {}};
  downsample(prepared.cloud, prepared.downsampled);
  thin_out(prepared.cloud, prepared.thinned);
  if (background) segment(prepared.cloud, background->model(), prepared.segmentation);
  return prepared;
}

namespace {

// Before what its ends say: with a calibration that is not believed no part of it is usable.
void fill_in_distrust(seam_t& seam, const Calibration* calibration) {
  if (seam.verdict != seam_t::FOUND || calibration == nullptr ||
      calibration->id != seam.calibration_id)
    return;
  const std::string why = distrust(calibration->verdict);
  if (why.empty()) return;
  seam.usable = seam_t::CALIBRATION_FAILED;
  seam.remark += "the calibration is not to be relied on: " + why + "; ";
}

}  // namespace

seam_t answer_workpiece(const CollectedScan& scan, const PreparedScan& prepared,
                        const StoredBackground* background, const SeamFindingSettings& settings,
                        const Calibration* calibration) {
  seam_t seam = empty_answer(scan);
  if (!scan.refusal.empty()) return refused(seam, scan.refusal);
  seam.calibration_id = calibration_of(scan);
  if (calibration_changed(scan)) return refused(seam, seam_t::CALIBRATION_CHANGED);
  if (scan.state.images == 0) return refused(seam, seam_t::NO_IMAGES);
  if (const ScanRefusal refusal = clock_refusal(scan, settings.clock_displacement_max_mm);
      !refusal.empty())
    return refused(seam, refusal);
  const ScanBalance balance = balance_of(scan);
  const ScanCloud& cloud = prepared.cloud;
  const int missing = missing_of(cloud);
  if (scan.profiles.empty() ||
      missing > settings.lost_share_max * static_cast<double>(cloud.stripes.size()))
    return refused(seam,
                   refuse_missing(balance, scan.profiles.empty() ? scan.state.images : missing,
                                  std::max<std::size_t>(cloud.stripes.size(), scan.state.images),
                                  seam_t::TOO_MUCH_LIGHT, seam_t::TOO_LITTLE_KNOWN));
  if (balance.stripes == 0) return refused(seam, seam_t::NO_STRIPE);
  if (!background) return refused(seam, seam_t::NO_BACKGROUND);
  seam.background_scan_id = background->scan_id();
  seam.remark = balance.losses();
  if (scan.state.end_cause == scan_t::CAMERA_LOST)
    seam.remark += "the camera was lost in the scan; ";
  SeamResult result = find_seam(cloud, prepared.segmentation, prepared.downsampled, settings,
                                static_cast<std::uint64_t>(scan.state.scan_id));
  if (settings.start_rule == StartRule::kEdges)
    rule(examine(cloud, prepared.thinned, result), result);
  // Behind the referee, which sees the stripes in the robot's own coordinates.
  add_robot_accuracy(settings.robot_accuracy_mm, result);
  set_weld_order(settings, result);
  fill_in(seam, result);
  judge_clocks(seam, scan, settings);
  seam.background_points = static_cast<int>(prepared.segmentation.background.size());
  fill_in_distrust(seam, calibration);
  fill_in_calibration_covariance(seam, scan, calibration);
  return seam;
}

}  // namespace arcstart::seam_finding
