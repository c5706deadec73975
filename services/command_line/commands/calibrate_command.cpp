#include "services/command_line/commands/calibrate_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "common/options.hpp"
#include "common/time.hpp"
#include "services/calibration/calibration_settings.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/calibration/files/calibration_set.hpp"
#include "services/calibration/files/view_detection.hpp"
#include "services/calibration/files/whole_file.hpp"
#include "services/calibration/report/calibration_json.hpp"
#include "services/calibration/report/calibration_report.hpp"
#include "services/calibration/solve/calibration_result.hpp"
#include "services/command_line/commands/calibrate_live.hpp"
#include "services/command_line/commands/say.hpp"
#include "services/command_line/output/terminal.hpp"
#include "services/extraction/files/image_file.hpp"

namespace arcstart::command_line {
namespace {

namespace fs = std::filesystem;

struct CalibrateCommandOptions {
  std::string folder, output, cell, channel, forced_by;
  bool without_laser = false, live = false, go_on = false;
  int poses = 20;
  std::int64_t seed = -1;
  calibration::CalibrationNames names;
};

cv::Mat of_size(const cv::Mat& grey, const std::string& path, const cv::Size& size) {
  if (size.area() > 0 && grey.size() != size)
    throw calibration::CalibrationSetError(
        fmt::format("{}: {} x {} pixels, the images before it have {} x {}", path, grey.cols,
                    grey.rows, size.width, size.height));
  return grey;
}

struct Seen {
  std::vector<calibration::View> views;
  cv::Size size;
};

Seen look_at_all(const CalibrateCommandOptions& options, const calibration::CalibrationSet& set,
                 ProgressLine& progress) {
  Seen seen;
  for (std::size_t i = 0; i < set.poses.size(); ++i) {
    const calibration::CalibrationPose& pose = set.poses[i];
    progress.show(fmt::format("calibrate: pose {} of {}", i + 1, set.poses.size()));
    const cv::Mat grid = of_size(extraction::read_luminance(pose.grid), pose.grid, seen.size);
    seen.size = grid.size();
    const cv::Mat laser = options.without_laser
                              ? grid
                              : of_size(extraction::read_grey_image(pose.laser, options.channel),
                                        pose.laser, seen.size);
    seen.views.push_back(calibration::detect_view(pose, set.plate, grid, laser));
    if (options.without_laser) seen.views.back().stripe.clear();
  }
  const auto count = [&](const auto& condition) {
    return std::count_if(seen.views.begin(), seen.views.end(), condition);
  };
  if (count([](const calibration::View& view) { return !view.target.empty(); }) == 0)
    throw calibration::CalibrationSetError(fmt::format(
        "{}: the plate's {} x {} points are in none of the {} images: are pattern, columns and "
        "rows in plate.yaml right?",
        options.folder, set.plate.columns, set.plate.rows, seen.views.size()));
  if (!options.without_laser &&
      count([](const calibration::View& view) { return !view.stripe.empty(); }) == 0)
    throw calibration::CalibrationSetError(fmt::format(
        "{}: no stripe in any of the {} images: was the laser on? --without-laser judges camera "
        "and hand-eye alone",
        options.folder, seen.views.size()));
  return seen;
}

void tell(const calibration::CalibrationRun& run, const std::vector<std::string>& missed) {
  for (const calibration::LeftOutView& view : run.left_out)
    say("calibrate", fmt::format("pose {} left out: {}", view.index, view.why));
  for (const std::string& warning : run.warnings) say("calibrate", "warning: " + warning);
  if (!run.refused.empty()) {
    say("calibrate", "refused: " + run.refused);
    return;
  }
  for (const std::string& line : missed) say("calibrate", "limit missed: " + line);
  for (const std::string& line : run.advice) say("calibrate", "to improve it: " + line);
}

int run_command(const CalibrateCommandOptions& options) {
  calibration::CalibrationLimits limits;
  if (!options.cell.empty())
    limits = Configuration::from_file(options.cell)
                 .read<calibration::CalibrationSettings>("calibration")
                 .limits;
  const fs::path output = options.output.empty() ? fs::path(options.folder) / "calibration.yaml"
                                                 : fs::path(options.output);
  ProgressLine progress;
  const calibration::CalibrationSet set = calibration::read_calibration_set(options.folder);
  const Seen seen = look_at_all(options, set, progress);
  calibration::CalibrateOptions how;
  how.progress = [&](const std::string& text) { progress.show("calibrate: " + text); };
  calibration::CalibrationRun run =
      calibration::calibrate(set.plate, seen.views, seen.size.width, seen.size.height, how);
  if (run.refused.empty() && !run.has_laser && !options.without_laser)
    run.refused = "no usable pose shows a straight stripe on the plate";
  const std::vector<std::string> missed =
      run.refused.empty() ? calibration::missed_limits(run, limits) : std::vector<std::string>{};
  progress.show("calibrate: report");

  const auto image_of = [&](int index) {
    const auto pose =
        std::find_if(set.poses.begin(), set.poses.end(),
                     [&](const calibration::CalibrationPose& p) { return p.index == index; });
    const cv::Mat grid = extraction::read_luminance(pose->grid);
    if (options.without_laser) return grid;
    return cv::Mat(cv::max(grid, extraction::read_grey_image(pose->laser, options.channel)));
  };
  const std::string forced_by = missed.empty() ? "" : options.forced_by;
  nlohmann::json json = calibration::to_json(run, missed);
  if (!forced_by.empty()) json["forced_by"] = forced_by;
  const bool has_set = run.refused.empty() && run.has_laser;
  // What misses a limit never replaces the cell's file, which may be in force, but by a person.
  const fs::path written = missed.empty() || !forced_by.empty()
                               ? output
                               : fs::path(output).replace_extension(".failed.yaml");
  if (has_set) {
    Calibration made = calibration::to_calibration(run, options.names);
    made.verdict = calibration::verdict_of(run, limits, forced_by);
    const std::string text = calibration::calibration_file_text(made);
    json["id"] = calibration::parse_calibration(text, output.string()).id;
    calibration::replace_calibration_file(written.string(), text);
  }
  calibration::write_whole(fs::path(output).replace_extension(".json").string(),
                           json.dump(2) + "\n");
  calibration::write_whole(
      fs::path(output).replace_extension(".html").string(),
      calibration::calibration_report("Calibration of " + options.folder, set.plate, seen.views,
                                      run, limits, missed, forced_by, image_of));
  progress.clear();
  tell(run, missed);
  std::cout << json.dump(2) << "\n";
  if (!run.refused.empty()) return 1;
  if (has_set)
    say("calibrate",
        fmt::format("{}: {}; report beside it, .html and .json", written.string(),
                    missed.empty()
                        ? fmt::format("laser points of poses it never saw lie within {:.3f} mm RMS",
                                      run.left_one_out.laser_rms_mm)
                    : forced_by.empty() ? std::string("not within its limits, not to be used")
                                        : "not within its limits, forced into use by " + forced_by +
                                              ": no seam measured with it is usable"));
  return missed.empty() ? 0 : 1;
}

int run_or_complain(const CalibrateCommandOptions& options) try {
  if (options.live != options.folder.empty()) {
    say("calibrate", "give either a folder or --live");
    return 2;
  }
  if (options.live && !options.forced_by.empty()) {
    say("calibrate", "--force goes with a folder: that in which --live captured its poses");
    return 2;
  }
  if (options.live)
    return calibrate_live({options.cell,
                           {options.names.sensor, options.names.robot, ""},
                           options.poses,
                           !options.go_on,
                           options.seed});
  return run_command(options);
} catch (const calibration::CalibrationFileError& error) {
  say("calibrate", std::string("refused: the result is no sensor that can be: ") + error.what());
  return 1;
}

}  // namespace

void add_calibrate_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<CalibrateCommandOptions>();
  options->names.made = utime_now();
  Command command(parent, "calibrate",
                  "Camera, laser plane and hand-eye from images of a plate and the robot's poses");
  command.option(
      "folder", options->folder,
      "Holds plate.yaml, poses.csv, grid/NNNN.png and laser/NNNN.png (or .jpg, .jpeg, .bmp, "
      ".tif, .tiff); arcstart import calibration makes such a folder");
  command.flag("--live", options->live,
               "In a running cell instead: captures pose after pose and has arcstart-calibration "
               "solve; a simulated cell drives the poses itself");
  command.option("--poses", options->poses, "With --live: poses in a simulated cell")
      .between(1, 1000)
      .show_default();
  command
      .option("--seed", options->seed,
              "With --live: seed of a simulated plate; -1: the one in force")
      .show_default();
  command.flag("--continue", options->go_on,
               "With --live: keep the poses that were captured before");
  command.option(
      "-o,--output", options->output,
      "File for the calibration; a report stands beside it, .html and .json. One that misses a "
      "limit goes to .failed.yaml beside it (default: FOLDER/calibration.yaml)");
  command
      .option("--cell", options->cell,
              "The cell's file, cell.yaml, whose section calibration holds the limits")
      .existing_file();
  command
      .option(
          "--channel", options->channel,
          "Colour channel of the laser, for the stripe in coloured images; the plate is sought in "
          "grey")
      .one_of({"r", "g", "b"});
  command.option("--sensor", options->names.sensor, "Whose calibration it is").show_default();
  command.option("--robot", options->names.robot, "On which robot").show_default();
  command.option("--tool", options->names.tool, "The robot's tool frame of the poses")
      .show_default();
  command
      .option("--time-offset", options->names.time_offset,
              "Added to an image's time to look up the position, s; known from elsewhere")
      .between(-5.0, 5.0)
      .show_default();
  command.option("--force", options->forced_by,
                 "Name of who answers for using it though it misses a limit: it is written as one "
                 "that passed would be, comes into force, and carries the name; no seam measured "
                 "with it is usable");
  command.flag("--without-laser", options->without_laser,
               "Judge camera and hand-eye alone; no calibration is written");
  command.footer(
      "plate.yaml: pattern (circles, asymmetric_circles, chessboard), columns, rows, pitch_mm "
      "(OpenCV's square size),\nradius_mm, origin_dot_radius_mm where the first dot is larger. "
      "poses.csv: index,x,y,z,qw,qx,qy,qz, tool in base, mm.\nlaser/ may be absent where grid/ "
      "shows "
      "the stripe too. JSON goes to standard output.\nExit: 0 made and within its limits; 1 "
      "refused "
      "or a limit missed; 2 bad input.");
  command.run([options, &exit_code] { exit_code = run_or_complain(*options); });
}

}  // namespace arcstart::command_line
