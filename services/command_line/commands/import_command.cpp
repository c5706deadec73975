#include "services/command_line/commands/import_command.hpp"

#include <fmt/core.h>

#include <iostream>
#include <memory>

#include "common/bus/value_checks.hpp"
#include "common/options.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/command_line/commands/say.hpp"
#include "services/command_line/imports/calibration_source.hpp"
#include "services/command_line/imports/imported_recording.hpp"
#include "services/command_line/output/terminal.hpp"

namespace arcstart::command_line {
namespace {

struct CalibrationOptions {
  std::string source, plate, output;
  PoseConvention convention;
};

struct Options {
  std::string work, background, calibration, output, cell, joint;
  PoseConvention convention;
  std::string job, part, channel;
};

// The cell's settings, or all defaults; with the joint given, if one is.
Configuration settings_of(const Options& options) {
  if (options.joint.empty())
    return options.cell.empty() ? Configuration() : Configuration::from_file(options.cell);
  return Configuration::from_text("seam_finding:\n  joint_type: " + options.joint + "\n",
                                  "--joint");
}

std::string words(const ScanFolder& scan) {
  return fmt::format("{} images and {} poses of {}", scan.frames.size(), scan.poses.size(),
                     scan.path);
}

int run(const Options& options) {
  ImportedScans scans;
  scans.calibration = calibration::read_calibration_file(options.calibration);
  scans.settings = settings_of(options);
  scans.job = options.job;
  scans.part = options.part;
  scans.channel = options.channel;
  std::vector<std::string> notes;
  const auto read = [&](const std::string& folder) {
    return read_scan_folder(folder, options.convention, scans.calibration.time_offset, notes);
  };
  if (!options.background.empty()) scans.background = read(options.background);
  scans.work = read(options.work);
  put_background_first(scans, notes);
  ProgressLine progress;
  write_recording(
      options.output, scans,
      [&](double share) { progress.show(fmt::format("import scan: {:.0f} %", 100 * share)); },
      notes);
  progress.clear();
  for (const std::string& note : notes) say("import scan", note);
  if (!scans.background)
    say("import scan",
        "no background: replay refuses the scan without one (--background here or there)");
  say("import scan",
      fmt::format("{}: {}{}", options.output, words(scans.work),
                  scans.background ? "; background: " + words(*scans.background) : ""));
  return 0;
}

int run_calibration(const CalibrationOptions& options) {
  std::vector<std::string> notes;
  const CalibrationSource source =
      read_calibration_source(options.source, options.plate, options.convention, notes);
  write_calibration_folder(source, options.output);
  for (const std::string& note : notes) say("import calibration", note);
  say("import calibration",
      fmt::format("{}: {} poses{}", options.output, source.poses.size(),
                  source.laser.empty() ? ", the stripe in the plate's images, if anywhere" : ""));
  return 0;
}

void add_pose_options(Command& command, PoseConvention& convention) {
  command
      .option("--pose-format", convention.format,
              "What follows x,y,z of a pose: wxyz qw,qx,qy,qz; xyzw qx,qy,qz,qw; wpr FANUC's "
              "w,p,r, degrees about fixed x, y, z; rotvec rx,ry,rz, axis times angle in rad; "
              "matrix, in place of all: 12 numbers, [R t] row by row, or 16")
      .one_of({"wxyz", "xyzw", "wpr", "rotvec", "matrix"})
      .show_default();
  command.option("--pose-units", convention.unit, "Of the positions")
      .one_of({"mm", "m", "inch"})
      .show_default();
}

std::string name_error(const std::string& text) { return is_name(text) ? "" : kNoName; }

void add_import_scan_command(Command& parent, int& exit_code) {
  auto options = std::make_shared<Options>();
  Command command(parent, "scan",
                  "A scan's images and poses from files, as a recording for arcstart replay");
  command
      .option("FOLDER", options->work,
              "The scan of the work: frames/NNNN.png, frames.csv and poses.csv")
      .required();
  command.option("--background", options->background,
                 "Folder of the same kind: the empty cell, scanned the same way");
  command
      .option("--calibration", options->calibration,
              "The sensor's calibration file, as calibrate makes it")
      .required();
  command.option("-o,--output", options->output, "The recording; must not exist").required();
  add_pose_options(command, options->convention);
  command
      .option("--channel", options->channel,
              "Colour channel of the laser; without it colour images are turned to grey")
      .one_of({"r", "g", "b"});
  command.option("--joint", options->joint, "Joint that replay is to look for; without it a tee")
      .one_of({"any", "tee", "corner", "outside_corner", "lap", "butt", "v"});
  command
      .option("--cell", options->cell,
              "The cell's file, cell.yaml, whose settings replay is to use; without it the "
              "defaults")
      .existing_file()
      .excludes({"--joint"});
  command.option("--job", options->job, "Name of the job").check(name_error);
  command.option("--part", options->part, "Identifies the workpiece").check(name_error);
  command.footer(
      "frames.csv   index,utime (or index,utime_received): of each image its number and its stamp, "
      "us since 1970, UTC\n"
      "poses.csv    utime,x,y,z,qw,qx,qy,qz: the tool in base, us of the same clock. The line that "
      "names the columns may be left\n"
      "             out; where it contradicts --pose-format or --pose-units, the scan is refused\n"
      "frames/      one image a row, NNNN.png, .jpg, .jpeg, .bmp, .tif or .tiff, 8 bit, of the "
      "calibration's size\n"
      "The pose of an image is that at its stamp plus the calibration's time offset: images "
      "stamped 27.32 ms late have\n"
      "-27.32 ms there. Poses must cover all images. A background that is not earlier than the "
      "work is moved before it.\n"
      "Exit: 0 written; 1 failed; 2 bad input, in one line, and nothing written.");
  command.run([options, &exit_code] { exit_code = run(*options); });
}

void add_import_calibration_command(Command& parent, int& exit_code) {
  auto options = std::make_shared<CalibrationOptions>();
  Command command(parent, "calibration",
                  "Images of a plate and poses from other programs, as a folder for arcstart "
                  "calibrate");
  command.option("SOURCE", options->source, "Folder with the images and the poses").required();
  command.option("-o,--output", options->output, "The folder to be made; must not exist")
      .required();
  command.option("--plate", options->plate,
                 "plate.yaml, which describes the plate; without it SOURCE/plate.yaml");
  add_pose_options(command, options->convention);
  command.footer(
      "Poses, the tool in base: SOURCE/poses.csv, each row the image's index and a pose; or a file "
      "a pose, .txt or .yaml,\nwhose name ends with the image's number, in SOURCE/poses or "
      "SOURCE.\nImages, 8 bit, .png, .jpg, .jpeg, .bmp, .tif or .tiff, whose names end with the "
      "number: of the plate in SOURCE/grid,\nSOURCE/images or SOURCE, of the stripe on it in "
      "SOURCE/laser, or in the same ones. They are linked, not copied.\n"
      "Exit: 0 written; 1 failed; 2 bad input, in one line, and nothing written.");
  command.run([options, &exit_code] { exit_code = run_calibration(*options); });
}

}  // namespace

void add_import_command(CLI::App& parent, int& exit_code) {
  Command command(parent, "import", "What others recorded in files, as arcstart's own");
  command.require_command();
  command.footer(
      "arcstart import COMMAND --help tells all of one. Exit: 0 done; 1 failed; 2 bad input.");
  add_import_scan_command(command, exit_code);
  add_import_calibration_command(command, exit_code);
}

}  // namespace arcstart::command_line
