#include "services/seam_finding/scan/scan_answer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/paper/find_seam_as_in_the_paper.hpp"
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
  const ScanBalance balance = balance_of(scan);
  for (const profile_t& profile : scan.profiles) seam.points += profile.count;
  seam.stripes = balance.stripes;
  seam.stripes_empty = balance.empty;
  seam.stripes_without_pose = balance.without_pose;
  seam.images_lost = balance.images_lost;
  seam.profiles_lost = balance.profiles_lost;
  return seam;
}

seam_t refused(seam_t seam, const std::string& reason) {
  seam.verdict = seam_t::REFUSED;
  seam.reason = reason;
  return seam;
}

bool stripe_was_empty(const profile_t& profile) {
  return profile.count == 0 && (profile.empty.starts_with("stripe empty: ") ||
                                profile.empty == "no point within the working range");
}

int missing_of(const ScanCloud& cloud) {
  return static_cast<int>(std::count_if(
      cloud.stripes.begin(), cloud.stripes.end(),
      [](const ScanStripe& stripe) { return stripe.seen == ScanStripe::Seen::kMissing; }));
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
  if (images_lost > 0) text += fmt::format("{} images lost at the camera; ", images_lost);
  if (profiles_lost > 0) text += fmt::format("{} stripes lost on their way; ", profiles_lost);
  if (without_pose > 0) text += fmt::format("{} stripes without position; ", without_pose);
  return text;
}

ScanBalance balance_of(const CollectedScan& scan) {
  ScanBalance balance;
  for (const profile_t& profile : scan.profiles)
    ++(profile.count > 0           ? balance.stripes
       : stripe_was_empty(profile) ? balance.empty
                                   : balance.without_pose);
  balance.images_lost = scan.state.lost;
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

std::string calibration_of(const CollectedScan& scan, std::string& error) {
  std::string id;
  for (const profile_t& profile : scan.profiles) {
    if (profile.count > 0 && id.empty()) id = profile.calibration_id;
    if ((profile.count > 0 && profile.calibration_id != id) ||
        profile.empty.starts_with("calibration changed"))
      error = "the calibration changed within the scan: scan again";
  }
  return id;
}

StoredBackground::StoredBackground(const CollectedScan& scan, const SeamFindingSettings& settings)
    : scan_id_(scan.state.scan_id), cloud_(std::make_unique<ScanCloud>(cloud_of(scan))) {
  std::string error;
  calibration_id_ = calibration_of(scan, error);
  if (settings.background_rule == "neighbours")
    model_ = std::make_unique<NeighbourBackground>(*cloud_, settings.background_neighbours,
                                                   settings.background_distance_mm);
  else
    model_ = std::make_unique<SurfaceBackground>(*cloud_, settings.background_distance_mm);
}

std::string background_error(const CollectedScan& scan) {
  if (!scan.refusal.empty()) return scan.refusal;
  const ScanBalance balance = balance_of(scan);
  if (balance.stripes == 0)
    return "the background scan has no points: is the laser on, and the table within the working "
           "range?";
  std::string error;
  calibration_of(scan, error);
  if (!error.empty()) return error;
  if (scan.state.end_reason == "camera lost")
    return "the camera was lost in the background scan: scan again";
  const ScanCloud cloud = cloud_of(scan);
  const int missing = missing_of(cloud);
  if (20 * missing > static_cast<int>(cloud.stripes.size()) || two_missing_in_a_row(cloud))
    return fmt::format("the background is not complete, {} of {} stripes are missing: {}scan again",
                       missing, cloud.stripes.size(), balance.losses());
  return "";
}

seam_t answer_background(const CollectedScan& scan, const std::string& error) {
  seam_t seam = empty_answer(scan);
  std::string ignored;
  seam.calibration_id = calibration_of(scan, ignored);
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
  PreparedScan prepared{cloud_of(scan), {}, {}};
  downsample(prepared.cloud, prepared.downsampled);
  if (background) segment(prepared.cloud, background->model(), prepared.segmentation);
  return prepared;
}

seam_t answer_workpiece(const CollectedScan& scan, const PreparedScan& prepared,
                        const StoredBackground* background, const SeamFindingSettings& settings,
                        const Calibration* calibration) {
  seam_t seam = empty_answer(scan);
  if (!scan.refusal.empty()) return refused(seam, scan.refusal);
  std::string error;
  seam.calibration_id = calibration_of(scan, error);
  if (!error.empty()) return refused(seam, error);
  if (scan.state.images == 0) return refused(seam, "the scan has no images");
  const ScanBalance balance = balance_of(scan);
  const ScanCloud& cloud = prepared.cloud;
  const int missing = missing_of(cloud);
  if (scan.profiles.empty() ||
      missing > settings.lost_share_max * static_cast<double>(cloud.stripes.size()))
    return refused(seam, fmt::format("too little of the scan is known, {} of {} stripes are "
                                     "missing: {}scan again",
                                     scan.profiles.empty() ? scan.state.images : missing,
                                     std::max<std::size_t>(cloud.stripes.size(), scan.state.images),
                                     balance.losses()));
  if (balance.stripes == 0)
    return refused(
        seam, "no stripe in any image: is the laser on, and the work within the working range?");
  if (!background)
    return refused(
        seam,
        "no background: scan the empty cell under this calibration first (scan --kind background)");
  seam.background_scan_id = background->scan_id();
  seam.remark = balance.losses();
  if (scan.state.end_reason == "camera lost") seam.remark += "the camera was lost in the scan; ";
  fill_in(seam, find_seam(cloud, prepared.segmentation, prepared.downsampled, settings,
                          static_cast<std::uint64_t>(scan.state.scan_id)));
  seam.background_points = static_cast<int>(prepared.segmentation.background.size());
  fill_in_calibration_covariance(seam, scan, calibration);
  return seam;
}

}  // namespace arcstart::seam_finding
