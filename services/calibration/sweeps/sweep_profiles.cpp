#include "services/calibration/sweeps/sweep_profiles.hpp"

#include <algorithm>
#include <cmath>

#include "common/time.hpp"

namespace arcstart::calibration {
namespace {

constexpr double kBend = 0.6;      // mm from the chord: rough tables stay one piece, corners do not
constexpr double kShortest = 10;   // of a piece; mm
constexpr std::size_t kNodes = 6;  // of a piece
constexpr std::size_t kFewest = 24;        // centres of a piece
constexpr std::int64_t kApart = 50'000;    // us to either side, over which a velocity is taken
constexpr std::size_t kFewestStripes = 5;  // of a sweep
constexpr double kSlowest = 2;             // mm/s
constexpr double kSteady = 0.1;            // change of the velocity, as a share of it

using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d mean(const Points& points, std::size_t begin, std::size_t end) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = begin; i < end; ++i) sum += points[i];
  return sum / static_cast<double>(end - begin);
}

// Cuts at the point farthest from the chord, until nothing lies farther than a bend.
void part(const Points& points, std::size_t begin, std::size_t end,
          std::vector<StraightPiece>& pieces) {
  if (end - begin < kFewest) return;
  const std::size_t few = kFewest / 6;
  const Eigen::Vector3d from = mean(points, begin, begin + few), to = mean(points, end - few, end);
  const double length = (to - from).norm();
  if (length < kShortest) return;
  const Eigen::Vector3d along = (to - from) / length;
  std::size_t farthest = begin;
  double distance = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const Eigen::Vector3d way = points[i] - from;
    const double d = (way - along.dot(way) * along).norm();
    if (d > distance) distance = d, farthest = i;
  }
  if (distance > kBend) {
    // An end that lies off by itself is cut off alone.
    const std::size_t cut = std::clamp(farthest, begin + 1, end - 1);
    part(points, begin, cut, pieces);
    return part(points, cut, end, pieces);
  }
  StraightPiece piece;
  for (std::size_t node = 0; node < kNodes; ++node)
    piece.push_back(mean(points, begin + (end - begin) * node / kNodes,
                         begin + (end - begin) * (node + 1) / kNodes));
  pieces.push_back(std::move(piece));
}

}  // namespace

std::vector<StraightPiece> straight_pieces(const SensorModel& model,
                                           const std::vector<Eigen::Vector2d>& segment) {
  Points points;
  for (const Eigen::Vector2d& pixel : segment)
    if (const auto point = camera_point(model, pixel.x(), pixel.y())) points.push_back(*point);
  std::vector<StraightPiece> pieces;
  part(points, 0, points.size(), pieces);
  return pieces;
}

std::optional<SensorMotion> SensorMotion::at(const reconstruction::TrajectoryQueue& trajectory,
                                             const RigidTransform& T_tool_camera,
                                             std::int64_t utime) {
  const auto before = trajectory.at(utime - kApart), now = trajectory.at(utime),
             after = trajectory.at(utime + kApart);
  for (const auto* lookup : {&before, &now, &after})
    if (lookup->state != reconstruction::TrajectoryQueue::State::found) return std::nullopt;
  SensorMotion motion;
  motion.before_ = before.T_base_tool * T_tool_camera;
  motion.now_ = now.T_base_tool * T_tool_camera;
  motion.after_ = after.T_base_tool * T_tool_camera;
  return motion;
}

MovingPoint SensorMotion::point(const Eigen::Vector3d& in_camera) const {
  return {now_ * in_camera,
          (after_ * in_camera - before_ * in_camera) / (2e-6 * static_cast<double>(kApart))};
}

std::vector<SteadySweep> steady_sweeps(const SweepData& record, const Calibration& calibration) {
  // Where the optical axis meets the laser plane.
  const Plane& laser = calibration.sensor_model.laser_plane;
  const Eigen::Vector3d ahead =
      Eigen::Vector3d::UnitZ() *
      (laser.normal.z() != 0 ? std::abs(laser.offset / laser.normal.z()) : 0.0);
  const std::int64_t offset = seconds_to_us(calibration.time_offset);
  std::vector<SteadySweep> sweeps;
  std::optional<SteadySweep> run;
  const auto end_run = [&] {
    if (run && run->last - run->first + 1 >= kFewestStripes) sweeps.push_back(*run);
    run.reset();
  };
  for (std::size_t i = 0; i < record.stripes.size(); ++i) {
    const SweepProfile& stripe = record.stripes[i];
    const auto motion =
        SensorMotion::at(record.trajectory, calibration.T_tool_camera, stripe.utime + offset);
    if (!motion || stripe.segments.empty()) continue;
    const Eigen::Vector3d velocity = motion->point(ahead).velocity;
    const bool goes_on = run && record.stripes[run->last].scan_id == stripe.scan_id &&
                         (velocity - run->velocity).norm() < kSteady * run->velocity.norm();
    if (!goes_on) end_run();
    if (velocity.norm() < kSlowest) continue;
    if (!run) run = SteadySweep{i, i, velocity};
    const auto count = static_cast<double>(i - run->first + 1);
    run->velocity += (velocity - run->velocity) / count;
    run->last = i;
  }
  end_run();
  return sweeps;
}

}  // namespace arcstart::calibration
