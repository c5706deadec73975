#include "services/command_line/recordings/recorded_sweeps.hpp"

#include <fmt/core.h>

#include <iostream>

#include "common/bus/calibration_message.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/command_line/output/terminal.hpp"
#include "services/command_line/recordings/recording.hpp"
#include "services/extraction/extraction_app.hpp"

namespace arcstart::command_line {
namespace {

calibration::SweepProfile swept_stripe(const stripe_t& message) {
  calibration::SweepProfile stripe{message.utime, message.scan_id, {}};
  std::optional<std::int16_t> last;
  for (std::size_t i = 0; i < message.u.size(); ++i) {
    if (message.rank[i] != stripe_t::CHOSEN) continue;
    if (last != message.segment[i]) stripe.segments.emplace_back();
    last = message.segment[i];
    stripe.segments.back().push_back({message.u[i], message.v[i]});
  }
  return stripe;
}

extraction::ExtractionSettings extraction_settings(const Recording& recording) {
  const auto text = recording.configuration("extraction");
  return (text ? Configuration::from_text(*text, recording.name()) : Configuration())
      .read<extraction::ExtractionSettings>("extraction");
}

}  // namespace

RecordedSweeps read_sweeps(const std::vector<std::string>& paths, const std::string& sensor,
                           const std::string& robot,
                           const std::function<void(double share)>& on_progress) {
  Recording recording(paths, sensor, robot);
  RecordedSweeps sweeps;
  sweeps.name = recording.name();
  sweeps.sensor = recording.sensor();
  sweeps.robot = recording.robot();
  const Instance instance{recording.sensor(), recording.robot(), ""};
  const auto bus = Bus::in_memory();
  extraction::ExtractionApp extraction(*bus, extraction_settings(recording), instance);
  int positions = 0;
  bus->subscribe<stripe_t>(instance.sensor_channel("STRIPE"), Queue::measurements(),
                           [&](const stripe_t& message) {
                             if (message.why == stripe_t::NONE)
                               sweeps.record.stripes.push_back(swept_stripe(message));
                           });
  bus->subscribe<robot_pose_t>(
      instance.robot_channel("POSE"), Queue::measurements(), [&](const robot_pose_t& message) {
        if (!message.invalid.empty()) return;
        ++positions;
        sweeps.record.trajectory.insert(
            message.utime, transform_from_arrays(message.position, message.quaternion));
      });
  bus->subscribe<calibration_t>(
      instance.sensor_channel("CALIBRATION"), Queue::measurements(),
      [&](const calibration_t& message) {
        try {
          sweeps.calibration = calibration_from_message(message);
        } catch (const CalibrationError& error) {
          sweeps.warnings.push_back(fmt::format("{}: its calibration {} cannot be used: {}",
                                                sweeps.name, printable(message.id), error.what()));
        }
      });
  const auto messages = recording.sources([](const RecordedScan&) { return true; });
  std::size_t done = 0;
  for (const RecordedMessage& message : messages) {
    on_progress(static_cast<double>(++done) / static_cast<double>(messages.size()));
    const std::string& channel = recording.channel(message);
    const auto bytes = recording.read(message);
    if (const std::string error = message_error(channel_kind(channel), bytes); !error.empty())
      recording.note_undecodable(channel, error);
    else
      bus->publish_bytes(channel, bytes);
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
  }
  const auto lacks = [&](const std::string& channel, const char* what) {
    throw RecordingError(fmt::format("{}: lacks {}: {}", sweeps.name, channel, what));
  };
  if (sweeps.record.stripes.empty())
    lacks(sweeps.sensor + "_STRIPE and _IMAGE", "no stripe of a scan is in it");
  if (positions == 0) lacks(sweeps.robot + "_POSE", "without the robot's way no sweep can be told");
  for (const std::string& warning : recording.warnings()) sweeps.warnings.push_back(warning);
  return sweeps;
}

void SweepOptions::add_to(Command& command) {
  command.option("LOG", paths, "Recordings by lcm-logger, of one scan or several").required();
  command
      .option("--calibration", calibration,
              "The sensor's calibration file; without it the recording's")
      .existing_file();
  command.option("--sensor", sensor, "Needed where LOG holds several");
  command.option("--robot", robot, "That carries it; without it the calibration's");
}

JudgedSweeps read_judged_sweeps(const SweepOptions& options, const std::string& command) {
  ProgressLine progress;
  JudgedSweeps judged{
      read_sweeps(options.paths, options.sensor, options.robot,
                  [&](double share) {
                    progress.show(fmt::format("{}: reading {:.0f} %", command, 100 * share));
                  }),
      {}};
  progress.clear();
  const RecordedSweeps& sweeps = judged.sweeps;
  for (const std::string& warning : sweeps.warnings)
    std::cerr << command << ": " << warning << "\n";
  if (options.calibration.empty() && !sweeps.calibration)
    throw RecordingError(sweeps.name +
                         ": holds no calibration: give the sensor's with --calibration");
  judged.calibration = options.calibration.empty()
                           ? *sweeps.calibration
                           : calibration::read_calibration_file(options.calibration);
  if (const auto error = instance_error(judged.calibration, sweeps.sensor, sweeps.robot);
      !error.empty())
    throw RecordingError("the calibration does not fit the recording: " + error);
  return judged;
}

}  // namespace arcstart::command_line
