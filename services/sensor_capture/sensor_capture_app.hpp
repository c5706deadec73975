// Frames on the bus, in scans or as camera commands ask; the scans' state; the laser's order.
#pragma once

#include <arcstart/camera_command_t.hpp>
#include <arcstart/image_t.hpp>
#include <arcstart/robot_pose_t.hpp>
#include <arcstart/scan_command_t.hpp>
#include <arcstart/scan_t.hpp>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "common/clock_mapping.hpp"
#include "common/service.hpp"
#include "services/sensor_capture/clock_probes.hpp"
#include "services/sensor_capture/frames/frame_source.hpp"
#include "services/sensor_capture/frames/settings_timeline.hpp"
#include "services/sensor_capture/scan/scan_owner.hpp"
#include "services/sensor_capture/sensor_capture_settings.hpp"

namespace arcstart::sensor_capture {

class SensorCaptureApp : public App {
 public:
  // The bus outlives the app. Starts the source.
  SensorCaptureApp(Bus& bus, const SensorCaptureSettings& settings, const Instance& instance,
                   std::int64_t run_id, std::unique_ptr<FrameSource> source);
  ~SensorCaptureApp() override;  // laser off

  void tick(std::int64_t now_utime) override;
  Health health() const override;

 private:
  struct CommandedImages {
    std::int64_t command_id;
    CameraSettings settings;
    std::int64_t ticket;  // of the request for these settings
    int left;
    std::int64_t latest_utime;  // by when it is given up
    std::int64_t heard;         // last; steady, us
  };

  void take(Frame& frame, std::int64_t now);
  void take(const CameraFound& found, std::int64_t now);
  void take(const CameraLost& lost, std::int64_t now);
  void take(const SettingsApplied& applied, std::int64_t now);
  void take_scan_command(const scan_command_t& command);
  void take_camera_command(const camera_command_t& command);
  void end_command(const std::string& why);

  CameraSettings wanted_settings() const;
  bool is_unattended() const;
  std::string laser_state() const;
  void ask_for(const CameraSettings& settings, std::int64_t now);
  void follow_scan(std::int64_t now);
  void publish_image(image_t& image, Frame& frame, const Membership& membership,
                     std::int64_t command_id);
  void publish_end(image_t image);
  void publish_scan(std::int64_t now);

  Bus& bus_;
  SensorCaptureSettings settings_;
  Instance instance_;
  std::int64_t run_id_;
  std::unique_ptr<FrameSource> source_;
  ClockMapping clock_;
  ClockProbes probes_;
  SettingsTimeline timeline_;
  ScanOwner owner_;

  bool found_ = false;
  bool wired_laser_ = false;
  bool lit_ = false;  // asked for and not yet known to be dark
  std::string camera_trouble_ = "the camera has not been found yet";
  bool starting_ = true;
  std::int64_t last_ticket_ = 0;
  std::optional<CameraSettings> asked_;  // last; nothing where it is not known
  std::optional<CommandedImages> command_;
  std::deque<std::int64_t> known_commands_;

  image_t newest_image_{};  // without its bytes
  int ends_left_ = 0;       // to be sent of the scan that runs, or has ended last

  std::int64_t next_preview_ = 0, next_scan_state_ = 0;  // steady; us
  std::int64_t told_revision_ = -1;
  std::string error_;             // told for a while
  std::int64_t error_until_ = 0;  // steady; us
};

// The whole main of arcstart-sensor-capture.
int run(int argc, char** argv);

}  // namespace arcstart::sensor_capture
