// Sweeps of the simulated sensor over a scene, as a record for the time offset and for the check of
// a calibration: rendered images through extraction as shipped, positions as the robot says them.
#pragma once

#include <cstdint>
#include <vector>

#include "services/calibration/sweeps/sweep_profiles.hpp"
#include "services/cell_simulator/image/image_renderer.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;

struct SimulatedSweepsSettings {
  cell_simulator::SceneSettings scene;
  cell_simulator::SensorSettings sensor;
  cell_simulator::SceneKind kind = cell_simulator::SceneKind::background;
  std::vector<double> speeds_mm_s{50, 50, 120, 120};  // to, fro, to ...
  double frames_per_second = 14;
  double positions_per_second = 50;
  double position_noise_mm = 0.02;
  double image_delay_s = 0.02732;                    // images are stamped so much late
  double image_jitter_s = 0.5e-3;                    // standard deviation of each stamp
  std::int64_t begin_utime = 1'700'000'000'000'000;  // of the first scan; us
  double play_mm = 0;  // by which the robot stays behind what it says, in motion
};

// One scan of to and fro, appended to the record a minute after what stands in it.
void append_sweeps(calibration::SweepData& record, const SimulatedSweepsSettings& settings,
                   std::uint64_t seed);

// The sensor as it is, the offset as it should be found.
Calibration true_calibration(const SimulatedSweepsSettings& settings);

}  // namespace arcstart::test
