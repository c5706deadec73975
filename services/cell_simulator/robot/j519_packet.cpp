#include "services/cell_simulator/robot/j519_packet.hpp"

#include "services/cell_simulator/robot/big_endian_writer.hpp"

namespace arcstart::cell_simulator {

std::vector<std::uint8_t> j519_status_bytes(const J519Place& place) {
  const bool newer = place.version >= 4;
  BigEndianWriter writer;
  writer.u32(newer ? 204 : 202);
  writer.u32(place.version);
  writer.u32(place.sequence);
  writer.u8(0b0101);  // ready for commands, SYSRDY
  writer.zeros(3);    // robot status, contact stop, unused
  writer.u32(place.time_stamp);
  const XyzWpr& p = place.position;
  for (const double value : {p.x, p.y, p.z, p.w, p.p, p.r, 0., 0., 0.})
    writer.f32(static_cast<float>(value));
  for (const double angle : place.joints_deg) writer.f32(static_cast<float>(angle));
  writer.zeros(3 * 4);  // J7 to J9
  writer.zeros(9 * 4);  // motor currents
  writer.f32(1);        // safety scale
  if (newer) {
    writer.zeros(6 * 4);  // force and moment
    writer.u32(0);        // no sensor selected
  }
  writer.zeros(256);  // I/O
  return writer.take();
}

std::vector<std::uint8_t> j519_capability_bytes(std::uint32_t sampling_ms, std::uint32_t version,
                                                bool use_tcp) {
  BigEndianWriter writer;
  for (const std::uint32_t value : {7u, 3u, 1u, sampling_ms, 0u, version, use_tcp ? 1u : 0u})
    writer.u32(value);
  return writer.take();
}

std::optional<J519Asked> understand_j519(const std::vector<std::uint8_t>& datagram) {
  const auto number = [&](std::size_t at) {
    return static_cast<std::uint32_t>(datagram[at] << 24 | datagram[at + 1] << 16 |
                                      datagram[at + 2] << 8 | datagram[at + 3]);
  };
  if (datagram.size() == 8 && number(0) == 200) return J519Asked{J519Request::kStart, number(4)};
  if (datagram.size() == 8 && number(0) == 2) return J519Asked{J519Request::kStop, number(4)};
  if (datagram.size() == 28 && number(0) == 7)
    return J519Asked{J519Request::kCapability, number(4)};
  return std::nullopt;
}

}  // namespace arcstart::cell_simulator
