// Section `cell_simulator` of cell.yaml: this and the keys of scene_settings.hpp and
// sensor_settings.hpp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/configuration.hpp"
#include "services/cell_simulator/image/sensor_settings.hpp"
#include "services/cell_simulator/scene/scene_settings.hpp"

namespace arcstart::cell_simulator {

struct CellSimulatorSettings {
  SceneSettings scene;
  SensorSettings sensor;

  std::string scene_at_start = "background";  // background or workpiece
  int seed = 1;                               // of scene, noise and phase of the trigger
  // A scene of the wild in place of those of scene_settings.hpp: drawn by this number for `joint`;
  // 0: none. Or read from a file of JSON (wild/wild_json.hpp). It brings its own search, lean and
  // pitch; cell commands change what of it stands there, not the scene.
  int wild_seed = 0;
  std::string wild_file = "";
  std::string calibration_file =
      "";  // the true calibration is written there at start; empty: nowhere

  // The camera: GigE Vision, device Aravis-Fake-<serial>, control port UDP 3956.
  std::string camera_interface = "127.0.0.1";
  std::string camera_serial = "CELL01";
  double frame_rate_hz = 14;      // until the client sets another
  double image_delay_ms = 27.32;  // begin of the exposure to the first packet's arrival at the host
  double transport_ms = 0.08;     // of that, what the network takes; measured on loopback
  double camera_clock_start_s = 4321;  // what the camera's clock shows when the simulator starts
  double camera_clock_drift_ppm = 12;  // above 0: it runs fast

  // The robot: FANUC M-20iA, HSPO (R891) over UDP. The same arm also speaks J519 and RTDE where
  // these have a port, for `robot_pose: protocol`.
  std::string hspo_host = "127.0.0.1";  // where its packets go
  int hspo_port = 60015;
  double hspo_period_ms = 20;
  double hspo_tick_us = 1;  // of the controller's clock
  bool hspo_joints = true;  // beside the tool centre point, in the same packet
  int j519_port = 0;        // at 127.0.0.1; 0: not served
  int j519_version = 4;     // the newest that it has: 3 or 4
  bool j519_tool = true;    // positions of the tool centre point, else of the flange
  int rtde_port = 0;        // at 127.0.0.1; 0: not served
  // FANUC's RMI beside them, with the robot's own program, which asks as soon as work is put in.
  int rmi_port = 0;  // at 127.0.0.1; 0: not served, and no program runs
  double rmi_request_ms = 66;
  std::array<double, 6> rmi_frame{};  // UFRAME[1]: X Y Z mm, W P R deg. UTOOL[1] is the tool
  double rmi_tool_off_mm = 0;         // by which UTOOL[1] is wrong, along the flange's z
  double position_noise_mm = 0.02;    // standard deviation on x, y and z each
  double robot_clock_start_s = 1234;
  double robot_clock_drift_ppm = -9;
  // How far the controller is wrong in a pose of the calibration: standard deviations an axis, of
  // the place in base and of the turn about the tool centre point, drawn anew for each.
  double robot_error_mm = 0;
  double robot_error_deg = 0;
  std::string tool = "TCP1";  // name of the tool frame, for the calibration file
  std::array<double, 3> tool_mm{31.5, -4.2, 297.8};  // tool centre point in the flange frame tool0
  std::array<double, 3> tool_wpr_deg{1.3, 28.4, -2.1};  // W, P, R of the tool there

  // The search, along the taught positions of the scene's settings.
  double search_speed_mm_s = 50;
  double return_speed_mm_s = 500;
  double acceleration_mm_s2 = 1000;
  double search_delay_s = 0.5;  // a scan's begin to the search's, at least
  // Speeds of further sweeps, back and to again, in the same scan; for `arcstart time-offset`.
  std::vector<double> further_sweeps_mm_s;

  // Faults, for tests: all begin so long after the begin of that scan.
  int fault_scan = 0;        // which scan since start, 1 for the first; 0: none
  double fault_after_s = 1;  // from its begin
  int fault_lose_every =
      0;  // frames: each so many-th is lost at the camera, to the scan's end; 0: none
  double fault_camera_away_s = 0;       // the camera leaves the network for so long
  double fault_robot_silent_s = 0;      // positions are lost for so long
  double fault_robot_clock_back_s = 0;  // the controller's clock goes back by so much

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("scene", scene_at_start, one_of({"background", "workpiece"}));
    visitor("seed", seed, not_negative());
    visitor("wild_seed", wild_seed, not_negative());
    visitor("wild_file", wild_file);
    visitor("calibration_file", calibration_file);
    visitor("camera_interface", camera_interface);
    visitor("camera_serial", camera_serial, [](const std::string& serial) -> std::string {
      return !serial.empty() && serial.size() < 16 ? "" : "must have 1 to 15 characters";
    });
    visitor("frame_rate_hz", frame_rate_hz, between(0.5, 100));
    visitor("image_delay_ms", image_delay_ms, between(0, 100));
    visitor("transport_ms", transport_ms, between(0, 10));
    visitor("camera_clock_start_s", camera_clock_start_s, between(0, 1e9));
    visitor("camera_clock_drift_ppm", camera_clock_drift_ppm, between(-1000, 1000));
    visitor("hspo_host", hspo_host);
    visitor("hspo_port", hspo_port, between(1, 65535));
    visitor("hspo_period_ms", hspo_period_ms, between(1, 1000));
    visitor("hspo_tick_us", hspo_tick_us, between(0.1, 100000));
    visitor("hspo_joints", hspo_joints);
    visitor("j519_port", j519_port, between(0, 65535));
    visitor("j519_version", j519_version, between(1, 4));
    visitor("j519_tool", j519_tool);
    visitor("rtde_port", rtde_port, between(0, 65535));
    visitor("rmi_port", rmi_port, between(0, 65535));
    visitor("rmi_request_ms", rmi_request_ms, between(0, 10000));
    visitor("rmi_frame", rmi_frame);
    visitor("rmi_tool_off_mm", rmi_tool_off_mm, between(-100, 100));
    visitor("position_noise_mm", position_noise_mm, between(0, 10));
    visitor("robot_clock_start_s", robot_clock_start_s, between(0, 1e9));
    visitor("robot_clock_drift_ppm", robot_clock_drift_ppm, between(-1000, 1000));
    visitor("robot_error_mm", robot_error_mm, between(0, 10));
    visitor("robot_error_deg", robot_error_deg, between(0, 5));
    visitor("tool", tool);
    visitor("tool_mm", tool_mm);
    visitor("tool_wpr_deg", tool_wpr_deg);
    visitor("search_speed_mm_s", search_speed_mm_s, between(0.1, 1000));
    visitor("return_speed_mm_s", return_speed_mm_s, between(1, 2000));
    visitor("acceleration_mm_s2", acceleration_mm_s2, between(10, 20000));
    visitor("search_delay_s", search_delay_s, between(0.3, 60));
    visitor("further_sweeps_mm_s", further_sweeps_mm_s,
            [](const std::vector<double>& speeds) -> std::string {
              for (const double speed : speeds)
                if (!(speed >= 0.1 && speed <= 1000)) return "must lie between 0.1 and 1000";
              return speeds.size() <= 24 ? "" : "must be 24 speeds at most";
            });
    visitor("fault_scan", fault_scan, not_negative());
    visitor("fault_after_s", fault_after_s, between(0, 600));
    visitor("fault_lose_every", fault_lose_every, not_negative());
    visitor("fault_camera_away_s", fault_camera_away_s, between(0, 600));
    visitor("fault_robot_silent_s", fault_robot_silent_s, between(0, 600));
    visitor("fault_robot_clock_back_s", fault_robot_clock_back_s, between(0, 600));
    scene.visit(visitor);
    sensor.visit(visitor);
  }
};

}  // namespace arcstart::cell_simulator
