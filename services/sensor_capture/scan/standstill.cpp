#include "services/sensor_capture/scan/standstill.hpp"

namespace arcstart::sensor_capture {
namespace {

constexpr std::int64_t kLongestGap = 500'000;  // us

}  // namespace

bool Standstill::take(std::int64_t utime, const Eigen::Vector3d& position,
                      const Eigen::Quaterniond& rotation) {
  const Place here{utime, position, rotation};
  const bool gap = standing_ && utime - last_utime_ > kLongestGap;
  last_utime_ = utime;
  if (!standing_) {
    standing_ = here;
  } else if (apart(*standing_, here)) {
    moved_ = true;
    standing_ = here;
  } else if (gap) {
    standing_ = here;
  }
  return moved_ && static_cast<double>(utime - standing_->utime) >= settings_.duration_s * 1e6;
}

bool Standstill::apart(const Place& a, const Place& b) const {
  return (a.position - b.position).norm() > settings_.distance_mm ||
         a.rotation.angularDistance(b.rotation) > settings_.angle_deg * EIGEN_PI / 180;
}

}  // namespace arcstart::sensor_capture
