// Section `robot_link` of cell.yaml.
#pragma once

#include <arpa/inet.h>

#include <array>
#include <string>
#include <vector>

#include "common/configuration.hpp"

namespace arcstart::robot_link {

struct RobotLinkSettings {
  // rmi: FANUC's Remote Motion Interface (R912).
  std::string protocol = "rmi";
  std::string controller_address = "";
  int controller_port = 0;  // 0: 16001

  // rmi: R[] from here on: request, job, part, taken, done, robot's beat, link's beat, status,
  // verdict, answer. PR[] from here on: approach, start, end.
  int first_number = 91;
  int first_position = 91;

  // rmi: positions are in this user frame (0: World) and for this tool. What the controller holds
  // there is compared with the two below: X Y Z mm, W P R deg. The tool is that of the hand-eye.
  int user_frame = 1;
  int tool = 1;
  std::array<double, 6> frame_in_base{};
  std::array<double, 6> tool_in_flange{};

  // Names of the jobs 1, 2 ... that the robot asks for.
  std::vector<std::string> jobs = {"1"};

  // Only what lies within is delivered. Approach, start and end: base, mm. The default is empty.
  std::array<double, 3> box_low_mm{};
  std::array<double, 3> box_high_mm{};
  // Standard deviations in any direction: of the start less than half a wire of 1.2 mm, of the end,
  // which lies along the seam where it is unsure, that of a crater.
  double longest_start_deviation_mm = 0.5;
  double longest_end_deviation_mm = 2;
  double longest_age_s = 60;  // from the scan's end until it is taken

  double longest_scan_s = 30;
  double answer_timeout_s = 10;  // for the scan to begin, and for SEAM after its end

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("protocol", protocol, one_of({"rmi"}));
    visitor("controller_address", controller_address, [](const std::string& text) -> std::string {
      in_addr address{};
      return inet_pton(AF_INET, text.c_str(), &address) == 1
                 ? ""
                 : "must be the controller's IPv4 address";
    });
    visitor("controller_port", controller_port, between(0, 65535));
    visitor("first_number", first_number, between(1, 191));
    visitor("first_position", first_position, between(1, 98));
    visitor("user_frame", user_frame, between(0, 9));
    visitor("tool", tool, between(1, 10));
    visitor("frame_in_base", frame_in_base);
    visitor("tool_in_flange", tool_in_flange);
    visitor("jobs", jobs, [](const std::vector<std::string>& names) -> std::string {
      for (const std::string& name : names)
        if (name.empty() || name.size() > 256) return "must be names of 1 to 256 bytes";
      return "";
    });
    visitor("box_low_mm", box_low_mm);
    visitor("box_high_mm", box_high_mm);
    visitor("longest_start_deviation_mm", longest_start_deviation_mm, positive());
    visitor("longest_end_deviation_mm", longest_end_deviation_mm, positive());
    visitor("longest_age_s", longest_age_s, between(1, 3600));
    visitor("longest_scan_s", longest_scan_s, between(1, 600));
    visitor("answer_timeout_s", answer_timeout_s, between(1, 120));
  }
};

}  // namespace arcstart::robot_link
