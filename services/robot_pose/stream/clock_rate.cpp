#include "services/robot_pose/stream/clock_rate.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr std::int64_t kWindow = 2'000'000;
constexpr std::int64_t kShortest = 200'000;
constexpr std::size_t kFewest = 5;

}  // namespace

void ClockRate::take(std::int64_t ticks, std::int64_t arrival_us) {
  reports_.push_back({ticks, arrival_us});
  while (arrival_us - reports_.front().arrival_us > kWindow) reports_.pop_front();
  const Report& first = reports_.front();
  if (reports_.size() < kFewest || arrival_us - first.arrival_us < kShortest) return;
  if (ticks <= first.ticks) return;
  tick_us_ =
      static_cast<double>(arrival_us - first.arrival_us) / static_cast<double>(ticks - first.ticks);
}

}  // namespace arcstart::robot_pose
