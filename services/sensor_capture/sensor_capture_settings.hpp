// Section `sensor_capture` of cell.yaml.
#pragma once

#include <string>

#include "common/configuration.hpp"

namespace arcstart::sensor_capture {

struct SensorCaptureSettings {
  std::string source = "camera";  // camera: GigE Vision; folder: images from the disk

  // --- camera
  std::string camera = "";    // its address, serial number or Aravis device id; empty: first found
  double exposure_us = 2000;  // of each frame
  double gain_db = 0;
  double frame_rate_hz = 14;
  int region_offset_u_px = 0;  // of the sensor; on a real camera width and offset may have steps
  int region_offset_v_px = 0;
  int region_width_px = 0;   // 0: the whole sensor
  int region_height_px = 0;  // 0: the whole sensor

  // The digital output that the laser hangs on, and what it follows. On in each exposure of a scan,
  // never latched: a camera that exposes nothing leaves it dark. Empty: the laser is wired to the
  // camera's exposure itself and cannot be switched.
  std::string laser_line = "Line1";
  std::string laser_on_source = "ExposureActive";
  std::string laser_off_source = "Off";

  // What a killed process leaves lit, at most: the camera stops when it hears nothing for so long.
  int heartbeat_ms = 2000;
  int packet_size_bytes = 8192;  // needs jumbo frames on the network: 1400 without
  int socket_buffer_bytes = 4194304;
  // Packets taken from the network card directly, as root: gentler on a real network, but nothing
  // comes from this host's own loopback.
  bool packet_socket = false;
  int buffers = 10;          // frames that Aravis may fill before they are taken
  int silent_periods = 10;   // without a frame: the camera is lost
  int frames_to_settle = 1;  // that may still have the old exposure or gain after a change
  // After the camera's answer, before a frame surely has what it says: longer than from an exposure
  // to its first packet, by which the clocks' mapping is late.
  double settle_margin_ms = 50;
  // Whether the camera sends a frame's first packet after its exposure (most do) or as it begins:
  // told apart, the clocks' mapping does not change with the exposure.
  bool leader_after_exposure = false;

  // --- folder
  std::string folder = "";   // of png and pgm files, played sorted by name at the frame rate
  bool folder_loops = true;  // else the camera is lost after the last

  // --- both
  std::string encoding = "mono8";  // of LASER0_IMAGE: mono8 or png (a third of the bytes, 20 ms)
  double longest_scan_s = 120;     // laser on at a time, whatever a command says
  bool end_when_still = false;     // a scan ends when the tool has moved and stands
  double still_duration_s = 0.5;   // so long
  double still_distance_mm = 0.3;  // within this
  double still_angle_deg = 0.1;    // and this

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("source", source, one_of({"camera", "folder"}));
    visitor("camera", camera);
    visitor("exposure_us", exposure_us, between(1, 1e6));
    visitor("gain_db", gain_db, between(0, 60));
    visitor("frame_rate_hz", frame_rate_hz, between(0.1, 1000));
    visitor("region_offset_u_px", region_offset_u_px, between(0, 32767));
    visitor("region_offset_v_px", region_offset_v_px, between(0, 32767));
    visitor("region_width_px", region_width_px, between(0, 32767));
    visitor("region_height_px", region_height_px, between(0, 32767));
    visitor("laser_line", laser_line);
    visitor("laser_on_source", laser_on_source);
    visitor("laser_off_source", laser_off_source);
    visitor("heartbeat_ms", heartbeat_ms, between(500, 60000));
    visitor("packet_size_bytes", packet_size_bytes, between(576, 65535));
    visitor("socket_buffer_bytes", socket_buffer_bytes, between(65536, 1 << 30));
    visitor("packet_socket", packet_socket);
    visitor("buffers", buffers, between(2, 100));
    visitor("silent_periods", silent_periods, between(2, 1000));
    visitor("frames_to_settle", frames_to_settle, between(0, 10));
    visitor("settle_margin_ms", settle_margin_ms, between(0, 1000));
    visitor("leader_after_exposure", leader_after_exposure);
    visitor("folder", folder);
    visitor("folder_loops", folder_loops);
    visitor("encoding", encoding, one_of({"mono8", "png"}));
    visitor("longest_scan_s", longest_scan_s, between(0.1, 3600));
    visitor("end_when_still", end_when_still);
    visitor("still_duration_s", still_duration_s, between(0.05, 60));
    visitor("still_distance_mm", still_distance_mm, between(0.001, 100));
    visitor("still_angle_deg", still_angle_deg, between(0.001, 90));
  }
};

}  // namespace arcstart::sensor_capture
