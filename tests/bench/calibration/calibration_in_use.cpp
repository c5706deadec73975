#include "tests/bench/calibration/calibration_in_use.hpp"

#include <fmt/format.h>

#include <cmath>

#include "services/calibration/solve/calibrate.hpp"
#include "services/calibration/solve/calibration_result.hpp"
#include "services/calibration/sweeps/time_offset.hpp"
#include "services/extraction/extraction_app.hpp"
#include "services/reconstruction/reconstruction_app.hpp"
#include "services/seam_finding/seam_finding_app.hpp"
#include "tests/bench/calibration/simulated_plate.hpp"
#include "tests/bench/calibration/simulated_sweeps.hpp"
#include "tests/bench/seam/seam_row.hpp"
#include "tests/bench/seam/simulated_scan.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;
using namespace extraction;
using namespace reconstruction;
using namespace seam_finding;
namespace {

constexpr double kRobotErrorMm = 0.1, kRobotErrorDeg = 0.01;

SimulatedSweepsSettings sweeps_settings() {
  SimulatedSweepsSettings settings;
  settings.scene.search_rise_mm = 100;
  return settings;
}

// By sweeps of this seed, with a calibration that knows of no offset.
calibration::TimeOffset found_offset(Calibration calibration, std::uint64_t seed) {
  calibration::SweepData record;
  append_sweeps(record, sweeps_settings(), seed);
  calibration.time_offset = 0;
  return calibration::find_time_offset(record, calibration);
}

// As the cell finds it: 20 poses of the plate, then the sweeps.
std::optional<Calibration> found_calibration(const cell_simulator::SensorSettings& sensor,
                                             std::uint64_t seed) {
  const cell_simulator::PrintedPlate printed;
  cell_simulator::PlateImages images(sensor, printed);
  std::vector<calibration::View> views =
      rendered_views(images, printed, draw_poses(images, printed, {}, 20, seed), seed);
  for (calibration::View& view : views)
    view.T_base_tool = said_pose(view.T_base_tool, kRobotErrorMm, kRobotErrorDeg, seed, view.index);
  calibration::CalibrateOptions options;
  options.leave_one_out = false;
  const calibration::CalibrationRun run = calibration::calibrate(
      plate_of(printed), views, images.sensor().width, images.sensor().height, options);
  if (!run.refused.empty()) {
    fmt::print("  seed {}: calibration refused: {}\n", seed, run.refused);
    return {};
  }
  Calibration calibration = calibration::to_calibration(run, {"LASER0", "ROBOT0", "TCP1", 0, 1});
  const calibration::TimeOffset offset = found_offset(calibration, seed);
  if (!offset.refused.empty()) {
    fmt::print("  seed {}: time offset refused: {}\n", seed, offset.refused);
    return {};
  }
  calibration = calibration::with_time_offset(calibration, offset);
  calibration.id = fmt::format("seed {}", seed);
  return calibration;
}

struct Outcome {
  seam_t seam{};
  truth_t truth{};
};

Outcome scan_with(const SimulatedScanSettings& settings, std::uint64_t seed) {
  const auto bus = Bus::in_memory();
  const Instance instance;  // no state folder: nothing outlives the run
  extraction::ExtractionApp extraction(*bus, extraction::ExtractionSettings{}, instance);
  reconstruction::ReconstructionApp reconstruction(*bus, reconstruction::ReconstructionSettings{},
                                                   instance);
  seam_finding::SeamFindingApp seam_finding(*bus, seam_finding::SeamFindingSettings{}, instance);
  Outcome outcome{};
  outcome.seam.verdict = seam_t::REFUSED;
  outcome.seam.reason = "no answer came";
  bus->subscribe<seam_t>("LASER0_SEAM", Queue::measurements(),
                         [&](const seam_t& seam) { outcome.seam = seam; });
  SimulatedScan scan(*bus, settings, seed);
  scan.run(cell_simulator::SceneKind::background);
  scan.run(cell_simulator::SceneKind::workpiece);
  outcome.truth = scan.truth();
  return outcome;
}

}  // namespace

void bench_time_offset(int trials, nlohmann::json& json) {
  const SimulatedSweepsSettings settings = sweeps_settings();
  const double truth = 1e3 * -settings.image_delay_s;
  fmt::print(
      "\nTime offset: rendered images, sweeps of 150 mm and 100 mm up to and fro at 50 and 120 "
      "mm/s over the rough table, stamps {} ms late with {} ms of jitter; ms\n",
      -truth, 1e3 * settings.image_jitter_s);
  double sum = 0, squares = 0, predicted = 0, worst = 0;
  int refused = 0;
  for (int seed = 1; seed <= trials; ++seed) {
    const calibration::TimeOffset found =
        found_offset(true_calibration(settings), static_cast<std::uint64_t>(seed));
    if (!found.refused.empty()) {
      ++refused;
      fmt::print("  seed {}: refused: {}\n", seed, found.refused);
      continue;
    }
    const double off = 1e3 * found.offset_s - truth;
    fmt::print("  seed {:>2}: {:.3f}, off by {:.3f}, deviation {:.3f}, {} stripes\n", seed,
               1e3 * found.offset_s, off, 1e3 * found.deviation_s, found.stripes);
    sum += off;
    squares += off * off;
    predicted += 1e6 * found.deviation_s * found.deviation_s;
    worst = std::max(worst, std::abs(off));
  }
  const double n = trials - refused, bias = n > 0 ? sum / n : 0;
  const double deviation = n > 1 ? std::sqrt((squares - n * bias * bias) / (n - 1)) : 0;
  fmt::print(
      "time offset: {} trials: bias {:.3f} ms, standard deviation {:.3f} ms, worst {:.3f} "
      "ms, predicted deviation {:.3f} ms, {} refused\n",
      trials, bias, deviation, worst, std::sqrt(predicted / std::max(1.0, n)), refused);
  std::fflush(stdout);
  json["time_offset.n"] = trials;
  json["time_offset.refused"] = refused;
  json["time_offset.bias_ms"] = bias;
  json["time_offset.sd_ms"] = deviation;
  json["time_offset.worst_ms"] = worst;
  json["time_offset.predicted_sd_ms"] = std::sqrt(predicted / std::max(1.0, n));
}

void bench_experiment(int seeds, nlohmann::json& json) {
  fmt::print(
      "\nThe paper's experiment with the calibration found: 20 poses of the plate, sweeps for the "
      "time offset, background and tee with a tool beside it; robot error {} mm, {} deg; mm, "
      "deg\n",
      kRobotErrorMm, kRobotErrorDeg);
  print_row_header();
  SeamRow row("experiment");
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    SimulatedScanSettings settings;
    settings.robot_error_mm = kRobotErrorMm;
    settings.robot_error_deg = kRobotErrorDeg;
    settings.calibration = found_calibration(settings.sensor, number);
    Outcome outcome{};
    outcome.seam.verdict = seam_t::REFUSED;
    outcome.seam.reason = "no calibration";
    if (settings.calibration) outcome = scan_with(settings, number);
    row.add(seed, outcome.seam, outcome.truth, 0);
  }
  row.finish(json);
}

}  // namespace arcstart::test
