#include "services/robot_link/rmi/rmi_text.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace arcstart::robot_link {
namespace {

using Json = nlohmann::ordered_json;  // in the order of FANUC's own client

constexpr double kFarthest = 1e5;  // mm and deg: a hundred metres; no arm's position is beyond
constexpr std::size_t kLongestName = 60;    // characters of a command's name
constexpr std::size_t kLongestQuote = 120;  // characters that are shown of what is not understood

std::string request(const char* command, const Json& more = Json::object()) {
  Json json{{"Command", command}};
  json.update(more);
  return json.dump();
}

// A whole number under this key; nothing where it is not there or none.
std::optional<int> whole(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number_integer()) return std::nullopt;
  const auto value = found->get<std::int64_t>();
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max() ||
      (found->is_number_unsigned() && value < 0))
    return std::nullopt;
  return static_cast<int>(value);
}

std::optional<double> real(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  const auto value = found->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<RmiConfiguration> configuration_of(const Json& json) {
  RmiConfiguration c;
  const std::pair<const char*, int*> parts[] = {
      {"UToolNumber", &c.tool}, {"UFrameNumber", &c.user_frame},
      {"Front", &c.front},      {"Up", &c.up},
      {"Left", &c.left},        {"Flip", &c.flip},
      {"Turn4", &c.turn4},      {"Turn5", &c.turn5},
      {"Turn6", &c.turn6}};
  for (const auto& [key, part] : parts) {
    const auto value = whole(json, key);
    if (!value) return std::nullopt;
    *part = *value;
  }
  return c;
}

std::optional<XyzWpr> frame_of(const Json& json) {
  constexpr const char* kKeys[] = {"X", "Y", "Z", "W", "P", "R"};
  XyzWpr frame;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const auto value = real(json, kKeys[i]);
    if (!value || std::abs(*value) > kFarthest) return std::nullopt;
    frame[i] = *value;
  }
  return frame;
}

}  // namespace

std::string rmi_connect() { return Json{{"Communication", "FRC_Connect"}}.dump(); }
std::string rmi_disconnect() { return Json{{"Communication", "FRC_Disconnect"}}.dump(); }

std::string rmi_read_number(int number) {
  return request("FRC_ReadRegister", {{"RegisterNumber", number}});
}

std::string rmi_write_number(int number, std::int32_t value) {
  return request("FRC_WriteRegister",
                 {{"RegisterNumber", number}, {"RegisterValue", value}, {"DataType", "integer"}});
}

std::string rmi_read_position(int number) {
  return request("FRC_ReadPositionRegister", {{"RegisterNumber", number}});
}

std::string rmi_write_position(int number, const RmiConfiguration& c, const XyzWpr& p) {
  return request("FRC_WritePositionRegister", {{"RegisterNumber", number},
                                               {"Representation", "Cartesian"},
                                               {"Configuration",
                                                {{"UToolNumber", c.tool},
                                                 {"UFrameNumber", c.user_frame},
                                                 {"Front", c.front},
                                                 {"Up", c.up},
                                                 {"Left", c.left},
                                                 {"Flip", c.flip},
                                                 {"Turn4", c.turn4},
                                                 {"Turn5", c.turn5},
                                                 {"Turn6", c.turn6}}},
                                               {"Position",
                                                {{"X", p[0]},
                                                 {"Y", p[1]},
                                                 {"Z", p[2]},
                                                 {"W", p[3]},
                                                 {"P", p[4]},
                                                 {"R", p[5]},
                                                 {"Ext1", 0.0},
                                                 {"Ext2", 0.0},
                                                 {"Ext3", 0.0}}}});
}

std::string rmi_read_user_frame(int number) {
  return request("FRC_ReadUFrameData", {{"FrameNumber", number}});
}

std::string rmi_read_tool(int number) {
  return request("FRC_ReadUToolData", {{"ToolNumber", number}});
}

std::string rmi_read_place() { return request("FRC_ReadCartesianPosition"); }

DecodedRmiReply decode_rmi(std::string_view line) {
  const Json json = Json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return {{}, "no JSON object: " + rmi_quoted(line)};
  RmiReply reply;
  for (const char* key : {"Command", "Communication", "Instruction"}) {
    const auto name = json.find(key);
    if (name == json.end()) continue;
    if (name->is_string()) reply.name = name->get<std::string>();
    break;
  }
  if (reply.name.empty() || reply.name.size() > kLongestName)
    return {{}, "names no command: " + rmi_quoted(line)};
  if (const auto error = json.find("ErrorID"); error != json.end()) {
    if (!error->is_number_integer()) return {{}, "ErrorID is no number: " + rmi_quoted(line)};
    reply.error = error->get<std::int64_t>();
  }
  reply.port = whole(json, "PortNumber");
  for (const char* key : {"RegisterNumber", "FrameNumber", "ToolNumber"})
    if (const auto number = whole(json, key)) reply.number = number;
  reply.value = real(json, "RegisterValue");
  for (const char* key : {"Position", "Frame"})
    if (const auto frame = json.find(key); frame != json.end() && frame->is_object())
      reply.frame = frame_of(*frame);
  if (const auto c = json.find("Configuration"); c != json.end() && c->is_object())
    reply.configuration = configuration_of(*c);
  return {reply, {}};
}

// fanuc_driver's rmi.cpp and B-84184EN/03, 2556929 on.
std::string rmi_error(std::int64_t error) {
  struct Known {
    std::int64_t id;
    const char* means;
  };
  constexpr Known kKnown[] = {
      {2556930, "no such tool frame: set robot_link.tool"},
      {2556931, "no such user frame: set robot_link.user_frame"},
      {2556932, "no such position register: set robot_link.first_position"},
      {2556935, "the servos are off"},
      {2556941, "it does not know this command: its software has no numeric registers for RMI"},
      {2556942, "the command failed: is the robot moving, or the register write-protected?"},
      {2556943, "the wrong state for this: is the robot moving?"},
      {2556949, "no such register, or a value it does not take: set robot_link.first_number"},
      {2556950, "no such tool frame: set robot_link.tool"},
      {2556951, "it does not take this position: another configuration than the arm's?"},
      {2556954, "another client holds the session: end it, or wait for $RMI_CFG.$DISCNT_TIM"},
      {2556955, "it still works on another command: another client?"},
      {2556972, "it does not take whole numbers in this register"},
  };
  for (const Known& known : kKnown)
    if (known.id == error) return fmt::format("{} (error {})", known.means, error);
  return fmt::format("error {}", error);
}

std::string rmi_quoted(std::string_view line) {
  std::string text;
  for (const char c : line.substr(0, kLongestQuote)) text += c >= ' ' && c < 127 ? c : '?';
  return line.size() > kLongestQuote ? text + "..." : text;
}

}  // namespace arcstart::robot_link
