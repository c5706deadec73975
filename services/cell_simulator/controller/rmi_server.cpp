#include "services/cell_simulator/controller/rmi_server.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace arcstart::cell_simulator {
namespace {

using nlohmann::json;

constexpr int kUnknown = 2556941, kNoTool = 2556930, kNoFrame = 2556931, kNoPosition = 2556932,
              kBadValue = 2556949, kBadPosition = 2556951, kWrongState = 2556943;
constexpr int kWait = 50;  // ms, after which it looks whether it is to end

int listen_on(const std::string& address, int port, int& given) {
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, address.c_str(), &here.sin_addr);
  const int made = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(made, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0 ||
      listen(made, 4) != 0) {
    const std::string why = std::strerror(errno);
    close(made);
    throw std::runtime_error(
        fmt::format("cannot serve RMI on TCP {}:{} ({}): set rmi_port", address, port, why));
  }
  socklen_t size = sizeof here;
  getsockname(made, reinterpret_cast<sockaddr*>(&here), &size);
  given = ntohs(here.sin_port);
  return made;
}

bool readable(int socket) {
  pollfd waiting{socket, POLLIN, 0};
  return poll(&waiting, 1, kWait) > 0;
}

// The first line without its end; empty where there is none yet.
std::string take_line(std::string& received) {
  const auto end = received.find("\r\n");
  if (end == std::string::npos) return {};
  const std::string line = received.substr(0, end);
  received.erase(0, end + 2);
  return line;
}

bool more(int socket, std::string& received) {
  char bytes[2048];
  const ssize_t size = recv(socket, bytes, sizeof bytes, 0);
  if (size > 0) received.append(bytes, static_cast<std::size_t>(size));
  return size > 0;
}

void say(int socket, const std::string& text) {
  send(socket, text.data(), text.size(), MSG_NOSIGNAL);
}

// Of 32 bits, as the controller keeps it.
double kept(double value) { return static_cast<float>(value); }

json frame_json(const XyzWpr& f) {
  return {{"X", kept(f.x)}, {"Y", kept(f.y)}, {"Z", kept(f.z)},
          {"W", kept(f.w)}, {"P", kept(f.p)}, {"R", kept(f.r)}};
}

XyzWpr frame_from(const json& j) {
  return {j.at("X"), j.at("Y"), j.at("Z"), j.at("W"), j.at("P"), j.at("R")};
}

json configuration_json(const ArmConfiguration& c, int user_frame, int tool) {
  return {{"UToolNumber", tool}, {"UFrameNumber", user_frame},
          {"Front", c.front},    {"Up", c.up},
          {"Left", c.left},      {"Flip", c.flip},
          {"Turn4", c.turn4},    {"Turn5", c.turn5},
          {"Turn6", c.turn6}};
}

ArmConfiguration configuration_from(const json& j) {
  return {j.at("Front"), j.at("Up"),    j.at("Left"), j.at("Flip"),
          j.at("Turn4"), j.at("Turn5"), j.at("Turn6")};
}

}  // namespace

RmiServer::RmiServer(const RmiServerSettings& settings, ControllerMemory& memory, Place place)
    : settings_(settings), memory_(memory), place_(std::move(place)) {
  socket_ = listen_on(settings_.address, settings_.port, port_);
  session_socket_ = listen_on(settings_.address, 0, session_port_);
  greeter_ = std::thread([this] {
    while (!ending_) {
      if (!readable(socket_)) continue;
      const int client = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
      if (client < 0) continue;
      greet(client);
      close(client);
    }
  });
  server_ = std::thread([this] {
    while (!ending_) {
      if (!readable(session_socket_)) continue;
      const int client = accept4(session_socket_, nullptr, nullptr, SOCK_CLOEXEC);
      if (client < 0) continue;
      serve(client);
      close(client);
    }
  });
}

RmiServer::~RmiServer() {
  ending_ = true;
  greeter_.join();
  server_.join();
  close(socket_);
  close(session_socket_);
}

void RmiServer::greet(int client) {
  std::string received;
  while (!ending_ && readable(client) && more(client, received)) {
    const std::string line = take_line(received);
    if (line.empty()) continue;
    const json asked = json::parse(line, nullptr, false);
    const bool good = asked.is_object() && asked.value("Communication", "") == "FRC_Connect";
    say(client, json{{"Communication", "FRC_Connect"},
                     {"ErrorID", good ? 0 : kUnknown},
                     {"PortNumber", good ? session_port_ : 0},
                     {"MajorVersion", 9},
                     {"MinorVersion", 0}}
                        .dump() +
                    "\r\n");
    return;
  }
}

void RmiServer::serve(int client) {
  std::string received;
  while (!ending_) {
    std::string line = take_line(received);
    if (line.empty()) {
      if (readable(client) && !more(client, received)) return;
      continue;
    }
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(settings_.request_ms));
    const int number = ++requests_;
    const std::string text = answer(line) + "\r\n";
    if (settings_.silent_from > 0 && number >= settings_.silent_from) continue;
    const bool half = settings_.half_from > 0 && number >= settings_.half_from;
    say(client, half ? text.substr(0, text.size() / 2) : text);
    if (line.find("FRC_Disconnect") != std::string::npos) return;
  }
}

std::string RmiServer::answer(const std::string& line) {
  const json asked = json::parse(line, nullptr, false);
  const std::string name =
      asked.is_object() ? asked.value("Command", asked.value("Communication", "")) : "";
  json reply{{"Command", name}, {"ErrorID", 0}};
  const auto refuse = [&](int error) {
    reply["ErrorID"] = error;
    return reply.dump();
  };
  // A number from 1 to most, under that key.
  const auto index = [&](const char* key, int most) -> std::size_t {
    const int value = asked.value(key, 0);
    reply[key] = value;
    return value >= 1 && value <= most ? static_cast<std::size_t>(value) : 0;
  };
  try {
    if (name == "FRC_Disconnect") return json{{"Communication", name}, {"ErrorID", 0}}.dump();
    const std::lock_guard lock(memory_.mutex);
    if (name == "FRC_ReadCartesianPosition") {
      reply["TimeTag"] = 1;
      reply["Configuration"] = configuration_json({}, 0, 1);
      reply["Position"] = frame_json(to_xyzwpr(place_()));
      return reply.dump();
    }
    if (settings_.numeric_registers && name == "FRC_ReadRegister") {
      const std::size_t n = index("RegisterNumber", ControllerMemory::kNumbers);
      if (n == 0) return refuse(kBadValue);
      const double value = memory_.numbers[n];
      if (value == std::round(value))
        reply["RegisterValue"] = static_cast<std::int64_t>(value);
      else
        reply["RegisterValue"] = value;
      return reply.dump();
    }
    if (settings_.numeric_registers && name == "FRC_WriteRegister") {
      const std::size_t n = index("RegisterNumber", ControllerMemory::kNumbers);
      if (n == 0) return refuse(kBadValue);
      memory_.numbers[n] = asked.at("RegisterValue");
      return reply.dump();
    }
    if (name == "FRC_ReadPositionRegister") {
      const std::size_t n = index("RegisterNumber", ControllerMemory::kPositions);
      if (n == 0) return refuse(kNoPosition);
      const PositionRegister& r = memory_.positions[n];
      reply["Representation"] = "Cartesian";
      reply["Configuration"] = configuration_json(r.configuration, r.user_frame, r.tool);
      reply["Position"] = frame_json(r.position);
      return reply.dump();
    }
    if (name == "FRC_WritePositionRegister") {
      const std::size_t n = index("RegisterNumber", ControllerMemory::kPositions);
      if (n == 0) return refuse(kNoPosition);
      if (asked.value("Representation", "Cartesian") != "Cartesian") return refuse(kBadPosition);
      const json& c = asked.at("Configuration");
      const int tool = c.at("UToolNumber"), frame = c.at("UFrameNumber");
      if (tool < 1 || tool > ControllerMemory::kTools) return refuse(kNoTool);
      if (frame < 0 || frame > ControllerMemory::kFrames) return refuse(kNoFrame);
      memory_.positions[n] = {frame_from(asked.at("Position")), configuration_from(c), frame, tool};
      return reply.dump();
    }
    if (name == "FRC_ReadUFrameData") {
      const std::size_t n = index("FrameNumber", ControllerMemory::kFrames);
      if (n == 0) return refuse(kNoFrame);
      reply["Frame"] = frame_json(memory_.frames[n]);
      return reply.dump();
    }
    if (name == "FRC_ReadUToolData") {
      const std::size_t n = index("ToolNumber", ControllerMemory::kTools);
      if (n == 0) return refuse(kNoTool);
      reply["Frame"] = frame_json(memory_.tools[n]);
      return reply.dump();
    }
    if (name == "FRC_Initialize" || (asked.is_object() && asked.contains("Instruction"))) {
      ++motion_asked_;
      return refuse(kWrongState);
    }
  } catch (const json::exception&) {
    return refuse(kBadValue);
  }
  reply["Command"] = "Unknown";
  return refuse(kUnknown);
}

}  // namespace arcstart::cell_simulator
