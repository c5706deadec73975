// bench_calibration: what a calibration from rendered plate images is worth, against the simulated
// sensor's truth, every seed told. The same images serve all robot errors of a seed.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "common/options.hpp"
#include "services/calibration/solve/calibrate.hpp"
#include "tests/bench/calibration/calibration_in_use.hpp"
#include "tests/bench/calibration/calibration_live.hpp"
#include "tests/bench/calibration/calibration_mistakes.hpp"
#include "tests/bench/calibration/simulated_plate.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::cell_simulator;
using namespace arcstart::test;

namespace {

struct RobotError {
  const char* name;
  double mm, deg;
};
constexpr RobotError kRobots[] = {{"robot_0", 0, 0},
                                  {"robot_003", 0.03, 0.003},
                                  {"robot_01", 0.1, 0.01},
                                  {"robot_03", 0.3, 0.03}};

struct Sums {
  int seeds = 0, refused = 0, left_out = 0;
  double e2e = 0, opencv = 0, plane = 0, plane_seeds = 0;  // mean squares
  double predicted_e2e = 0, shift = 0, predicted_shift = 0;
  double worst_e2e = 0;
};

// calibrateCamera with the circles taken as points, Park, a plane through the stripes' points.
double opencv_end_to_end(Target plate, std::vector<View> views, const TrueSensor& sensor,
                         const std::vector<ProbePoint>& probes) {
  plate.radius_mm = 0;
  const IntrinsicsStage camera = calibrate_camera(plate, views, sensor.width, sensor.height);
  SensorModel model = camera.model;
  std::vector<RigidTransform> tools;
  std::vector<Eigen::Vector3d> laser;
  for (std::size_t i = 0; i < views.size(); ++i) {
    tools.push_back(views[i].T_base_tool);
    const auto points = stripe_on_plate(model, camera.T_camera_plate[i],
                                        straight_stripe(model, views[i].stripe, 1000));
    laser.insert(laser.end(), points.begin(), points.end());
  }
  model.laser_plane = fit_laser_plane(laser).plane;
  const auto methods = closed_form_hand_eye(tools, camera.T_camera_plate, plate.points());
  return end_to_end(model, methods[1].T_tool_camera, probes);
}

// The laser plane with the true camera: RMS of how far the probe points lie from where it puts
// them.
double plane_error(const Target& plate, const std::vector<View>& views, const TrueSensor& sensor,
                   const std::vector<ProbePoint>& probes) {
  SensorModel model;
  model.width = sensor.width;
  model.height = sensor.height;
  model.fx = sensor.fx;
  model.fy = sensor.fy;
  model.cx = sensor.cx;
  model.cy = sensor.cy;
  model.distortion = sensor.distortion;
  std::vector<Eigen::Vector3d> laser;
  for (const View& view : views) {
    const auto points = stripe_on_plate(model, locate_plate(model, plate, view),
                                        straight_stripe(model, view.stripe, 1000));
    laser.insert(laser.end(), points.begin(), points.end());
  }
  model.laser_plane = fit_laser_plane(laser).plane;
  return end_to_end(model, sensor.T_tool_camera, probes);
}

void run_seed(const Target& plate, const std::vector<View>& true_views, const TrueSensor& sensor,
              std::uint64_t seed, const std::string& row, const RobotError& robot, Sums& sums) {
  const auto probes = probe_points(sensor);
  std::vector<View> views = true_views;
  for (View& view : views)
    view.T_base_tool = said_pose(view.T_base_tool, robot.mm, robot.deg, seed, view.index);
  CalibrateOptions options;
  options.leave_one_out = false;
  const CalibrationRun run = calibrate(plate, views, sensor.width, sensor.height, options);
  ++sums.seeds;
  if (!run.refused.empty()) {
    ++sums.refused;
    fmt::print("{:<16} {:>4}  refused: {}\n", row, seed, run.refused);
    return;
  }
  const AdjustmentState& state = run.adjustment.state;
  const double e2e = end_to_end(state.model, state.T_tool_camera, probes);
  std::vector<View> found;
  for (const View& view : views)
    if (view.unusable.empty()) found.push_back(view);
  const double opencv = opencv_end_to_end(plate, found, sensor, probes);
  const double plane = plane_error(plate, found, sensor, probes);
  std::vector<Eigen::Vector2d> pixels;
  for (const ProbePoint& probe : probes) pixels.push_back(probe.pixel);
  const double predicted = predicted_rms(state, run.adjustment.covariance, pixels);
  const double shift =
      (state.T_tool_camera.translation() - sensor.T_tool_camera.translation()).norm();
  const double predicted_shift = std::sqrt(run.adjustment.covariance.diagonal().tail<3>().sum());
  sums.left_out += static_cast<int>(run.left_out.size());
  sums.e2e += e2e * e2e;
  sums.opencv += opencv * opencv;
  sums.plane += plane * plane;
  sums.predicted_e2e += predicted * predicted;
  sums.shift += shift * shift;
  sums.predicted_shift += predicted_shift * predicted_shift;
  sums.worst_e2e = std::max(sums.worst_e2e, e2e);
  fmt::print(
      "{:<16} {:>4} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>8.4f} {:>8.4f} "
      "{:>4}\n",
      row, seed, e2e, predicted, opencv, plane, shift, predicted_shift,
      run.adjustment.deviations.robot_mm, run.adjustment.deviations.pixel, run.left_out.size());
  std::fflush(stdout);
}

void report(const std::string& row, const Sums& sums, nlohmann::json& json) {
  const double n = std::max(1, sums.seeds - sums.refused);
  const auto rms = [&](double squares) { return std::sqrt(squares / n); };
  const auto ratio = [&](double predicted, double actual) {
    return actual > 0 ? std::sqrt(predicted / actual) : 0;
  };
  fmt::print(
      "{:<16} {} seeds: end to end {:.4f} mm (worst {:.4f}, predicted/actual {:.2f}), OpenCV "
      "{:.4f}, laser plane {:.4f}, hand-eye predicted/actual {:.2f}, {} refused, {} left "
      "out\n",
      row, sums.seeds, rms(sums.e2e), sums.worst_e2e, ratio(sums.predicted_e2e, sums.e2e),
      rms(sums.opencv), rms(sums.plane), ratio(sums.predicted_shift, sums.shift), sums.refused,
      sums.left_out);
  json[row + ".n"] = sums.seeds;
  json[row + ".refused"] = sums.refused;
  json[row + ".views_left_out"] = sums.left_out;
  json[row + ".e2e_rms_mm"] = rms(sums.e2e);
  json[row + ".e2e_worst_mm"] = sums.worst_e2e;
  json[row + ".e2e_sd_ratio"] = ratio(sums.predicted_e2e, sums.e2e);
  json[row + ".opencv_e2e_rms_mm"] = rms(sums.opencv);
  json[row + ".laser_plane_mm"] = rms(sums.plane);
  json[row + ".sd_ratio"] = ratio(sums.predicted_shift, sums.shift);
}

bool write(const nlohmann::json& json, const std::string& path) {
  if (path.empty() || std::ofstream(path) << json.dump(2) << '\n') return true;
  fmt::print(stderr, "bench_calibration: {} cannot be written\n", path);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  Program options("Accuracy of a calibration from rendered images of a plate, 20 poses each");
  std::string json_path, folder;
  int seeds = 10, ratio_seeds = 20, trials = 10, experiments = 20;
  options.option("--json", json_path, "Where the figures go, flat JSON");
  options.option("--seeds", seeds, "Seeds 1 to N of the error rows, none left out").show_default();
  options.option("--ratio-seeds", ratio_seeds, "Seeds 1 to N of the deviation's ratio")
      .show_default();
  options.option("--trials", trials, "Seeds 1 to N of the time offset").show_default();
  options.option("--experiments", experiments, "Seeds 1 to N of the experiment with the result")
      .show_default();
  bool live = false;
  options.flag("--live", live,
               "Instead, calibrate three seeds through the real processes, in a network of its "
               "own");
  options.option("--folder", folder,
                 "Instead, write the first seed's images and poses with a robot error of 0.1 mm, "
                 "0.01 deg as a folder for arcstart calibrate");
  if (const auto code = options.parse(argc, argv)) return *code;
  spdlog::set_level(spdlog::level::err);  // the tables alone
  const SensorSettings settings;
  PrintedPlate well, poor;
  poor.columns = 11;
  poor.rows = 9;
  poor.staggered = false;
  PoseRange poor_range;
  poor_range.least_tilt_deg = 0;
  poor_range.most_tilt_deg = 25;
  poor_range.roll_deg = 12;
  if (!folder.empty()) {
    PlateImages images(settings, well);
    write_folder(folder, images, well, draw_poses(images, well, {}, 20, 1), 0.1, 0.01, 1);
    return 0;
  }
  nlohmann::json json;
  if (live) return bench_live(3, json) && write(json, json_path) ? 0 : 1;
  fmt::print(
      "rendered images, {} x {}: noise, speckle, print under the stripe; detection and "
      "extraction as shipped\n",
      settings.image_width_px, settings.image_height_px);
  fmt::print("{:<16} {:>4} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>4}  mm, px\n", "row",
             "seed", "end2end", "predicted", "opencv", "plane", "hand-eye", "predicted", "robot sd",
             "pixel sd", "out");
  std::map<std::string, Sums> rows, ratios;
  std::vector<Mistake> mistakes{{"mislabelled"}, {"glared"}, {"upside_down"}};
  for (const bool spread : {true, false}) {
    PlateImages images(settings, spread ? well : poor);
    const PrintedPlate& printed = spread ? well : poor;
    const int last = spread ? std::max(seeds, ratio_seeds) : seeds;
    for (int seed = 1; seed <= last; ++seed) {
      const auto number = static_cast<std::uint64_t>(seed);
      const auto poses = draw_poses(images, printed, spread ? PoseRange{} : poor_range, 20, number);
      const auto views = rendered_views(images, printed, poses, number);
      if (spread && seed <= seeds) run_mistakes(images, printed, poses, views, number, mistakes);
      for (const RobotError& robot : kRobots) {
        if (!spread && robot.mm == 0) continue;
        const std::string row = std::string(robot.name) + (spread ? "" : "_poor");
        Sums& sums = ratios[row];
        run_seed(plate_of(printed), views, images.sensor(), number, row, robot, sums);
        if (seed == seeds) rows[row] = sums;
      }
    }
  }
  fmt::print("\n");
  for (const auto& [row, sums] : rows) {
    report(row, sums, json);
    const Sums& all = ratios[row];
    if (all.seeds == sums.seeds) continue;
    nlohmann::json more;
    report(row, all, more);
    json[row + ".sd_ratio"] = more[row + ".sd_ratio"];
    json[row + ".e2e_sd_ratio"] = more[row + ".e2e_sd_ratio"];
    json[row + ".sd_ratio_n"] = all.seeds;
  }
  if (seeds > 0) report(mistakes, json);
  if (trials > 0) bench_time_offset(trials, json);
  if (experiments > 0) bench_experiment(experiments, json);
  return write(json, json_path) ? 0 : 1;
}
