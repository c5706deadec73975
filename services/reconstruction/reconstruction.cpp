#include "services/reconstruction/reconstruction.hpp"

#include <utility>

#include "common/time.hpp"
#include "services/reconstruction/carry_to_base.hpp"
#include "services/reconstruction/down_sampling.hpp"

namespace arcstart::reconstruction {

Reconstruction::Reconstruction(const ReconstructionSettings& settings)
    : settings_(settings),
      trajectory_(seconds_to_us(settings.keep_positions_s),
                  seconds_to_us(settings.largest_gap_ms / 1e3)),
      pending_(seconds_to_us(settings.wait_for_calibration_s),
               static_cast<std::size_t>(settings.waiting_stripes)) {}

void Reconstruction::take_position(std::int64_t utime, const RigidTransform& T_base_tool,
                                   bool disputed) {
  trajectory_.insert(utime, T_base_tool, disputed);
  pending_.decide(trajectory_, calibrations_);
}

void Reconstruction::take_calibration(std::shared_ptr<const Calibration> calibration) {
  calibrations_.take(std::move(calibration));
  pending_.decide(trajectory_, calibrations_);
}

void Reconstruction::take_stripe(ReceivedStripe stripe) {
  stripe.centres = down_sample(stripe.centres, settings_.keep_every, settings_.keep_bend_px);
  pending_.add(std::move(stripe), trajectory_, calibrations_);
  pending_.decide(trajectory_, calibrations_);
}

std::optional<Profile> Reconstruction::next() {
  const auto decided = pending_.next();
  if (!decided) return std::nullopt;
  return make_profile(*decided);
}

Profile Reconstruction::make_profile(const DecidedStripe& decided) const {
  Profile profile;
  profile.source = decided.stripe.source;
  profile.why = decided.why;
  profile.empty = decided.empty;
  if (decided.calibration) profile.calibration_id = decided.calibration->id;
  if (!decided.T_base_tool) return profile;
  profile.T_base_tool = *decided.T_base_tool;
  profile.camera_centre = *decided.T_base_tool * decided.calibration->T_tool_camera.translation();
  profile.points = carry_to_base(decided.stripe.centres, *decided.calibration, *decided.T_base_tool,
                                 {settings_.nearest_mm, settings_.farthest_mm});
  if (profile.points.empty()) {
    profile.why = EmptyProfile::kOutOfRange;
    profile.empty = to_words(profile.why);
  }
  return profile;
}

}  // namespace arcstart::reconstruction
