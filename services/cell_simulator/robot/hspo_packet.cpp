#include "services/cell_simulator/robot/hspo_packet.hpp"

#include "services/cell_simulator/robot/big_endian_writer.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::uint16_t kActualTool = 1, kActualJoints = 4;

template <class Values>
void add_section(BigEndianWriter& writer, std::uint16_t motion_group, const Values& values) {
  writer.u16(motion_group);
  for (const float value : values) writer.f32(value);
  writer.u32(0);  // status
  writer.u32(0);  // I/O
}

}  // namespace

std::vector<std::uint8_t> hspo_packet(const HspoReport& report) {
  BigEndianWriter writer;
  writer.u32(kVersion);
  writer.u32(report.index);
  writer.u32(report.clock);
  writer.u16(static_cast<std::uint16_t>((report.tool ? kActualTool : 0) |
                                        (report.joints ? kActualJoints : 0)));
  if (report.tool) add_section(writer, report.motion_group, *report.tool);
  if (report.joints) add_section(writer, report.motion_group, *report.joints);
  return writer.take();
}

}  // namespace arcstart::cell_simulator
