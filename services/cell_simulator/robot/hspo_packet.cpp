#include "services/cell_simulator/robot/hspo_packet.hpp"

#include <bit>

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::uint16_t kActualTool = 1, kActualJoints = 4;

class BigEndianWriter {
 public:
  void u16(std::uint16_t value) {
    bytes_.push_back(static_cast<std::uint8_t>(value >> 8));
    bytes_.push_back(static_cast<std::uint8_t>(value));
  }
  void u32(std::uint32_t value) {
    u16(static_cast<std::uint16_t>(value >> 16));
    u16(static_cast<std::uint16_t>(value));
  }
  template <class Values>
  void section(std::uint16_t motion_group, const Values& values) {
    u16(motion_group);
    for (const float value : values) u32(std::bit_cast<std::uint32_t>(value));
    u32(0);  // status
    u32(0);  // I/O
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::vector<std::uint8_t> hspo_packet(const HspoReport& report) {
  BigEndianWriter writer;
  writer.u32(kVersion);
  writer.u32(report.index);
  writer.u32(report.clock);
  writer.u16(static_cast<std::uint16_t>((report.tool ? kActualTool : 0) |
                                        (report.joints ? kActualJoints : 0)));
  if (report.tool) writer.section(report.motion_group, *report.tool);
  if (report.joints) writer.section(report.motion_group, *report.joints);
  return writer.take();
}

}  // namespace arcstart::cell_simulator
