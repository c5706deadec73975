// Robots' packets: any bytes are decoded or refused with a reason; what is decoded is finite. The
// first byte chooses the protocol.
#include <cmath>
#include <cstdlib>

#include "services/robot_pose/hspo/hspo_packet.hpp"
#include "services/robot_pose/j519/j519_packet.hpp"
#include "services/robot_pose/rtde/rtde_session.hpp"

using namespace arcstart::robot_pose;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

template <class Values>
void require_finite(const Values& values) {
  for (const double value : values) require(std::isfinite(value));
}

void try_hspo(std::span<const std::uint8_t> bytes) {
  const DecodedHspo decoded = decode_hspo(bytes);
  require(decoded.packet.has_value() == decoded.error.empty());
  if (decoded.packet && decoded.packet->tool) require_finite(*decoded.packet->tool);
  if (decoded.packet && decoded.packet->joints) require_finite(*decoded.packet->joints);
}

void try_j519(std::span<const std::uint8_t> bytes) {
  const DecodedJ519 decoded = decode_j519(bytes);
  require((decoded.status || decoded.capability) == decoded.error.empty());
  if (!decoded.status) return;
  require_finite(decoded.status->position);
  require_finite(decoded.status->joints);
}

// A whole connection in two pieces, after a good handshake or instead of it.
void try_rtde(std::span<const std::uint8_t> bytes, bool shake_hands) {
  RtdeSession session(125, std::nullopt);
  session.begin();
  std::vector<std::uint8_t> good = {0, 4, 'V', 1, 0, 37, 'O', 1};
  for (const char c : std::string("DOUBLE,VECTOR6D,VECTOR6D,VECTOR6D"))
    good.push_back(static_cast<std::uint8_t>(c));
  good.insert(good.end(), {0, 4, 'S', 1});
  if (shake_hands) require(session.take(good, 1'000'000).fault.empty() && session.streaming());
  const std::size_t half = bytes.size() / 2;
  std::int64_t arrival = 2'000'000;
  for (const auto piece : {bytes.first(half), bytes.subspan(half)}) {
    const RtdeSession::Step step = session.take(piece, arrival += 8'000);
    for (const ReportedPosition& position : step.positions) {
      require_finite(position.position);
      require_finite(position.rotation.coeffs());
      require_finite(position.joints);
    }
    require(step.fault.find('\n') == std::string::npos);
    if (!step.fault.empty()) return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  if (data[0] % 4 == 0) try_hspo(bytes);
  if (data[0] % 4 == 1) try_j519(bytes);
  if (data[0] % 4 >= 2) try_rtde(bytes, data[0] % 4 == 3);
  return 0;
}
