#include "services/command_line/commands/check_command.hpp"

#include <fmt/core.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/options.hpp"
#include "services/calibration/calibration_settings.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/calibration/sweeps/drift_check.hpp"
#include "services/command_line/commands/say.hpp"
#include "services/command_line/recordings/recorded_sweeps.hpp"
#include "services/command_line/recordings/recording.hpp"

namespace arcstart::command_line {
namespace {

struct CheckOptions {
  SweepOptions sweeps;
  std::string cell;
  double sphere_radius_mm = 0, limit_mm = 0;
  bool json = false;
};

nlohmann::ordered_json to_json(const calibration::DriftCheck& found, const std::string& alarm,
                               const std::string& calibration_id, double limit_mm, bool ball) {
  nlohmann::ordered_json json = {
      {"calibration", calibration_id},
      {"refused", found.refused},
      {"alarm", alarm},
      {"warnings", found.warnings},
      {"error", found.error_mm},
      {"limit", limit_mm},
      {"predicted", found.predicted_mm},
      {"place", found.place_mm},
      {"largest_turn_deg", found.turn_deg},
      {"shift_shown", {found.shift_shown(0), found.shift_shown(1), found.shift_shown(2)}},
      {"scans", nlohmann::json::array()}};
  if (ball) {
    json["radius_error"] = found.radius_mm;
    json["shape"] = found.shape_mm;
  } else {
    json["faces_in_common"] = found.faces;
  }
  for (const calibration::ScanView& view : found.views) {
    nlohmann::ordered_json scan = {{"scan_id", view.scan_id}, {"points", view.points}};
    if (ball) {
      scan["centre"] = {view.centre.x(), view.centre.y(), view.centre.z()};
      scan["radius"] = view.radius_mm;
    }
    scan["shape"] = view.shape_mm;
    json["scans"].push_back(scan);
  }
  return json;
}

int run(const CheckOptions& options) {
  const double limit_mm = options.limit_mm > 0 ? options.limit_mm
                          : options.cell.empty()
                              ? calibration::CalibrationLimits{}.check_mm
                              : Configuration::from_file(options.cell)
                                    .read<calibration::CalibrationSettings>("calibration")
                                    .limits.check_mm;
  const auto [sweeps, calibration] = read_judged_sweeps(options.sweeps, "check");
  const bool ball = options.sphere_radius_mm > 0;
  const calibration::DriftCheck found =
      ball ? calibration::check_on_ball(sweeps.record, calibration, options.sphere_radius_mm)
           : calibration::check_on_faces(sweeps.record, calibration);
  const std::string alarm = found.refused.empty() ? calibration::drift(found, limit_mm) : "";
  if (options.json)
    std::cout << to_json(found, alarm, calibration.id, limit_mm, ball).dump(2) << "\n";
  for (const std::string& warning : found.warnings) say("check", "warning: " + warning);
  if (!found.refused.empty()) {
    say("check", "refused: " + found.refused);
    return 1;
  }
  if (!alarm.empty()) {
    say("check",
        fmt::format("calibration {} HAS DRIFTED: {}: calibrate anew", calibration.id, alarm));
    return 1;
  }
  say("check",
      fmt::format("calibration {} holds: {} scans agree within {:.3f} mm, the limit is {} mm{}",
                  calibration.id, found.views.size(), found.error_mm, limit_mm,
                  found.predicted_mm < 0 ? ""
                                         : fmt::format(", the calibration itself expects {:.3f} mm",
                                                       found.predicted_mm)));
  return 0;
}

}  // namespace

void add_check_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  Command command(parent, "check",
                  "Whether a calibration still holds, from scans of one thing from two sides");
  options->sweeps.add_to(command);
  command
      .option("--sphere-radius", options->sphere_radius_mm,
              "The thing is a ball of this radius; without it flat faces are compared; mm")
      .between(1.0, 500.0);
  command
      .option("--limit", options->limit_mm,
              "By how much the scans may disagree, in place of cell.yaml's "
              "calibration.check_mm; mm")
      .positive();
  command.option("--cell", options->cell, "The cell's file, cell.yaml, which holds the limit")
      .existing_file()
      .excludes({"--limit"});
  command.flag("--json", options->json, "Print all that was found on standard output; mm");
  command.footer(
      "Record (scripts/record) two scans or more of the same thing, the tool turned by 40 deg or "
      "more between them, best by\n"
      "180 deg about the vertical; one file or several. A dull ball of 15 to 40 mm radius tells "
      "most: "
      "its place from each side,\n"
      "its radius and its shape. Without --sphere-radius the flat faces that two scans have in "
      "common are compared where both\n"
      "see them: a table shows a sensor that turned, an upright plate one that shifted.\n"
      "It has drifted where the scans disagree by more than the limit, or by more than 0.15 mm and "
      "four times what the\n"
      "calibration itself expects.\n"
      "Exit: 0 it holds; 1 it has drifted, or refused: it says what is missing; 2 bad input.");
  command.run([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace arcstart::command_line
