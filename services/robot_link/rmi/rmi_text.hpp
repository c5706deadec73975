// FANUC's Remote Motion Interface (R912, manual B-84184EN/03): its lines. One JSON object each,
// ended by CR LF, which is not part of the texts here. Only what needs no FRC_Initialize.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/xyzwpr.hpp"

namespace arcstart::robot_link {

// Which way the arm reaches a position, and with which frame and tool.
struct RmiConfiguration {
  int tool = 0, user_frame = 0;
  int front = 1, up = 1, left = 0, flip = 0;
  int turn4 = 0, turn5 = 0, turn6 = 0;
  bool operator==(const RmiConfiguration&) const = default;
};

std::string rmi_connect();
std::string rmi_disconnect();
std::string rmi_read_number(int number);
std::string rmi_write_number(int number, std::int32_t value);
std::string rmi_read_position(int number);
std::string rmi_write_position(int number, const RmiConfiguration& configuration,
                               const XyzWpr& position);
std::string rmi_read_user_frame(int number);  // not 0: a controller then answers nothing
std::string rmi_read_tool(int number);        // not 0: likewise an error
std::string rmi_read_place();                 // where the arm stands

// What a controller says. Only what was there is set.
struct RmiReply {
  std::string name;  // value of Command or Communication; Unknown for what it did not understand
  std::int64_t error = 0;       // ErrorID
  std::optional<int> port;      // PortNumber
  std::optional<int> number;    // RegisterNumber, FrameNumber or ToolNumber
  std::optional<double> value;  // RegisterValue
  std::optional<RmiConfiguration> configuration;
  std::optional<XyzWpr> frame;  // Position or Frame
};
struct DecodedRmiReply {
  std::optional<RmiReply> reply;
  std::string error;  // why it is none: one line
};
DecodedRmiReply decode_rmi(std::string_view line);

// What an ErrorID means and what to do, one line.
std::string rmi_error(std::int64_t error);

// What a controller said, made printable and short.
std::string rmi_quoted(std::string_view line);

}  // namespace arcstart::robot_link
