// Section `robot_pose` of cell.yaml.
#pragma once

#include <arpa/inet.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/configuration.hpp"

namespace arcstart::robot_pose {

struct RobotPoseSettings {
  // hspo: FANUC High Speed Position Output, option R891. The controller sends, nobody asks it.
  // j519: FANUC Stream Motion, its status alone. It serves one client: only where there is no
  //   other, such as a path planner.
  // rtde: Universal Robots.
  std::string protocol = "hspo";

  // hspo, j519: of this host, in the robot's network: where positions come to. The default hears
  // this host alone, so that nothing is opened to a network unasked.
  std::string address = "127.0.0.1";
  int port = 60015;  // hspo: as set in the controller; 15000, 51002 and 80 are in use too

  // hspo: only its packets count; empty: the first that is heard. j519, rtde: who is asked.
  std::string controller_address = "";
  int controller_port = 0;  // j519, rtde; 0: 60015, 30004
  int motion_group = 1;     // hspo: of the arm that carries the sensor

  // hspo: length of a tick of the controller's clock: 1 or 2000, by controller. Held against the
  // rate of arrivals; where they disagree positions are marked invalid.
  double clock_tick_us = 1;

  // rtde: positions a second. A CB3 has 125, an e-Series 500 and whatever divides them.
  double rate_hz = 125;

  // j519, rtde: the tool frame to which hand-eye is calibrated, in the flange: X Y Z mm, W P R deg
  // (fixed axes); six zeros for the flange itself. Empty: the tool centre point that the controller
  // uses.
  std::vector<double> tool_in_flange;

  double silence_s = 1;  // without a position: fault

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("protocol", protocol, one_of({"hspo", "j519", "rtde"}));
    visitor("address", address, is_address);
    visitor("port", port, between(1, 65535));
    visitor("controller_address", controller_address, is_address_or_empty);
    visitor("controller_port", controller_port, between(0, 65535));
    visitor("motion_group", motion_group, between(0, 8));
    visitor("clock_tick_us", clock_tick_us, between(0.001, 1e6));
    visitor("rate_hz", rate_hz, between(10, 500));
    visitor("tool_in_flange", tool_in_flange, is_frame_or_empty);
    visitor("silence_s", silence_s, between(0.05, 60));
  }

  static std::string is_address(const std::string& text) {
    in_addr address{};
    return inet_pton(AF_INET, text.c_str(), &address) == 1 ? "" : "must be an IPv4 address";
  }
  static std::string is_address_or_empty(const std::string& text) {
    return text.empty() ? "" : is_address(text);
  }
  static std::string is_frame_or_empty(const std::vector<double>& frame) {
    for (const double number : frame)
      if (!(std::abs(number) < 1e4)) return "must lie within 10 m, and turns within 10000 deg";
    return frame.empty() || frame.size() == 6 ? "" : "must be six numbers X Y Z W P R, or none";
  }
};

}  // namespace arcstart::robot_pose
