// CRC-32C (Castagnoli; RFC 3720, appendix B.4): of an image's bytes, so that damage between the
// camera's host and whoever reads a recording years later does not go unnoticed.
#pragma once

#include <cstdint>
#include <span>

namespace arcstart {

// By the processor's own instruction where it has one (about 8 bytes in 3 cycles), else by tables.
std::uint32_t crc32c(std::span<const std::uint8_t> bytes);

// By tables alone; the same number.
std::uint32_t crc32c_by_tables(std::span<const std::uint8_t> bytes);

}  // namespace arcstart
