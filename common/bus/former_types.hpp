// Messages of the version before, told from damaged ones by the hash with which they begin.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace arcstart {

// The type of the version before whose hash these bytes begin with, "image_t"; empty for none.
std::string former_type(std::span<const std::uint8_t> bytes);

// Why these bytes could not be decoded as this type: of the version before, with what to do, or of
// another type, or damaged.
std::string undecodable_reason(std::span<const std::uint8_t> bytes, const std::string& type);

}  // namespace arcstart
