#include "tests/system/lossy_relay.hpp"

#include "common/time.hpp"

namespace arcstart {
namespace {

BusSettings at_port(int port) {
  BusSettings settings;
  settings.port = port;
  return settings;
}

}  // namespace

LossyRelay::LossyRelay(int near, int far, std::uint32_t seed)
    : near_(at_port(near)), far_(at_port(far)), random_(seed) {
  for (const std::string channel :
       {"LASER0_IMAGE", "LASER0_SCAN", "LASER0_CALIBRATION", "ROBOT0_POSE"})
    near_.subscribe_pattern(
        channel, Queue::measurements(),
        [this](const Bus::Bytes& bytes, const std::string& from) { carry(bytes, from); });
  for (const std::string channel : {"LASER0_SEAM", "LASER0_EXTRACTION_STATUS",
                                    "LASER0_RECONSTRUCTION_STATUS", "LASER0_SEAM_FINDING_STATUS"})
    far_.subscribe_pattern(channel, Queue::measurements(),
                           [this](const Bus::Bytes& bytes, const std::string& from) {
                             near_.publish_bytes(from, bytes);
                           });
  thread_ = std::jthread([this](const std::stop_token& end) { run(end); });
}

void LossyRelay::set(const LinkFaults& faults) {
  const std::lock_guard lock(guard_);
  faults_ = faults;
}

void LossyRelay::take_down(std::int64_t us) {
  const std::lock_guard lock(guard_);
  down_until_ = steady_now() + us;
}

void LossyRelay::carry(const Bus::Bytes& bytes, const std::string& channel) {
  const std::lock_guard lock(guard_);
  std::uniform_real_distribution<double> draw(0, 1);
  const bool is_lost = draw(random_) < faults_.lost, is_doubled = draw(random_) < faults_.doubled,
             is_delayed = draw(random_) < faults_.delayed;
  const std::int64_t now = steady_now();
  if (is_lost || now < down_until_) {
    ++lost_;
    return;
  }
  if (is_delayed) {
    waiting_.push_back({now + faults_.delay_us, channel, bytes});
    return;
  }
  far_.publish_bytes(channel, bytes);
  if (!is_doubled) return;
  ++doubled_;
  far_.publish_bytes(channel, bytes);
}

void LossyRelay::run(const std::stop_token& end) {
  while (!end.stop_requested()) {
    near_.handle(std::chrono::milliseconds(2));
    far_.handle(std::chrono::milliseconds(0));
    for (; !waiting_.empty() && waiting_.front().due <= steady_now(); waiting_.pop_front())
      far_.publish_bytes(waiting_.front().channel, waiting_.front().bytes);
  }
}

}  // namespace arcstart
