#include "tests/bench/seam/wild/wild_case.hpp"

#include <utility>

#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/scan/seam_message.hpp"

namespace arcstart {

using namespace seam_finding;
using cell_simulator::SceneKind;
using cell_simulator::WildScene;
namespace {

constexpr std::int64_t scan_us = 60'000'000;  // from scan to scan

CollectedScan collected(std::vector<profile_t> profiles, std::int8_t kind,
                        const synthetic::WildScanChoice& choice) {
  CollectedScan scan;
  scan.state.state = scan_t::ENDED;
  scan.state.kind = kind;
  scan.state.scan_id = scan.state.begin_utime = choice.scan_id;
  scan.state.run_id = choice.run_id;
  scan.state.end_cause = scan_t::STANDSTILL;
  scan.state.images = static_cast<int>(profiles.size());
  scan.state.first_seq = choice.first_seq;
  scan.state.last_seq = choice.first_seq + scan.state.images - 1;
  if (!profiles.empty()) scan.state.end_utime = profiles.back().utime;
  scan.profiles = std::move(profiles);
  return scan;
}

CollectedScan background_scan(const WildScene& scene) {
  synthetic::WildScanChoice choice;
  choice.scan_id -= scan_us;
  return collected(synthetic::wild_scan(scene, SceneKind::background, choice).profiles,
                   scan_t::BACKGROUND, choice);
}

SeamFindingSettings settings_of(const WildScene& scene) {
  SeamFindingSettings settings;
  settings.joint_type = joint_setting(scene.asked);
  return settings;
}

}  // namespace

std::string joint_setting(const std::string& asked) {
  return asked == "inside_corner" ? "corner" : asked;
}

WildCase::WildCase(const WildScene& scene)
    : scene_(scene),
      truth_(truth_of(scene)),
      settings_(settings_of(scene)),
      background_(background_scan(scene), settings_) {
  const synthetic::WildScanChoice choice;
  synthetic::WildScan scan = synthetic::wild_scan(scene, SceneKind::workpiece, choice);
  sights_ = std::move(scan.sights);
  work_ = collected(std::move(scan.profiles), scan_t::WORKPIECE, choice);
  prepared_ = prepare(work_, &background_);
  found_ = find_seam(prepared_.cloud, prepared_.segmentation, prepared_.downsampled, settings_,
                     static_cast<std::uint64_t>(work_.state.scan_id));
}

seam_t WildCase::answer(bool referee) const {
  if (referee) return answer_workpiece(work_, prepared_, &background_, settings_);
  seam_t seam = empty_seam();
  fill_in(seam, found_);
  return seam;
}

}  // namespace arcstart
