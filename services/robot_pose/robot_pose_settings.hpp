// Section `robot_pose` of cell.yaml.
#pragma once

#include <arpa/inet.h>

#include <string>

#include "common/configuration.hpp"

namespace arcstart::robot_pose {

struct RobotPoseSettings {
  std::string protocol = "hspo";  // FANUC High Speed Position Output, option R891

  // Of this host, in the robot's network: where the controller sends to. The default hears this
  // host alone, so that nothing is opened to a network unasked.
  std::string address = "127.0.0.1";
  int port = 60015;  // as set in the controller; 15000, 51002 and 80 are in use too

  // Only its packets count; empty: the first that is heard.
  std::string controller_address = "";
  int motion_group = 1;  // of the arm that carries the sensor

  // Length of a tick of the controller's clock: 1 or 2000, by controller. Held against the rate of
  // arrivals; where they disagree positions are marked invalid.
  double clock_tick_us = 1;

  double silence_s = 1;  // without a position: fault

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("protocol", protocol, one_of({"hspo"}));
    visitor("address", address, is_address);
    visitor("port", port, between(1, 65535));
    visitor("controller_address", controller_address, is_address_or_empty);
    visitor("motion_group", motion_group, between(0, 8));
    visitor("clock_tick_us", clock_tick_us, between(0.001, 1e6));
    visitor("silence_s", silence_s, between(0.05, 60));
  }

  static std::string is_address(const std::string& text) {
    in_addr address{};
    return inet_pton(AF_INET, text.c_str(), &address) == 1 ? "" : "must be an IPv4 address";
  }
  static std::string is_address_or_empty(const std::string& text) {
    return text.empty() ? "" : is_address(text);
  }
};

}  // namespace arcstart::robot_pose
