// The whole of reconstruction: stripes, positions and calibrations in, one profile for every stripe
// out, in order.
#pragma once

#include <memory>
#include <optional>

#include "services/reconstruction/pending_stripes.hpp"
#include "services/reconstruction/reconstruction_settings.hpp"
#include "services/reconstruction/scan_calibration.hpp"
#include "services/reconstruction/stripe.hpp"
#include "services/reconstruction/trajectory_queue.hpp"

namespace arcstart::reconstruction {

class Reconstruction {
 public:
  explicit Reconstruction(const ReconstructionSettings& settings);

  // disputed: it is not known whose position it is.
  void take_position(std::int64_t utime, const RigidTransform& T_base_tool, bool disputed = false);
  void take_calibration(std::shared_ptr<const Calibration> calibration);
  void take_stripe(ReceivedStripe stripe);

  // The next profile, in the order of the stripes; nothing while its stripe waits. Take all after
  // every message.
  std::optional<Profile> next();

  const TrajectoryQueue& trajectory() const { return trajectory_; }
  const std::shared_ptr<const Calibration>& calibration() const { return calibrations_.newest(); }
  std::size_t waiting() const { return pending_.waiting(); }

 private:
  Profile make_profile(const DecidedStripe& decided) const;

  ReconstructionSettings settings_;
  TrajectoryQueue trajectory_;
  ScanCalibration calibrations_;
  PendingStripes pending_;
};

}  // namespace arcstart::reconstruction
