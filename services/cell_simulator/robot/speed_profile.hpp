// Distance over time of a move that ends at rest, with one acceleration.
#pragma once

#include <algorithm>
#include <cmath>

namespace arcstart::cell_simulator {

// A trapezoid: speeds up, runs at its top speed, slows down to rest. Time in s from its begin,
// distance in mm.
class SpeedProfile {
 public:
  // From rest to rest over `distance`; where that is too short for `speed` it becomes a triangle.
  static SpeedProfile travel(double distance, double speed, double acceleration) {
    SpeedProfile profile;
    profile.acceleration_ = acceleration;
    profile.top_speed_ = std::min(speed, std::sqrt(acceleration * distance));
    profile.distance_ = distance;
    if (distance <= 0) return profile;
    profile.fast_ = profile.top_speed_ / acceleration;
    profile.slowing_ = distance / profile.top_speed_;
    profile.end_ = profile.slowing_ + profile.fast_;
    return profile;
  }

  // From `speed` to rest.
  static SpeedProfile brake(double speed, double acceleration) {
    SpeedProfile profile;
    profile.acceleration_ = acceleration;
    profile.top_speed_ = speed;
    profile.distance_ = speed * speed / (2 * acceleration);
    profile.end_ = speed / acceleration;
    return profile;
  }

  double duration() const { return end_; }
  double length() const { return distance_; }

  double distance(double time) const {
    if (time <= 0) return 0;
    if (time < fast_) return acceleration_ * time * time / 2;
    if (time < slowing_) return top_speed_ * (time - fast_ / 2);
    if (time < end_) return distance_ - acceleration_ * (end_ - time) * (end_ - time) / 2;
    return distance_;
  }

  double speed(double time) const {
    if (time <= 0 && fast_ > 0) return 0;
    if (time < fast_) return acceleration_ * time;
    if (time < slowing_) return top_speed_;
    if (time < end_) return acceleration_ * (end_ - time);
    return 0;
  }

 private:
  double acceleration_ = 1, top_speed_ = 0, distance_ = 0;
  double fast_ = 0, slowing_ = 0, end_ = 0;  // when top speed is reached, left, and when it stands
};

}  // namespace arcstart::cell_simulator
