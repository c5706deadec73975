// Stripes that wait for their position, in the order in which they came.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "services/reconstruction/scan_calibration.hpp"
#include "services/reconstruction/stripe.hpp"
#include "services/reconstruction/trajectory_queue.hpp"

namespace arcstart::reconstruction {

// A stripe, its calibration and its position; or why it is to be an empty profile.
struct DecidedStripe {
  ReceivedStripe stripe;
  std::shared_ptr<const Calibration> calibration;
  std::optional<RigidTransform> T_base_tool;
  EmptyProfile why = EmptyProfile::kNone;
  std::string empty;  // the same in words
};

// Every decision follows from the order of messages within each channel, not from how the channels
// interleave: a stripe is decided by the stream of positions alone, and finds the same two
// positions whether it comes before or after them.
class PendingStripes {
 public:
  // calibration_wait: how far positions may run ahead of a stripe that has no calibration; us.
  // most: how many may wait.
  PendingStripes(std::int64_t calibration_wait, std::size_t most)
      : calibration_wait_(calibration_wait), most_(most) {}

  void add(ReceivedStripe stripe, const TrajectoryQueue& trajectory, ScanCalibration& calibrations);

  // Decides what can be decided. To be called after every message.
  void decide(const TrajectoryQueue& trajectory, ScanCalibration& calibrations);

  // The oldest stripe where it is decided; those behind it wait for it.
  std::optional<DecidedStripe> next();

  std::size_t waiting() const { return stripes_.size(); }

 private:
  static bool decided(const DecidedStripe& stripe) {
    return stripe.T_base_tool.has_value() || stripe.why != EmptyProfile::kNone;
  }
  void find_calibration(DecidedStripe& stripe, const TrajectoryQueue& trajectory,
                        ScanCalibration& calibrations) const;

  std::int64_t calibration_wait_;
  std::size_t most_;
  std::deque<DecidedStripe> stripes_;
};

}  // namespace arcstart::reconstruction
