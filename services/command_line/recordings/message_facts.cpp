#include "services/command_line/recordings/message_facts.hpp"

#include <fmt/core.h>

#include <array>
#include <string_view>
#include <utility>

namespace arcstart::command_line {
namespace {

// Longer endings first: LASER0_SCAN_COMMAND ends with no other, but names are looked up in this
// order.
constexpr std::array<std::pair<std::string_view, ChannelKind>, 14> kEndings = {{
    {"_SCAN_COMMAND", ChannelKind::kScanCommand},
    {"_CAMERA_COMMAND", ChannelKind::kCameraCommand},
    {"_CALIBRATION_COMMAND", ChannelKind::kCalibrationCommand},
    {"_CALIBRATION_CAPTURE", ChannelKind::kCalibrationCapture},
    {"_CALIBRATION", ChannelKind::kCalibration},
    {"_DELIVERY", ChannelKind::kDelivery},
    {"_PREVIEW", ChannelKind::kPreview},
    {"_PROFILE", ChannelKind::kProfile},
    {"_STRIPE", ChannelKind::kStripe},
    {"_STATUS", ChannelKind::kStatus},
    {"_IMAGE", ChannelKind::kImage},
    {"_SCAN", ChannelKind::kScan},
    {"_SEAM", ChannelKind::kSeam},
    {"_POSE", ChannelKind::kPose},
}};

std::int64_t big_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + 8; ++i) value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value);
}

std::int64_t type_hash(ChannelKind kind) {
  switch (kind) {
    case ChannelKind::kImage:
      return image_t::getHash();
    case ChannelKind::kStripe:
      return stripe_t::getHash();
    case ChannelKind::kProfile:
      return profile_t::getHash();
    case ChannelKind::kPose:
      return robot_pose_t::getHash();
    default:
      return 0;
  }
}

template <class Message>
std::string error_of(const std::vector<std::uint8_t>& bytes) {
  Message message;
  return decode(bytes, message);
}

}  // namespace

ChannelKind channel_kind(const std::string& channel) {
  if (channel == "CELL_COMMAND") return ChannelKind::kCellCommand;
  if (channel == "CELL_TRUTH") return ChannelKind::kCellTruth;
  if (channel == "CLOCK_PROBE") return ChannelKind::kClockProbe;
  for (const auto& [ending, kind] : kEndings)
    if (channel.size() > ending.size() && channel.ends_with(ending)) return kind;
  return ChannelKind::kUnknown;
}

std::string channel_instance(const std::string& channel) {
  for (const auto& [ending, kind] : kEndings)
    if (kind != ChannelKind::kStatus && channel.size() > ending.size() && channel.ends_with(ending))
      return channel.substr(0, channel.size() - ending.size());
  return "";
}

bool is_measurement(ChannelKind kind) { return type_hash(kind) != 0; }

std::string message_error(ChannelKind kind, const std::vector<std::uint8_t>& bytes) {
  switch (kind) {
    case ChannelKind::kImage:
    case ChannelKind::kPreview:
      return error_of<image_t>(bytes);
    case ChannelKind::kPose:
      return error_of<robot_pose_t>(bytes);
    case ChannelKind::kStripe:
      return error_of<stripe_t>(bytes);
    case ChannelKind::kProfile:
      return error_of<profile_t>(bytes);
    case ChannelKind::kScan:
      return error_of<scan_t>(bytes);
    case ChannelKind::kScanCommand:
      return error_of<scan_command_t>(bytes);
    case ChannelKind::kCameraCommand:
      return error_of<camera_command_t>(bytes);
    case ChannelKind::kCalibration:
      return error_of<calibration_t>(bytes);
    case ChannelKind::kCalibrationCommand:
      return error_of<calibration_command_t>(bytes);
    case ChannelKind::kCalibrationCapture:
      return error_of<calibration_capture_t>(bytes);
    case ChannelKind::kSeam:
      return error_of<seam_t>(bytes);
    case ChannelKind::kStatus:
      return error_of<service_status_t>(bytes);
    case ChannelKind::kDelivery:
      return error_of<delivery_t>(bytes);
    case ChannelKind::kCellCommand:
      return error_of<cell_command_t>(bytes);
    case ChannelKind::kCellTruth:
      return error_of<truth_t>(bytes);
    case ChannelKind::kClockProbe:
      return error_of<clock_probe_t>(bytes);
    case ChannelKind::kUnknown:
      break;
  }
  return "";
}

std::string read_source(ChannelKind kind, std::span<const std::uint8_t> first_bytes,
                        Source& source) {
  // The hash of a type without nested types is the first word on the wire as it stands.
  if (first_bytes.size() < Source::kBytes) return "too short";
  if (big_endian(first_bytes, 0) != type_hash(kind)) {
    const std::string former = former_type(first_bytes);
    return former.empty() ? "of another type or version" : former + " of the version before";
  }
  source.utime = big_endian(first_bytes, 8);
  source.run_id = big_endian(first_bytes, 16);
  source.seq = big_endian(first_bytes, 24);
  source.scan_id = kind == ChannelKind::kPose ? 0 : big_endian(first_bytes, 32);
  return "";
}

std::string printable(const std::string& text, std::size_t longest) {
  std::string line;
  for (const char character : text) {
    if (line.size() >= longest) return line + "...";
    const auto byte = static_cast<unsigned char>(character);
    if (byte >= 0x20 && byte < 0x7f)
      line += character;
    else
      line += fmt::format("\\x{:02x}", byte);
  }
  return line;
}

}  // namespace arcstart::command_line
