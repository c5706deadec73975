// What a calibration is good for: the time offset from sweeps, and the paper's experiment with the
// calibration that the simulated cell's own procedure finds.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

namespace arcstart::test {

// Sweeps to and fro at two speeds over the rough table, rising on the way; images stamped 27.32 ms
// late with a jitter of 0.5 ms, true calibration but for the offset. Seeds 1 to `trials`.
void bench_time_offset(int trials, nlohmann::json& json);

// Plate, sweeps, background scan and workpiece scan with a tool beside it, the robot wrong by 0.1
// mm and 0.01 deg in every pose of the plate and in each scan. Seeds 1 to `seeds`.
void bench_experiment(int seeds, nlohmann::json& json);

}  // namespace arcstart::test
