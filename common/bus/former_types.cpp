#include "common/bus/former_types.hpp"

#include <array>
#include <utility>

namespace arcstart {
namespace {

// Hashes of the types that have changed since, as lcmtypes/fingerprints.txt held them until then. A
// change of a type adds its line here.
constexpr std::array<std::pair<std::uint64_t, const char*>, 9> kFormerTypes = {{
    {0xcc0bc3c8dfcfe2cb, "calibration_t"},
    {0x41468eb3e0ffa7b7, "camera_command_t"},
    {0x3c000d0d77f4ada4, "image_t"},
    {0x3878b0cb49009ba6, "profile_t"},
    {0x1b180dbd77ef4b7b, "robot_pose_t"},
    {0x21ed00ebdb693557, "scan_command_t"},
    {0x40b1b1f24f20b6dc, "scan_t"},
    {0x34d1f5e9588532a3, "seam_t"},
    {0x54c036e723b96b52, "stripe_t"},
}};

}  // namespace

std::string former_type(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 8) return "";
  std::uint64_t hash = 0;
  for (const std::uint8_t byte : bytes.first(8)) hash = hash << 8 | byte;
  for (const auto& [former, name] : kFormerTypes)
    if (hash == former) return name;
  return "";
}

std::string undecodable_reason(std::span<const std::uint8_t> bytes, const std::string& type) {
  const std::string former = former_type(bytes);
  if (former.empty()) return "not a " + type + " of this version, or damaged";
  return former +
         " of the version before this one: bring its sender to this version; a recording of it "
         "must "
         "be made again, or replayed by the version that made it";
}

}  // namespace arcstart
