#include "services/reconstruction/pending_stripes.hpp"

#include <fmt/core.h>

#include <utility>

#include "common/time.hpp"

namespace arcstart::reconstruction {
namespace {

void leave_empty(DecidedStripe& stripe, EmptyProfile why, const std::string& detail = "") {
  stripe.why = why;
  stripe.empty = to_words(why, detail);
}

}  // namespace

void PendingStripes::add(ReceivedStripe stripe, const TrajectoryQueue& trajectory,
                         ScanCalibration& calibrations) {
  // A stamp far ahead of the positions, and of the stripe that follows, is wrong: no position would
  // ever end its wait, and it would hold up all behind it.
  const auto newest = trajectory.newest();
  for (DecidedStripe& earlier : stripes_) {
    const std::int64_t utime = earlier.stripe.source.utime;
    if (!decided(earlier) && newest && utime - *newest > TrajectoryQueue::kJump &&
        utime - stripe.source.utime > TrajectoryQueue::kJump)
      leave_empty(earlier, EmptyProfile::kWrongTime);
  }
  stripes_.push_back({std::move(stripe), nullptr, std::nullopt, EmptyProfile::kNone, ""});
  DecidedStripe& added = stripes_.back();
  if (added.stripe.why != EmptyProfile::kNone) {
    leave_empty(added, added.stripe.why, added.stripe.empty);
    calibrations.of(added.stripe.source.scan_id);  // it may be its scan's first all the same
  } else {
    find_calibration(added, trajectory, calibrations);
  }
  if (stripes_.size() > most_ && !decided(stripes_.front()))
    leave_empty(stripes_.front(), EmptyProfile::kNoPosition,
                fmt::format("no later position while {} stripes waited", most_));
}

void PendingStripes::decide(const TrajectoryQueue& trajectory, ScanCalibration& calibrations) {
  for (DecidedStripe& stripe : stripes_) {
    if (!decided(stripe) && !stripe.calibration) find_calibration(stripe, trajectory, calibrations);
    if (decided(stripe) || !stripe.calibration) continue;
    const auto lookup =
        trajectory.at(stripe.stripe.source.utime + seconds_to_us(stripe.calibration->time_offset));
    if (lookup.state == TrajectoryQueue::State::found) stripe.T_base_tool = lookup.T_base_tool;
    if (lookup.state == TrajectoryQueue::State::none)
      leave_empty(stripe, EmptyProfile::kNoPosition, lookup.reason);
  }
}

// Leaves the stripe as it is where no calibration is known yet and it may still come.
void PendingStripes::find_calibration(DecidedStripe& stripe, const TrajectoryQueue& trajectory,
                                      ScanCalibration& calibrations) const {
  const StripeSource& source = stripe.stripe.source;
  const ScanCalibration::Answer answer = calibrations.of(source.scan_id);
  if (answer.none != EmptyProfile::kNone) return leave_empty(stripe, answer.none);
  if (!answer.calibration) {
    const auto newest = trajectory.newest();
    if (!newest || *newest - source.utime <= calibration_wait_) return;
    calibrations.give_up(source.scan_id);
    return leave_empty(stripe, EmptyProfile::kNoCalibration);
  }
  const SensorModel& model = answer.calibration->sensor_model;
  if (stripe.stripe.sensor_width != model.width || stripe.stripe.sensor_height != model.height)
    return leave_empty(
        stripe, EmptyProfile::kOtherSensor,
        fmt::format("image of {} x {} px, calibration of {} x {} px", stripe.stripe.sensor_width,
                    stripe.stripe.sensor_height, model.width, model.height));
  stripe.calibration = answer.calibration;
}

std::optional<DecidedStripe> PendingStripes::next() {
  if (stripes_.empty() || !decided(stripes_.front())) return std::nullopt;
  DecidedStripe stripe = std::move(stripes_.front());
  stripes_.pop_front();
  return stripe;
}

}  // namespace arcstart::reconstruction
