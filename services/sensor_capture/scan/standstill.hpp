// Has the tool moved, and then stood still? Judged by the robot's positions alone.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

namespace arcstart::sensor_capture {

struct StandstillSettings {
  double duration_s = 0.5;   // to stand still
  double distance_mm = 0.3;  // that counts as movement: above the positions' noise
  double angle_deg = 0.1;    // likewise
};

class Standstill {
 public:
  explicit Standstill(const StandstillSettings& settings) : settings_(settings) {}

  // Forgets all: the first position from now on is where the tool began.
  void restart() { *this = Standstill(settings_); }

  // Positions in order of time: us, UTC; mm; unit quaternion. True as soon as the tool has moved
  // from where it began and then stood for the duration. Half a second without positions proves
  // nothing: standing begins anew after it.
  bool take(std::int64_t utime, const Eigen::Vector3d& position,
            const Eigen::Quaterniond& rotation);

 private:
  struct Place {
    std::int64_t utime;
    Eigen::Vector3d position;
    Eigen::Quaterniond rotation;
  };
  bool apart(const Place& a, const Place& b) const;

  StandstillSettings settings_;
  std::optional<Place> standing_;  // since when and where
  std::int64_t last_utime_ = 0;
  bool moved_ = false;
};

}  // namespace arcstart::sensor_capture
