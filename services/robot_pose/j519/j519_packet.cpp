#include "services/robot_pose/j519/j519_packet.hpp"

#include <fmt/core.h>

#include <cmath>

#include "services/robot_pose/stream/big_endian.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr std::uint32_t kStop = 2, kCapability = 7, kStart = 200;
constexpr std::uint32_t kStatus3 = 202, kStatus4 = 204, kStatus1 = 0;
constexpr std::size_t kCapabilitySize = 28, kStatus3Size = 388, kStatus4Size = 416;
constexpr std::uint32_t kLongestSampling = 1000;  // ms; the slowest controllers report every 8
constexpr double kFarthest = 1e5;                 // mm, and degrees: 100 m is no arm's

DecodedJ519 refused_j519(std::string why) { return {{}, {}, std::move(why)}; }

DecodedJ519 decode_capability(BigEndianReader& reader) {
  J519Capability capability;
  reader.skip(8);  // version, id
  capability.sampling_ms = reader.u32();
  reader.skip(4);  // start_move
  capability.available_version = reader.u32();
  const std::uint32_t tool = reader.u32();
  if (capability.sampling_ms == 0 || capability.sampling_ms > kLongestSampling || tool > 1)
    return refused_j519(
        fmt::format("J519 capability makes no sense: {} ms between reports, rob_status_use_tcp {}",
                    capability.sampling_ms, tool));
  capability.tool = tool == 1;
  return {{}, capability, {}};
}

DecodedJ519 decode_status(std::uint32_t expected_version, BigEndianReader& reader) {
  J519Status status;
  status.version = reader.u32();
  if (status.version != expected_version)
    return refused_j519(fmt::format("J519 status says version {} in the form of version {}",
                                    status.version, expected_version));
  status.sequence = reader.u32();
  reader.skip(4);  // status bits
  status.time_stamp = reader.u32();
  reader.f32s(status.position);
  reader.f32s(status.joints);
  for (const auto* values : {&status.position, &status.joints})
    for (const double value : *values)
      if (!(std::abs(value) < kFarthest))
        return refused_j519("J519 status holds a position that is none");
  return {status, {}, {}};
}

}  // namespace

std::vector<std::uint8_t> j519_start(std::uint32_t version) {
  return BigEndianWriter().u32(kStart).u32(version).take();
}

std::vector<std::uint8_t> j519_stop(std::uint32_t version) {
  return BigEndianWriter().u32(kStop).u32(version).take();
}

std::vector<std::uint8_t> j519_capability_question() {
  // Version and id; what is to be answered is 0.
  return BigEndianWriter()
      .u32(kCapability)
      .u32(kJ519Oldest)
      .u32(1)
      .u32(0)
      .u32(0)
      .u32(0)
      .u32(0)
      .take();
}

DecodedJ519 decode_j519(std::span<const std::uint8_t> datagram) {
  if (datagram.size() < 4)
    return refused_j519(fmt::format("J519 packet of {} bytes is cut short", datagram.size()));
  BigEndianReader reader(datagram);
  const std::uint32_t type = reader.u32();
  const auto has = [&](std::size_t size) { return datagram.size() == size; };
  if (type == kCapability && has(kCapabilitySize)) return decode_capability(reader);
  if (type == kStatus3 && has(kStatus3Size)) return decode_status(3, reader);
  if (type == kStatus4 && has(kStatus4Size)) return decode_status(4, reader);
  if (type == kStatus1)
    return refused_j519(
        "the controller sends J519 in its oldest form: versions 3 and 4 are understood");
  if (type == kCapability || type == kStatus3 || type == kStatus4)
    return refused_j519(fmt::format("J519 packet of type {} has {} bytes", type, datagram.size()));
  return refused_j519(fmt::format("not a J519 packet: it begins with {:08x}", type));
}

}  // namespace arcstart::robot_pose
