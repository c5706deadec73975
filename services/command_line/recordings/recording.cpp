#include "services/command_line/recordings/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace arcstart::command_line {
namespace {

constexpr std::array kStageKinds = {ChannelKind::kImage, ChannelKind::kStripe,
                                    ChannelKind::kProfile};

std::optional<Stage> stage_of(ChannelKind kind) {
  for (std::size_t i = 0; i < kStageKinds.size(); ++i)
    if (kStageKinds[i] == kind) return static_cast<Stage>(i);
  return std::nullopt;
}

// At equal times state comes before what it explains, positions before what they carry.
int rank_of(ChannelKind kind) {
  switch (kind) {
    case ChannelKind::kCalibration:
      return 0;
    case ChannelKind::kPose:
      return 1;
    case ChannelKind::kScan:
      return 3;
    default:
      return 2;
  }
}

std::string joined(const std::set<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Stage RecordedScan::stage() const {
  for (const Stage stage : {Stage::kImages, Stage::kStripes})
    if (messages[static_cast<std::size_t>(stage)] > 0) return stage;
  return Stage::kProfiles;
}

Recording::Recording(const std::vector<std::string>& paths, const std::string& sensor,
                     const std::string& robot) {
  if (paths.empty()) throw RecordingError("no recording is given");
  name_ = printable(paths.front());
  if (paths.size() > 1) name_ += fmt::format(" and {} more", paths.size() - 1);
  for (const auto& path : paths) logs_.emplace_back(path);
  // The order in which they are named must not matter.
  std::sort(logs_.begin(), logs_.end(), [](const EventLog& a, const EventLog& b) {
    return std::pair(a.entries().front().timestamp, a.path()) <
           std::pair(b.entries().front().timestamp, b.path());
  });
  for (const auto& log : logs_) {
    if (log.damage().empty()) continue;
    damaged_ = true;
    warnings_.push_back(
        fmt::format("{}: damaged, whole up to there: {}", printable(log.path()), log.damage()));
  }
  refuse_former_version();
  choose_instances(sensor, robot);
  for (std::size_t log = 0; log < logs_.size(); ++log)
    for (std::size_t entry = 0; entry < logs_[log].entries().size(); ++entry) take_in(log, entry);

  std::erase_if(scans_, [](const auto& entry) {
    // LASER0_SCAN goes on telling of a scan that ended before the recording began.
    const RecordedScan& scan = entry.second;
    return scan.messages == std::array<int, 3>{} && !scan.begun;
  });
}

// Each channel's first message tells: a recording of the version before would otherwise look like
// one of which every message is damaged.
void Recording::refuse_former_version() const {
  for (const auto& log : logs_) {
    std::set<std::string> looked_at;
    for (const auto& entry : log.entries()) {
      const ChannelKind kind = channel_kind(entry.channel);
      const bool is_read = is_measurement(kind) || kind == ChannelKind::kScan ||
                           kind == ChannelKind::kCalibration || kind == ChannelKind::kStatus;
      if (!is_read || !looked_at.insert(entry.channel).second) continue;
      const std::string former = former_type(log.read(entry, 8));
      if (!former.empty())
        throw RecordingError(fmt::format(
            "{}: is of the version before this one: {} holds the former {}: record it again, or "
            "replay it with the arcstart that made it",
            printable(log.path()), printable(entry.channel), former));
    }
  }
}

void Recording::choose_instances(const std::string& sensor, const std::string& robot) {
  std::set<std::string> sensors, robots;
  for (const auto& log : logs_)
    for (const auto& entry : log.entries()) {
      const ChannelKind kind = channel_kind(entry.channel);
      if (stage_of(kind) || kind == ChannelKind::kScan)
        sensors.insert(printable(channel_instance(entry.channel)));
      if (kind == ChannelKind::kPose) robots.insert(printable(channel_instance(entry.channel)));
    }
  if (sensors.empty())
    throw RecordingError(
        name_ +
        ": holds no scan: no channel of a sensor (LASER0_IMAGE, _STRIPE, _PROFILE or _SCAN)");
  if (!sensor.empty() && !sensors.contains(sensor))
    throw RecordingError(
        fmt::format("{}: holds nothing of sensor {}, but of {}", name_, sensor, joined(sensors)));
  if (sensor.empty() && sensors.size() > 1)
    throw RecordingError(fmt::format("{}: holds several sensors, {}: choose one with --sensor",
                                     name_, joined(sensors)));
  sensor_ = sensor.empty() ? *sensors.begin() : sensor;

  // The calibration knows which robot carries the sensor.
  robot_ = robot;
  for (const auto& log : logs_)
    for (const auto& entry : log.entries()) {
      calibration_t calibration;
      if (robot_.empty() && entry.channel == sensor_ + "_CALIBRATION" &&
          decode(log.read(entry), calibration).empty())
        robot_ = calibration.robot;
    }
  if (robot_.empty() && robots.size() == 1) robot_ = *robots.begin();
  if (robot_.empty()) robot_ = "ROBOT0";
}

void Recording::take_in(std::size_t log, std::size_t entry) {
  const EventEntry& event = logs_[log].entries()[entry];
  const ChannelKind kind = channel_kind(event.channel);
  const bool is_status = kind == ChannelKind::kStatus && event.channel.starts_with(sensor_ + "_");
  if (!is_status &&
      channel_instance(event.channel) != (kind == ChannelKind::kPose ? robot_ : sensor_))
    return;
  const RecordedMessage message{0, log, entry, 0};
  if (is_measurement(kind)) return take_measurement(kind, message);
  if (kind == ChannelKind::kScan) return take_scan(message);
  if (kind == ChannelKind::kCalibration) return take_calibration(message);
  if (is_status) return take_status(message);
}

void Recording::take_measurement(ChannelKind kind, RecordedMessage message) {
  const EventEntry& event = logs_[message.log].entries()[message.entry];
  Source source;
  const std::string error =
      read_source(kind, logs_[message.log].read(event, Source::kBytes), source);
  if (!error.empty()) return note_undecodable(event.channel, error);
  // Two loggers that ran at once hold the same message twice.
  if (logs_.size() > 1) {
    const auto [first, is_new] = seen_[kind].try_emplace({source.run_id, source.seq}, message.log);
    if (!is_new && first->second != message.log) return;
  }

  message.utime = source.utime;
  message.scan_id = source.scan_id;
  add(kind, message);
  if (kind == ChannelKind::kPose) newest_pose_ = std::max(newest_pose_, source.utime);
  const auto stage = stage_of(kind);
  if (!stage || source.scan_id <= 0) return;
  RecordedScan& scan = scans_[source.scan_id];
  scan.scan_id = source.scan_id;
  const auto index = static_cast<std::size_t>(*stage);
  ++scan.messages[index];
  scan.newest[index] = std::max(scan.newest[index], source.seq);
  scan.newest_utime = std::max(scan.newest_utime, source.utime);
}

void Recording::take_scan(RecordedMessage message) {
  const EventEntry& event = logs_[message.log].entries()[message.entry];
  scan_t state;
  if (const std::string error = decode(logs_[message.log].read(event), state); !error.empty())
    return note_undecodable(event.channel, error);
  message.utime = state.utime;
  message.scan_id = state.scan_id;
  add(ChannelKind::kScan, message);

  const auto note = [this](std::int64_t scan_id, std::int8_t kind, bool ended,
                           std::int64_t last_seq) {
    if (scan_id <= 0) return;
    RecordedScan& scan = scans_[scan_id];
    scan.scan_id = scan_id;
    scan.kind = kind;
    scan.begun |= !ended;
    if (!ended) return;
    scan.ended = true;
    scan.last_seq = last_seq;
  };
  note(state.previous_scan_id, state.previous_kind, true, state.previous_last_seq);
  if (state.state != scan_t::IDLE)
    note(state.scan_id, state.kind, state.state == scan_t::ENDED, state.last_seq);
}

void Recording::take_calibration(RecordedMessage message) {
  const EventEntry& event = logs_[message.log].entries()[message.entry];
  if (const std::string error =
          message_error(ChannelKind::kCalibration, logs_[message.log].read(event));
      !error.empty())
    return note_undecodable(event.channel, error);
  // Its own utime is when it was made. The first is in force from the beginning, as for any process
  // that starts late.
  const bool is_first = !has(ChannelKind::kCalibration);
  message.utime = is_first ? std::numeric_limits<std::int64_t>::min() : event.timestamp;
  add(ChannelKind::kCalibration, message);
}

void Recording::take_status(const RecordedMessage& message) {
  const EventEntry& event = logs_[message.log].entries()[message.entry];
  service_status_t status;
  if (const std::string error = decode(logs_[message.log].read(event), status); !error.empty())
    return note_undecodable(event.channel, error);
  take_jobs(status);
  const auto [stated, is_new] = configurations_.try_emplace(status.service, status.configuration);
  if (is_new || stated->second == status.configuration) return;
  stated->second = status.configuration;
  warnings_.push_back(fmt::format("{}: the configuration of {} changed in it; the last one is used",
                                  name_, printable(status.service)));
}

// Cuts off what held for the newest scans alone, and adds it to what the recording states of all.
void Recording::take_jobs(service_status_t& status) {
  const std::string begin = "jobs_of_scans:\n";
  const auto at = status.configuration.rfind("\n" + begin);
  if (status.service != "seam_finding" || at == std::string::npos) return;
  const std::string section = status.configuration.substr(at + 1);
  status.configuration.resize(at + 1);
  try {
    const auto stated = Configuration::from_text(section, name_ + ": seam_finding's STATUS")
                            .read<seam_finding::JobsOfScans>("jobs_of_scans");
    const std::size_t count = std::min(
        {stated.scan_id.size(), stated.name.size(), stated.text.size(), stated.refusal.size()});
    for (std::size_t i = 0; i < count; ++i)
      jobs_of_scans_[stated.scan_id[i]] = {stated.name[i], stated.text[i], stated.refusal[i]};
  } catch (const ConfigurationError& error) {
    warnings_.push_back(printable(error.what()));
  }
}

seam_finding::JobsOfScans Recording::jobs_of_scans() const {
  seam_finding::JobsOfScans all;
  for (const auto& [scan_id, job] : jobs_of_scans_) {
    all.scan_id.push_back(scan_id);
    all.name.push_back(job[0]);
    all.text.push_back(job[1]);
    all.refusal.push_back(job[2]);
  }
  return all;
}

void Recording::add(ChannelKind kind, const RecordedMessage& message) {
  RecordedStream& stream = streams_[kind][message.log];
  stream.rank = rank_of(kind);
  stream.messages.push_back(message);
}

std::vector<RecordedMessage> Recording::sources(
    const std::function<bool(const RecordedScan&)>& is_wanted) const {
  Stage first = Stage::kProfiles;
  for (const auto& [id, scan] : scans_) first = std::min(first, scan.stage());
  const auto wanted = [&](ChannelKind kind, const RecordedMessage& message) {
    if (kind == ChannelKind::kCalibration || kind == ChannelKind::kPose) return true;
    // Outside the scans: what tells that one has ended, where its last image was lost.
    if (message.scan_id == 0 && stage_of(kind)) return stage_of(kind) == first;
    const auto scan = scans_.find(message.scan_id);
    if (scan == scans_.end()) return kind == ChannelKind::kScan;
    return is_wanted(scan->second) &&
           (kind == ChannelKind::kScan || stage_of(kind) == scan->second.stage());
  };
  std::vector<RecordedStream> chosen;
  for (const auto& [kind, streams] : streams_)
    for (const auto& [log, stream] : streams) {
      RecordedStream& part = chosen.emplace_back(RecordedStream{stream.rank, {}});
      for (const auto& message : stream.messages)
        if (wanted(kind, message)) part.messages.push_back(message);
    }
  return merge_by_event_time(chosen);
}

const std::string& Recording::channel(const RecordedMessage& message) const {
  return logs_[message.log].entries()[message.entry].channel;
}

std::vector<std::uint8_t> Recording::read(const RecordedMessage& message) const {
  return logs_[message.log].read(logs_[message.log].entries()[message.entry]);
}

std::optional<std::string> Recording::configuration(const std::string& service) const {
  const auto stated = configurations_.find(service);
  if (stated == configurations_.end()) return std::nullopt;
  return stated->second;
}

void Recording::note_undecodable(const std::string& channel, const std::string& why) {
  Undecodable& noted = undecodable_[channel];
  if (noted.count++ == 0) noted.why = why;
}

}  // namespace arcstart::command_line
