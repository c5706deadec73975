// Every message type: whatever bytes come, decoding ends without a crash and allocates in
// proportion to the packet; what decodes to its last byte and has a meaning survives another round.
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <type_traits>
#include <vector>

#include "common/bus/crc32c.hpp"
#include "common/bus/message_checks.hpp"

namespace {

template <class Message>
void feed(const std::uint8_t* data, std::size_t size) {
  // The right hash in front, or nothing beyond it would ever be tried.
  std::vector<std::uint8_t> bytes(8);
  const auto hash = static_cast<std::uint64_t>(Message::getHash());
  for (int i = 0; i < 8; ++i)
    bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
  bytes.insert(bytes.end(), data, data + size);
  Message message{};
  const int length = static_cast<int>(bytes.size());
  if (message.decode(bytes.data(), 0, length) != length) return;
  // No fuzzer guesses a checksum, and hardly anything else that rests on every byte.
  if constexpr (std::is_same_v<Message, arcstart::image_t>)
    message.crc32c = message.data.empty() ? 0 : arcstart::crc32c(message.data);
  if (!arcstart::meaning_error(message).empty()) return;
  std::vector<std::uint8_t> again(static_cast<std::size_t>(message.getEncodedSize()));
  if (message.encode(again.data(), 0, static_cast<int>(again.size())) < 0) std::abort();
  Message second{};
  if (second.decode(again.data(), 0, static_cast<int>(again.size())) !=
      static_cast<int>(again.size()))
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arcstart;
  if (size == 0) return 0;
  constexpr void (*kFeeds[])(const std::uint8_t*, std::size_t) = {feed<image_t>,
                                                                  feed<robot_pose_t>,
                                                                  feed<stripe_t>,
                                                                  feed<profile_t>,
                                                                  feed<scan_t>,
                                                                  feed<scan_command_t>,
                                                                  feed<camera_command_t>,
                                                                  feed<calibration_t>,
                                                                  feed<calibration_command_t>,
                                                                  feed<calibration_capture_t>,
                                                                  feed<seam_t>,
                                                                  feed<service_status_t>,
                                                                  feed<cell_command_t>,
                                                                  feed<clock_probe_t>,
                                                                  feed<delivery_t>,
                                                                  feed<truth_t>};
  kFeeds[data[0] % std::size(kFeeds)](data + 1, size - 1);
  return 0;
}
