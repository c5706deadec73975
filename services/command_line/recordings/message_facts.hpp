// What a message tells of itself, whatever its type: which type a channel carries, and the fields
// all measurements begin with. For the monitor and for recordings, which meet every channel.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/bus/former_types.hpp"
#include "common/bus/message_checks.hpp"

namespace arcstart::command_line {

enum class ChannelKind {
  kImage,
  kPreview,
  kPose,
  kStripe,
  kProfile,
  kScan,
  kScanCommand,
  kCameraCommand,
  kCalibration,
  kCalibrationCommand,
  kCalibrationCapture,
  kSeam,
  kStatus,
  kCellCommand,
  kCellTruth,
  kClockProbe,
  kDelivery,
  kUnknown
};

// By the channel's name: LASER0_IMAGE is kImage, any other name kUnknown.
ChannelKind channel_kind(const std::string& channel);

// LASER0 of LASER0_IMAGE; empty where the kind is unknown or of the cell.
std::string channel_instance(const std::string& channel);

// Those that count their messages in seq, a gap being a loss: image, pose, stripe, profile.
bool is_measurement(ChannelKind kind);

// Decodes to the last byte and checks the meaning; returns why it cannot, empty where it could.
template <class Message>
std::string decode(const std::vector<std::uint8_t>& bytes, Message& message) {
  const int size = static_cast<int>(bytes.size());
  message = {};  // fresh: lcm-gen leaves old elements in a vector whose count is 0
  if (message.decode(bytes.data(), 0, size) != size)
    return undecodable_reason(bytes, Message::getTypeName());
  return meaning_error(message);
}

// Why these bytes are no message of that kind, empty where they are. Of kUnknown nothing can be
// said: empty.
std::string message_error(ChannelKind kind, const std::vector<std::uint8_t>& bytes);

// The fields with which every measurement begins.
struct Source {
  static constexpr std::size_t kBytes =
      8 + 8 + 8 + 8 + 8;  // of a message's beginning: hash, and the fields below

  std::int64_t utime = 0, run_id = 0, seq = 0;
  std::int64_t scan_id = 0;  // 0 for a pose
};

// Reads them from the first bytes of a measurement, so that an image need not be read to be put in
// its place. Returns why they cannot be read (another type, too short), empty where they could.
std::string read_source(ChannelKind kind, std::span<const std::uint8_t> first_bytes,
                        Source& source);

// A text from outside for a line of a terminal: what is not printable ASCII becomes \xNN, what is
// too long is cut.
std::string printable(const std::string& text, std::size_t longest = 200);

}  // namespace arcstart::command_line
