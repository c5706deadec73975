#pragma once

#include <arcstart/calibration_t.hpp>
#include <arcstart/profile_t.hpp>
#include <arcstart/robot_pose_t.hpp>
#include <arcstart/stripe_t.hpp>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/service.hpp"
#include "services/reconstruction/reconstruction.hpp"

namespace arcstart::reconstruction {

// Takes <SENSOR>_STRIPE, <ROBOT>_POSE and <SENSOR>_CALIBRATION, gives exactly one <SENSOR>_PROFILE
// for every stripe.
class ReconstructionApp : public App {
 public:
  // The bus outlives the app.
  ReconstructionApp(Bus& bus, const ReconstructionSettings& settings, const Instance& instance);

  Health health() const override;

 private:
  // Counts what a source's own numbering says is missing.
  struct Numbering {
    std::int64_t group = 0, last = -1;
    std::int64_t missing_before(std::int64_t group, std::int64_t number);
  };

  void take_stripe(const stripe_t& message);
  void take_position(const robot_pose_t& message);
  void take_calibration(const calibration_t& message);
  void publish_profiles();

  Bus& bus_;
  ReconstructionSettings settings_;
  Instance instance_;
  Reconstruction reconstruction_;

  std::int64_t position_run_ = 0;                // of the newest position
  std::string position_error_;                   // why the last position was dropped
  std::vector<std::uint8_t> calibration_bytes_;  // of the newest accepted, with M as derived here
  std::string calibration_refused_;              // why the last one was not, empty where it was
  std::deque<std::int64_t>
      arrivals_;  // of the stripes that wait; steady clock, us. For health alone
  Numbering stripes_, positions_;
  std::int64_t lost_ = 0;
  std::string last_empty_;  // why the last profile without a position or calibration was so
};

// The whole main of arcstart-reconstruction.
int run(int argc, char** argv);

}  // namespace arcstart::reconstruction
