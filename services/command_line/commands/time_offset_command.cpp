#include "services/command_line/commands/time_offset_command.hpp"

#include <fmt/core.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/options.hpp"
#include "common/time.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/calibration/files/whole_file.hpp"
#include "services/calibration/sweeps/time_offset.hpp"
#include "services/command_line/commands/say.hpp"
#include "services/command_line/recordings/recorded_sweeps.hpp"
#include "services/command_line/recordings/recording.hpp"

namespace arcstart::command_line {
namespace {

struct TimeOffsetOptions {
  SweepOptions sweeps;
  std::string output;
  bool json = false;
};

nlohmann::ordered_json to_json(const calibration::TimeOffset& found) {
  nlohmann::ordered_json json = {
      {"refused", found.refused},        {"warnings", found.warnings},
      {"time_offset", found.offset_s},   {"deviation", found.deviation_s},
      {"play", found.play_mm},           {"play_deviation", found.play_deviation_mm},
      {"residual", found.residual_mm},   {"residual_as_it_was", found.unmended_mm},
      {"stripes", found.stripes},        {"sweeps", nlohmann::json::array()},
      {"faces", nlohmann::json::array()}};
  for (const calibration::SweepFinding& sweep : found.sweeps)
    json["sweeps"].push_back({{"scan_id", sweep.scan_id},
                              {"speed", sweep.speed_mm_s},
                              {"approach", sweep.approach_mm_s},
                              {"stripes", sweep.stripes},
                              {"time_offset", sweep.offset_s},
                              {"deviation", sweep.deviation_s}});
  for (const calibration::FlatFace& face : found.faces) {
    const Eigen::Vector3d& n = face.plane.normal;
    json["faces"].push_back({{"normal", {n.x(), n.y(), n.z()}}, {"offset", face.plane.offset}});
  }
  return json;
}

void tell(const calibration::TimeOffset& found) {
  for (const calibration::SweepFinding& sweep : found.sweeps)
    say("time-offset",
        fmt::format("sweep at {:.0f} mm/s, {:.0f} mm/s across the face, {} stripes: {:.2f} ms",
                    sweep.speed_mm_s, sweep.approach_mm_s, sweep.stripes, 1e3 * sweep.offset_s));
  for (const std::string& warning : found.warnings) say("time-offset", "warning: " + warning);
  if (!found.refused.empty()) return say("time-offset", "refused: " + found.refused);
  say("time-offset",
      fmt::format("time offset {:.2f} ms, standard deviation {:.2f} ms; the faces' residual is "
                  "{:.3f} mm, it was {:.3f} mm",
                  1e3 * found.offset_s, 1e3 * found.deviation_s, found.residual_mm,
                  found.unmended_mm));
}

int run(const TimeOffsetOptions& options) {
  const auto [sweeps, calibration] = read_judged_sweeps(options.sweeps, "time-offset");
  const calibration::TimeOffset found = calibration::find_time_offset(sweeps.record, calibration);
  tell(found);
  if (options.json) std::cout << to_json(found).dump(2) << "\n";
  if (!found.refused.empty()) return 1;
  if (options.output.empty()) return 0;
  Calibration changed = calibration::with_time_offset(calibration, found);
  changed.made = utime_now();
  calibration::replace_calibration_file(options.output,
                                        calibration::calibration_file_text(changed));
  say("time-offset", options.output + ": the calibration with this time offset");
  return 0;
}

}  // namespace

void add_time_offset_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<TimeOffsetOptions>();
  Command command(parent, "time-offset",
                  "How late images are stamped against positions, from recorded sweeps");
  options->sweeps.add_to(command);
  command.option("-o,--output", options->output,
                 "File for the same calibration with the time offset found");
  command.flag("--json", options->json, "Print all that was found on standard output; s, mm");
  command.footer(
      "Record a scan (scripts/record, arcstart scan) in which the robot sweeps to and fro over a "
      "flat face, a table or a\n"
      "plate, twice at one speed and twice at double that speed or more, and comes nearer to it "
      "and "
      "goes away from it on\n"
      "the way, say 100 mm up over 150 mm along: a face parallel to the motion tells nothing. A "
      "tilted plate will do as\n"
      "well. The speeds tell a time offset from play in the robot.\n"
      "The offset is added to an image's time to look up the position: images stamped 27.32 ms "
      "late "
      "have -27.32 ms.\n"
      "Exit: 0 found; 1 refused, it says what is missing; 2 bad input.");
  command.run([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace arcstart::command_line
