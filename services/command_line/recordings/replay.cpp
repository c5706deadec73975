#include "services/command_line/recordings/replay.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <set>

#include "common/jobs/job_file.hpp"
#include "services/extraction/extraction_app.hpp"
#include "services/reconstruction/reconstruction_app.hpp"
#include "services/seam_finding/seam_finding_app.hpp"

namespace arcstart::command_line {
namespace {

// The settings of the three stages, each as the recording states it or as the cell's file does.
struct Settings {
  extraction::ExtractionSettings extraction;
  reconstruction::ReconstructionSettings reconstruction;
  seam_finding::SeamFindingSettings seam_finding;
  // Of the jobs: the cell's sections with --cell, else what the recording states.
  Configuration jobs;
  std::string jobs_text;
};

// The earliest stage of any of its scans.
Stage first_stage(const Recording& recording) {
  Stage first = Stage::kProfiles;
  for (const auto& [id, scan] : recording.scans()) first = std::min(first, scan.stage());
  return first;
}

seam_finding::JobsOfScans jobs_of(const Recording& recording, const Recording* background) {
  seam_finding::JobsOfScans all = recording.jobs_of_scans();
  if (!background) return all;
  const auto append = [](std::vector<std::string>& to, const std::vector<std::string>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  const seam_finding::JobsOfScans more = background->jobs_of_scans();
  append(all.scan_id, more.scan_id);
  append(all.name, more.name);
  append(all.text, more.text);
  append(all.refusal, more.refusal);
  return all;
}

Settings read_settings(const Recording& recording, const Recording* background, Stage first,
                       const std::string& cell, std::vector<std::string>& warnings) {
  const auto configuration_of = [&](const std::string& service) {
    if (!cell.empty()) return Configuration::from_file(cell);
    const auto text = recording.configuration(service);
    std::string channel = recording.sensor() + "_" + service + "_STATUS";
    std::transform(channel.begin(), channel.end(), channel.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    if (text) return Configuration::from_text(*text, recording.name() + ": " + channel);
    warnings.push_back(fmt::format(
        "{}: lacks channel {}: {} runs with its default settings; give others with --cell",
        recording.name(), channel, service));
    return Configuration();
  };
  Settings settings;
  if (first == Stage::kImages)
    settings.extraction =
        configuration_of("extraction").read<extraction::ExtractionSettings>("extraction");
  if (first != Stage::kProfiles)
    settings.reconstruction = configuration_of("reconstruction")
                                  .read<reconstruction::ReconstructionSettings>("reconstruction");
  const Configuration of_seam_finding = configuration_of("seam_finding");
  settings.seam_finding = of_seam_finding.read<seam_finding::SeamFindingSettings>("seam_finding");
  if (!cell.empty()) {
    settings.jobs = Configuration::from_file(cell);
    return settings;
  }
  // Whether the cell had jobs stands in its own section, not in what held for single scans.
  if (of_seam_finding.has("jobs"))
    settings.jobs_text = write_settings("jobs", of_seam_finding.read<JobsSettings>("jobs"));
  settings.jobs_text += write_settings("jobs_of_scans", jobs_of(recording, background));
  settings.jobs = Configuration::from_text(settings.jobs_text, recording.name());
  return settings;
}

// The apps on their bus.
class Pipeline {
 public:
  Pipeline(const Settings& settings, const Instance& instance)
      : extraction_(*bus_, settings.extraction, instance),
        reconstruction_(*bus_, settings.reconstruction, instance),
        seam_finding_(*bus_, settings.seam_finding, instance,
                      seam_finding::JobBook(settings.jobs, settings.seam_finding)) {
    bus_->subscribe<seam_t>(instance.sensor_channel("SEAM"), Queue::measurements(),
                            [this](const seam_t& seam) { take_seam(seam); });
  }

  // Feeds the messages, each followed by all that it moves.
  void run(Recording& recording, const std::vector<RecordedMessage>& messages,
           const std::function<void(std::size_t)>& on_message) {
    for (const auto& message : messages) {
      const std::string& channel = recording.channel(message);
      const auto bytes = recording.read(message);
      if (const std::string error = message_error(channel_kind(channel), bytes); !error.empty())
        recording.note_undecodable(channel, error);
      else
        bus_->publish_bytes(channel, bytes);
      while (bus_->handle(std::chrono::milliseconds(0))) {
      }
      on_message(1);
    }
  }

  struct Answer {
    seam_t seam;
    std::vector<std::uint8_t> bytes;
    bool changed = false;  // sent again with other bytes
  };
  const std::vector<Answer>& answers() const { return answers_; }
  Bus& bus() { return *bus_; }

 private:
  // Repetitions are byte for byte the same.
  void take_seam(const seam_t& seam) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(seam.getEncodedSize()));
    seam.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    for (auto& answer : answers_) {
      if (answer.seam.scan_id != seam.scan_id) continue;
      answer.changed |= answer.bytes != bytes;
      return;
    }
    answers_.push_back({seam, std::move(bytes)});
  }

  std::unique_ptr<Bus> bus_ = Bus::in_memory();
  extraction::ExtractionApp extraction_;
  reconstruction::ReconstructionApp reconstruction_;
  seam_finding::SeamFindingApp seam_finding_;
  std::vector<Answer> answers_;
};

bool is_background(const RecordedScan& scan) { return scan.kind == scan_t::BACKGROUND; }

// The recording given with --background, and which of its scans serve: those before all scans of
// the recording.
struct GivenBackground {
  Recording recording;
  std::set<std::int64_t> scans;
};

GivenBackground open_background(const ReplayOptions& options, const Recording& recording) {
  GivenBackground given{Recording({options.background}, recording.sensor(), recording.robot()), {}};
  given.recording.require_channels();
  bool any = false;
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  for (const auto& [id, scan] : recording.scans())
    if (!is_background(scan)) first = std::min(first, id);
  for (const auto& [id, scan] : given.recording.scans()) {
    if (!is_background(scan) || !scan.ended) continue;
    any = true;
    if (id < first) given.scans.insert(id);
  }
  const std::string& name = given.recording.name();
  if (!any) throw RecordingError(name + ": holds no whole background scan");
  if (given.scans.empty())
    throw RecordingError(fmt::format(
        "{}: its background scan is later than scan {} of {}, a background comes before", name,
        first, recording.name()));
  return given;
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

bool ReplayResult::has_workpiece() const {
  // A scan of unknown kind may have been one.
  return std::any_of(seams.begin(), seams.end(),
                     [](const auto& s) { return s.kind == scan_t::WORKPIECE; }) ||
         std::any_of(unanswered.begin(), unanswered.end(),
                     [](const auto& s) { return s.kind != scan_t::BACKGROUND; });
}

bool ReplayResult::is_good() const {
  const bool of_workpiece = has_workpiece();
  for (const auto& scan : unanswered)
    if (!of_workpiece || scan.kind != scan_t::BACKGROUND) return false;
  for (const auto& [kind, seam, bytes] : seams)
    if ((kind == scan_t::WORKPIECE) == of_workpiece &&
        seam.verdict != (of_workpiece ? seam_t::FOUND : seam_t::BACKGROUND_STORED))
      return false;
  return !seams.empty();
}

ReplayResult replay_recordings(const std::vector<std::string>& paths,
                               const ReplayOptions& options) {
  Recording recording(paths, options.sensor, options.robot);
  recording.require_channels();
  std::optional<GivenBackground> background;
  if (!options.background.empty()) background = open_background(options, recording);

  ReplayResult result;
  result.sensor = recording.sensor();
  result.robot = recording.robot();
  const Stage first = background
                          ? std::min(first_stage(recording), first_stage(background->recording))
                          : first_stage(recording);
  const Settings settings = read_settings(recording, background ? &background->recording : nullptr,
                                          first, options.cell, result.warnings);
  Pipeline pipeline(settings, Instance{recording.sensor(), recording.robot(), ""});
  options.on_bus(pipeline.bus(), recording.sensor());

  const auto before = background ? background->recording.sources([&](const RecordedScan& scan) {
    return background->scans.contains(scan.scan_id);
  })
                                 : std::vector<RecordedMessage>{};
  const auto wanted = [&](const RecordedScan& scan) { return !background || !is_background(scan); };
  const auto messages = recording.sources(wanted);
  std::size_t done = 0;
  const auto on_message = [&](std::size_t count) {
    done += count;
    options.on_progress(static_cast<double>(done) /
                        static_cast<double>(before.size() + messages.size()));
  };
  if (background) pipeline.run(background->recording, before, on_message);
  pipeline.run(recording, messages, on_message);

  std::set<std::int64_t> answered;
  for (const auto& answer : pipeline.answers()) {
    const std::int64_t id = answer.seam.scan_id;
    if (answer.changed)
      result.warnings.push_back(fmt::format("scan {}: was answered twice, differently", id));
    const auto scan = recording.scans().find(id);
    if (scan != recording.scans().end() && wanted(scan->second)) {
      answered.insert(id);
      result.seams.push_back(
          {scan->second.kind.value_or(scan_t::WORKPIECE), answer.seam, answer.bytes});
    } else if (background && answer.seam.verdict != seam_t::BACKGROUND_STORED) {
      result.warnings.push_back(fmt::format("{}: scan {}: {}", background->recording.name(), id,
                                            printable(answer.seam.reason)));
    }
  }
  for (const auto& [id, scan] : recording.scans()) {
    if (!wanted(scan))
      result.warnings.push_back(
          fmt::format("{}: its background scan {} is left out, that of {} is used",
                      recording.name(), id, background->recording.name()));
    else if (!answered.contains(id))
      result.unanswered.push_back({id, scan.kind, recording.why_unanswered(scan)});
  }
  if (recording.is_damaged() && result.seams.empty())
    throw RecordingError(recording.warnings().front() + "; no scan before it is whole");

  if (background) append(result.warnings, background->recording.warnings());
  append(result.warnings, recording.warnings());
  if (pipeline.bus().undecodable() > 0)
    result.warnings.push_back("a stage failed: " + pipeline.bus().last_error());
  result.undecodable =
      recording.undecodable() + (background ? background->recording.undecodable() : 0);
  return result;
}

std::string source_channels(const std::vector<std::string>& paths, const ReplayOptions& options) {
  const Recording recording(paths, options.sensor, options.robot);
  recording.require_channels();
  if (recording.is_damaged())
    throw RecordingError(recording.warnings().front() +
                         "; lcm-logplayer may crash on it, 'arcstart replay' plays what is whole");
  const std::string& sensor = recording.sensor();
  const Stage first = first_stage(recording);
  std::string channels = sensor + "_SCAN|" + sensor + "_CALIBRATION|";
  if (first != Stage::kProfiles) channels += recording.robot() + "_POSE|";
  channels += sensor + (first == Stage::kImages    ? "_IMAGE"
                        : first == Stage::kStripes ? "_STRIPE"
                                                   : "_PROFILE");
  return "(" + channels + ")";
}

std::string replay_settings(const std::vector<std::string>& paths, const ReplayOptions& options) {
  const Recording recording(paths, options.sensor, options.robot);
  recording.require_channels();
  std::vector<std::string> warnings;
  const Settings settings =
      read_settings(recording, nullptr, first_stage(recording), options.cell, warnings);
  return write_settings("extraction", settings.extraction) +
         write_settings("reconstruction", settings.reconstruction) +
         write_settings("seam_finding", settings.seam_finding) + settings.jobs_text;
}

}  // namespace arcstart::command_line
