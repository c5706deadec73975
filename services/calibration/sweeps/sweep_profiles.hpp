// Stripes taken while the robot moves: what of them is straight, and where the robot ran steadily.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/calibration.hpp"
#include "services/reconstruction/trajectory_queue.hpp"

namespace arcstart::calibration {

struct SweepProfile {
  std::int64_t utime = 0;    // middle of the exposure, as stamped; us
  std::int64_t scan_id = 0;  // 0 outside a scan
  // Centres in order, segment by segment; distorted pixels.
  std::vector<std::vector<Eigen::Vector2d>> segments;
};

// One sensor's stripes and its robot's way, both in order of time.
struct SweepData {
  std::vector<SweepProfile> stripes;
  reconstruction::TrajectoryQueue trajectory{std::int64_t{3600} * 1'000'000,
                                             100'000};  // an hour; 100 ms
};

// A straight part of a stripe, as a few points in camera spread evenly over it, each the mean of
// its neighbourhood; mm.
using StraightPiece = std::vector<Eigen::Vector3d>;

// A segment parted where it bends by more than the table's roughness would; parts shorter than
// 10 mm are left out, and so are centres that do not show the laser plane.
std::vector<StraightPiece> straight_pieces(const SensorModel& model,
                                           const std::vector<Eigen::Vector2d>& segment);

// Where a point that moves with the camera is, and how fast it moves.
struct MovingPoint {
  Eigen::Vector3d position, velocity;  // in base; mm, mm/s
};

// The sensor about one instant of the robot's clock.
class SensorMotion {
 public:
  // Nothing where the robot's positions do not reach from a twentieth of a second before to one
  // after.
  static std::optional<SensorMotion> at(const reconstruction::TrajectoryQueue& trajectory,
                                        const RigidTransform& T_tool_camera, std::int64_t utime);
  MovingPoint point(const Eigen::Vector3d& in_camera) const;

 private:
  RigidTransform now_, before_, after_;  // T_base_camera
};

// Stripes first, first + 1 ... last, over which the robot kept its velocity.
struct SteadySweep {
  std::size_t first, last;
  Eigen::Vector3d velocity;  // mean, of a point of the laser plane ahead of the camera; mm/s
};

// Runs of five stripes and more at one velocity within 10 %, above 2 mm/s.
std::vector<SteadySweep> steady_sweeps(const SweepData& record, const Calibration& calibration);

}  // namespace arcstart::calibration
