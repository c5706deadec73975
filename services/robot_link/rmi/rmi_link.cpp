#include "services/robot_link/rmi/rmi_link.hpp"

#include <fmt/core.h>

#include <cmath>

#include "common/time.hpp"

namespace arcstart::robot_link {
namespace {

constexpr std::int64_t kAnswers = 2'000'000;  // us: thirty times what a controller takes
constexpr std::size_t kLongestLine = 8192;    // bytes; a reply has some 300
// How far the controller's frames may differ from the settings': its own rounding.
constexpr double kSameFrame = 0.02;  // mm and deg

std::string as_text(const XyzWpr& v) {
  return fmt::format("{:.3f} {:.3f} {:.3f} mm, {:.3f} {:.3f} {:.3f} deg", v[0], v[1], v[2], v[3],
                     v[4], v[5]);
}

bool are_equal(const XyzWpr& a, const XyzWpr& b) {
  const RigidTransform difference = from_xyzwpr(a).inverse() * from_xyzwpr(b);
  return difference.translation().norm() <= kSameFrame &&
         Eigen::AngleAxisd(difference.linear()).angle() <= kSameFrame * kDegree;
}

}  // namespace

// So that the next client need not wait until the controller misses this one.
RmiLink::~RmiLink() {
  const std::string leave = rmi_disconnect() + "\r\n";
  if (heard_) connection_.send({leave.begin(), leave.end()});
}

std::string RmiLink::description() const {
  return fmt::format("RMI at {}:{}", settings_.address, settings_.port);
}

void RmiLink::open(int port) {
  received_.clear();
  heard_ = false;
  const std::string why =
      connection_.open(settings_.address, port, kAnswers, "RMI (R912) installed and not in use");
  if (!why.empty()) throw LinkError(fmt::format("{}:{}: {}", settings_.address, port, why));
}

void RmiLink::connect() {
  open(settings_.port);
  const RmiReply reply = ask(rmi_connect(), "FRC_Connect");
  if (!reply.port || *reply.port < 1 || *reply.port > 65535)
    throw LinkError("FRC_Connect was answered without a port: is the port RMI's (16001)?");
  open(*reply.port);
  try {
    check_frames();
  } catch (const LinkError& error) {
    if (heard_) throw;
    throw LinkError(
        fmt::format("on port {} {}: does another client hold the session? A controller "
                    "frees a hung one after $RMI_CFG.$DISCNT_TIM",
                    *reply.port, error.what()));
  }
}

// Frame 0 is World and cannot be read: the controller would not answer.
void RmiLink::check_frames() {
  const auto check = [&](const RmiReply& reply, const XyzWpr& expected, const std::string& what,
                         const std::string& setting) {
    if (!reply.frame) throw LinkError(what + " was answered without a frame");
    if (!are_equal(*reply.frame, expected))
      throw LinkError(
          fmt::format("{} is {} at the controller and {} in robot_link.{}: nothing is "
                      "delivered until they agree",
                      what, as_text(*reply.frame), as_text(expected), setting));
  };
  check(ask(rmi_read_tool(settings_.tool), "FRC_ReadUToolData", settings_.tool),
        settings_.tool_in_flange, fmt::format("UTOOL[{}]", settings_.tool), "tool_in_flange");
  if (settings_.user_frame != 0)
    check(
        ask(rmi_read_user_frame(settings_.user_frame), "FRC_ReadUFrameData", settings_.user_frame),
        settings_.frame_in_base, fmt::format("UFRAME[{}]", settings_.user_frame), "frame_in_base");
}

Reading RmiLink::carry_out(const Operation& operation) {
  using Kind = Operation::Kind;
  const int r = settings_.first_number + static_cast<int>(operation.slot);
  const int pr = settings_.first_position + static_cast<int>(operation.place);
  Reading reading;
  switch (operation.kind) {
    case Kind::kReadNumber:
      reading.number = read_number(r);
      break;
    case Kind::kWriteNumber:
      ask(rmi_write_number(r, operation.number), "FRC_WriteRegister", r);
      break;
    case Kind::kWritePosition: {
      if (operation.place == Place::kApproach) {
        const RmiReply stands = ask(rmi_read_place(), "FRC_ReadCartesianPosition");
        if (!stands.configuration)
          throw LinkError("FRC_ReadCartesianPosition was answered without a configuration");
        configuration_ = *stands.configuration;
        configuration_.tool = settings_.tool;
        configuration_.user_frame = settings_.user_frame;
      }
      ask(rmi_write_position(pr, configuration_, to_xyzwpr(operation.position)),
          "FRC_WritePositionRegister", pr);
      break;
    }
    case Kind::kReadPosition: {
      const RmiReply reply = ask(rmi_read_position(pr), "FRC_ReadPositionRegister", pr);
      if (!reply.frame || !reply.configuration)
        throw LinkError(fmt::format("PR[{}] was read back without a Cartesian position", pr));
      if (*reply.configuration != configuration_)
        throw LinkError(fmt::format(
            "PR[{}] was read back with another frame, tool or configuration than written", pr));
      reading.position = from_xyzwpr(*reply.frame);
      break;
    }
  }
  return reading;
}

std::int32_t RmiLink::read_number(int number) {
  const RmiReply reply = ask(rmi_read_number(number), "FRC_ReadRegister", number);
  const double value = reply.value.value_or(0.5);
  if (value != std::round(value) || std::abs(value) > 2147483647.0)
    throw LinkError(fmt::format("R[{}] holds no whole number: set it to 0", number));
  return static_cast<std::int32_t>(value);
}

RmiReply RmiLink::ask(const std::string& request, const std::string& name, int number) {
  const std::string text = request + "\r\n";
  if (!connection_.send({text.begin(), text.end()}))
    throw LinkError("the controller closed the connection");
  for (const std::int64_t due = steady_now() + kAnswers;;) {
    const std::string said = line(due, name);
    heard_ = true;
    const DecodedRmiReply decoded = decode_rmi(said);
    if (!decoded.reply) throw LinkError(fmt::format("the answer to {} {}", name, decoded.error));
    const RmiReply& reply = *decoded.reply;
    if (reply.name == "FRC_Terminate")
      throw LinkError("the controller ended the session (FRC_Terminate): idle, or a restart");
    if (reply.name == "FRC_SystemFault" || reply.name == "FRC_AsbnReady") continue;  // unasked
    if (reply.error != 0)
      throw LinkError(fmt::format("{}{} is refused: {}", name,
                                  number > 0 ? fmt::format(" of {}", number) : "",
                                  rmi_error(reply.error)));
    if (reply.name != name || (number > 0 && reply.number && *reply.number != number))
      throw LinkError(fmt::format("{} was answered by {}", name, rmi_quoted(said)));
    return reply;
  }
}

std::string RmiLink::line(std::int64_t due, const std::string& owed) {
  for (;;) {
    if (const auto end = received_.find('\n'); end != std::string::npos) {
      std::string whole = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (!whole.empty() && whole.back() == '\r') whole.pop_back();
      return whole;
    }
    if (received_.size() > kLongestLine) throw LinkError("what answers is no RMI: endless lines");
    std::vector<std::uint8_t> bytes;
    std::int64_t arrival = 0;
    const std::int64_t left = std::max<std::int64_t>(due - steady_now(), 0);
    switch (connection_.receive(bytes, arrival, left)) {
      case TcpConnection::Received::kBytes:
        received_.append(bytes.begin(), bytes.end());
        break;
      case TcpConnection::Received::kNothing:
        if (steady_now() < due) break;
        throw LinkError(fmt::format("the controller has not answered {} for {} s{}", owed,
                                    kAnswers / 1'000'000,
                                    received_.empty() ? "" : ", only half a line came"));
      case TcpConnection::Received::kClosed:
        throw LinkError("the controller closed the connection and owes an answer to " + owed);
      case TcpConnection::Received::kEnded:
        throw LinkError("ended");
    }
  }
}

}  // namespace arcstart::robot_link
