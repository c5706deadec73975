#include "services/cell_simulator/robot/rtde_frames.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "services/cell_simulator/robot/big_endian_writer.hpp"

namespace arcstart::cell_simulator {
namespace {

std::vector<std::uint8_t> framed(char type, const std::vector<std::uint8_t>& payload) {
  BigEndianWriter writer;
  writer.u16(static_cast<std::uint16_t>(payload.size() + 3));
  writer.u8(static_cast<std::uint8_t>(type));
  std::vector<std::uint8_t> frame = writer.take();
  frame.insert(frame.end(), payload.begin(), payload.end());
  return frame;
}

}  // namespace

std::optional<RtdeRequest> take_rtde_request(std::vector<std::uint8_t>& received) {
  if (received.size() < 3) return std::nullopt;
  const std::size_t size = received[0] * 256u + received[1];
  if (size < 3) received.clear();
  if (size < 3 || received.size() < size) return std::nullopt;
  const auto end = received.begin() + static_cast<std::ptrdiff_t>(size);
  RtdeRequest request{static_cast<char>(received[2]), {received.begin() + 3, end}};
  received.erase(received.begin(), end);
  return request;
}

std::vector<std::uint8_t> rtde_yes_or_no(char type, bool yes) {
  return framed(type, {static_cast<std::uint8_t>(yes ? 1 : 0)});
}

std::vector<std::uint8_t> rtde_recipe_bytes(std::uint8_t recipe, const std::string& types) {
  std::vector<std::uint8_t> payload{recipe};
  payload.insert(payload.end(), types.begin(), types.end());
  return framed('O', payload);
}

std::optional<RtdeOutputs> understand_rtde_outputs(const std::vector<std::uint8_t>& payload) {
  if (payload.size() < 9) return std::nullopt;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i) bits = bits << 8 | payload[i];
  RtdeOutputs outputs{std::bit_cast<double>(bits), {""}};
  for (std::size_t i = 8; i < payload.size(); ++i) {
    if (payload[i] == ',')
      outputs.names.emplace_back();
    else
      outputs.names.back() += static_cast<char>(payload[i]);
  }
  return outputs;
}

std::string rtde_type_of(const std::string& name) {
  if (name == "timestamp") return "DOUBLE";
  if (name == "actual_TCP_pose" || name == "actual_q" || name == "tcp_offset") return "VECTOR6D";
  return "NOT_FOUND";
}

std::vector<std::uint8_t> rtde_data_bytes(std::uint8_t recipe,
                                          const std::vector<std::string>& names,
                                          const RobotReport& report,
                                          const RigidTransform& T_tool0_tool) {
  BigEndianWriter writer;
  writer.u8(recipe);
  const auto add = [&writer](const std::array<double, 6>& values) {
    for (const double value : values) writer.f64(value);
  };
  for (const std::string& name : names) {
    if (name == "timestamp") writer.f64(static_cast<double>(report.clock_ns) * 1e-9);
    if (name == "actual_TCP_pose") add(to_rotation_vector(report.T_base_tool));
    if (name == "actual_q") add(report.joints);
    if (name == "tcp_offset") add(to_rotation_vector(T_tool0_tool));
  }
  return framed('U', writer.take());
}

// The axis from the antisymmetric part; near half a turn, where that vanishes, from the symmetric.
std::array<double, 6> to_rotation_vector(const RigidTransform& transform) {
  const Eigen::Matrix3d r = transform.linear();
  const Eigen::Vector3d twice_sine(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  const double angle = std::atan2(twice_sine.norm(), r.trace() - 1);
  Eigen::Vector3d turn = twice_sine / 2;  // holds near none
  if (angle > 3) {
    const Eigen::Matrix3d outer =
        (r + r.transpose()) / 2 - std::cos(angle) * Eigen::Matrix3d::Identity();
    int largest = 0;
    outer.diagonal().maxCoeff(&largest);
    const Eigen::Vector3d axis = outer.col(largest).normalized();
    turn = axis * (twice_sine.dot(axis) < 0 ? -angle : angle);
  } else if (angle > 1e-8) {
    turn = twice_sine.normalized() * angle;
  }
  const Eigen::Vector3d metres = transform.translation() / 1000;
  return {metres.x(), metres.y(), metres.z(), turn.x(), turn.y(), turn.z()};
}

}  // namespace arcstart::cell_simulator
