// The words by which STATUS names the answer that a seam_finding gave, so that whoever waits for it
// can tell it from another's.
#pragma once

#include <arcstart/seam_t.hpp>
#include <cstdint>
#include <span>
#include <string>

namespace arcstart::seam_finding {

// What precedes the digest: "answer to scan 5: ".
std::string answer_mark_of_scan(std::int64_t scan_id);

// The whole: with the CRC-32C of the message, in eight hexadecimal digits.
std::string answer_mark(std::int64_t scan_id, std::span<const std::uint8_t> encoded_seam);
std::string answer_mark(const seam_t& seam);

}  // namespace arcstart::seam_finding
