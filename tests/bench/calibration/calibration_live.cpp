#include "tests/bench/calibration/calibration_live.hpp"

#include <fmt/core.h>

#include <cmath>

#include "paths.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "tests/bench/calibration/simulated_plate.hpp"
#include "tests/system/running_cell.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;
namespace {

// mm; nothing where the cell did not come up or refused.
std::optional<double> live_error(int seed) {
  const std::string name = fmt::format("bench_calibration_{}", seed);
  const std::string set = std::string(ARCSTART_BUILD) + "/tests/system/" + name + "/set";
  RunningCell cell(
      name, {std::string("calibration.plate: ") + ARCSTART_SOURCE + "/scripts/simulated_plate.yaml",
             "calibration.folder: " + set, "calibration.tool: TCP1",
             "cell_simulator.robot_error_mm: 0.1", "cell_simulator.robot_error_deg: 0.01"});
  cell.start_all();
  if (!cell.wait_until_ready()) {
    fmt::print(stderr,
               "bench_calibration: the cell did not come up: scripts/in-private-network?\n");
    return std::nullopt;
  }
  const Output output =
      run({program("arcstart"), "calibrate", "--live", "--seed", std::to_string(seed)}, 300);
  if (output.code != 0) {
    fmt::print(stderr, "bench_calibration: seed {}: {}\n", seed, output.err);
    return std::nullopt;
  }
  const Calibration found =
      calibration::read_calibration_file(cell.folder() + "/LASER0.calibration.yaml");
  return end_to_end(
      found.sensor_model, found.T_tool_camera,
      probe_points(cell_simulator::make_true_sensor(cell_simulator::SensorSettings{})));
}

}  // namespace

bool bench_live(int seeds, nlohmann::json& json) {
  fmt::print("\nThrough the real processes, robot error 0.1 mm, 0.01 deg; end to end, mm\n");
  double squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto error = live_error(seed);
    if (!error) return false;
    fmt::print("  seed {}: {:.4f}\n", seed, *error);
    std::fflush(stdout);
    json[fmt::format("robot_01.live.seed_{}_mm", seed)] = *error;
    squares += *error * *error;
  }
  const double rms = std::sqrt(squares / std::max(1, seeds));
  fmt::print("robot_01.live        {} seeds: {:.4f} mm RMS\n", seeds, rms);
  json["robot_01.live.n"] = seeds;
  json["robot_01.live.e2e_rms_mm"] = rms;
  return true;
}

}  // namespace arcstart::test
