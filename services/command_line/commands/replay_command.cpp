#include "services/command_line/commands/replay_command.hpp"

#include <fmt/core.h>

#include <iostream>
#include <memory>

#include "common/options.hpp"
#include "services/command_line/output/scan_pictures.hpp"
#include "services/command_line/output/seam_json.hpp"
#include "services/command_line/output/terminal.hpp"
#include "services/command_line/recordings/answer_file.hpp"
#include "services/command_line/recordings/replay.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::command_line {
namespace {

struct ReplayCommandOptions {
  std::vector<std::string> paths;
  ReplayOptions replay;
  std::string pictures, seams;
  bool json = false, print_channels = false, print_settings = false;
};

std::string point(const double numbers[3], int decimals) {
  return fmt::format("({:.{}f}, {:.{}f}, {:.{}f})", numbers[0], decimals, numbers[1], decimals,
                     numbers[2], decimals);
}

std::string words(const ReplayedSeam& replayed) {
  const seam_t& seam = replayed.seam;
  std::string line =
      fmt::format("{} scan {}: ", replayed.kind == scan_t::BACKGROUND ? "background" : "workpiece",
                  seam.scan_id);
  switch (seam.verdict) {
    case seam_t::FOUND:
      line +=
          fmt::format("found {}, start {} mm, end {} mm, direction {}", printable(seam.joint_type),
                      point(seam.start, 3), point(seam.end, 3), point(seam.direction, 5));
      return seam.remark.empty() ? line : line + "; " + printable(seam.remark);
    case seam_t::BACKGROUND_STORED:
      return line + "stored";
    case seam_t::AMBIGUOUS:
      return line + "ambiguous: " + printable(seam.reason);
    default:
      return line + "refused: " + printable(seam.reason);
  }
}

void print(const ReplayResult& result, bool as_json) {
  for (const auto& warning : result.warnings) std::cerr << "replay: " << warning << "\n";
  for (const auto& seam : result.seams) {
    std::cerr << words(seam) << "\n";
    if (as_json) std::cout << seam_to_json_line(seam.seam) << "\n";
  }
  for (const auto& scan : result.unanswered)
    std::cerr << fmt::format("{} scan {}: no answer: {}\n",
                             !scan.kind                         ? "unknown"
                             : *scan.kind == scan_t::BACKGROUND ? "background"
                                                                : "workpiece",
                             scan.scan_id, scan.why);
  if (!result.has_workpiece())
    std::cerr << "replay: a recording of the background alone, no workpiece scan in it\n";
}

int run(ReplayCommandOptions& options) {
  if (options.print_channels) {
    std::cout << source_channels(options.paths, options.replay) << "\n";
    return 0;
  }
  if (options.print_settings) {
    std::cout << replay_settings(options.paths, options.replay);
    return 0;
  }
  ProgressLine progress;
  options.replay.on_progress = [&](double share) {
    progress.show(fmt::format("replaying {:.0f} %", 100 * share));
  };
  std::optional<ScanPictures> pictures;
  if (!options.pictures.empty()) {
    const auto settings =
        Configuration::from_text(replay_settings(options.paths, options.replay), "recording");
    pictures.emplace(options.pictures,
                     settings.read<seam_finding::SeamFindingSettings>("seam_finding"));
    options.replay.on_bus = [&](Bus& bus, const std::string& sensor) {
      pictures->listen(bus, sensor);
    };
  }
  const ReplayResult result = replay_recordings(options.paths, options.replay);
  progress.clear();
  print(result, options.json);
  if (!options.seams.empty()) write_answers(options.seams, result.seams);
  if (pictures) std::cerr << options.pictures << ": " << pictures->write() << "\n";
  return result.is_good() ? 0 : 1;
}

}  // namespace

void add_replay_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<ReplayCommandOptions>();
  Command command(parent, "replay", "Run the whole pipeline on recordings and tell each SEAM");
  command.option("LOG", options->paths, "Recordings by lcm-logger, merged by event time")
      .required();
  command.flag("--json", options->json,
               "Print each SEAM on standard output, one object a line (mm and rad)");
  command.option(
      "--cell", options->replay.cell,
      "The cell's file, cell.yaml, whose settings are to be used; without it those that the "
      "recording's STATUS states");
  command
      .option("--pictures", options->pictures,
              "Folder for what a person can look at: of the last workpiece scan cloud.pcd, "
              "cloud.ply, cloud.png and stripe.png, and of each whose stripes contradict the seam "
              "contradiction_SCANID.png: what they must show of its plates, and what they do")
      .existing_folder();
  command.option("--seams", options->seams,
                 "File for the encoded seam_t of every scan answered, in order, to compare two "
                 "builds by: of each its length (4 bytes, little-endian) and its bytes");
  command.option("--background", options->replay.background,
                 "Recording of a background scan, to be used in place of those in LOG");
  command.option("--sensor", options->replay.sensor,
                 "Sensor to replay, needed where LOG holds several");
  command.option("--robot", options->replay.robot,
                 "Robot that carries it; without it the calibration's");
  command
      .flag("--print-source-channels", options->print_channels,
            "Only print the channels with which replay begins, as a regular expression, and end")
      .for_scripts();
  command
      .flag("--print-settings", options->print_settings,
            "Only print the settings that replay would use, as a cell.yaml, and end")
      .for_scripts();
  command.footer(
      "Begins with each scan's images where they were recorded, else with its stripes, else with "
      "its profiles;\n"
      "what was derived from them and recorded beside them is computed anew. Calibration and, "
      "without --background,\n"
      "the background scan come from the recording. The same recording gives the same bytes.\n"
      "Exit: 0 every workpiece scan found, or backgrounds alone, all stored; 1 not; 2 bad input.");
  command.run([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace arcstart::command_line
