// What a robot's controller says by RMI: any bytes are decoded or refused with a reason of one
// line; what is decoded is finite.
#include <cmath>
#include <cstdlib>

#include "services/robot_link/rmi/rmi_text.hpp"

using namespace arcstart::robot_link;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto require = [](bool holds) {
    if (!holds) std::abort();
  };
  const DecodedRmiReply decoded = decode_rmi({reinterpret_cast<const char*>(data), size});
  require(decoded.reply.has_value() == decoded.error.empty());
  require(decoded.error.find('\n') == std::string::npos);
  if (!decoded.reply) return 0;
  if (decoded.reply->value) require(std::isfinite(*decoded.reply->value));
  if (decoded.reply->frame)
    for (const double number : *decoded.reply->frame) require(std::abs(number) <= 1e5);
  return 0;
}
