#include "services/seam_finding/scan/answer_mark.hpp"

#include <fmt/core.h>

#include <vector>

#include "common/bus/crc32c.hpp"

namespace arcstart::seam_finding {

std::string answer_mark_of_scan(std::int64_t scan_id) {
  return fmt::format("answer to scan {}: ", scan_id);
}

std::string answer_mark(std::int64_t scan_id, std::span<const std::uint8_t> encoded_seam) {
  return answer_mark_of_scan(scan_id) + fmt::format("{:08x}", crc32c(encoded_seam));
}

std::string answer_mark(const seam_t& seam) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(seam.getEncodedSize()));
  seam.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return answer_mark(seam.scan_id, bytes);
}

}  // namespace arcstart::seam_finding
