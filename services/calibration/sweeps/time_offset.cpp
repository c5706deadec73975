#include "services/calibration/sweeps/time_offset.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "services/calibration/sweeps/time_offset_adjustment.hpp"

namespace arcstart::calibration {
namespace {

constexpr double kReach = 0.15;           // s to either side of the offset known
constexpr double kSampleTolerance = 0.6;  // mm: rough tables are flat
constexpr double kLeastApproach = 0.05;   // share of the motion across a face
constexpr double kAlike = 1.5;            // ratio of speeds below which they tell the same
constexpr double kWorthless = 2e-3;       // s, standard deviation of an answer that is none
constexpr double kDoubtful = 0.3e-3;      // s, and of one that is not good
constexpr double kPlayDeviation = 0.1;    // mm

std::vector<SweptPiece> pieces_of(const SweepData& record, const Calibration& calibration,
                                  const std::vector<SteadySweep>& sweeps) {
  std::vector<SweptPiece> pieces;
  for (std::size_t s = 0; s < sweeps.size(); ++s)
    for (std::size_t i = sweeps[s].first; i <= sweeps[s].last; ++i)
      for (const auto& segment : record.stripes[i].segments)
        for (StraightPiece& piece : straight_pieces(calibration.sensor_model, segment))
          pieces.push_back({i, s, record.stripes[i].utime, std::move(piece)});
  return pieces;
}

// The offset with which the sweeps see the fewest and largest faces: with a wrong one each face
// stands there several times. In steps of the tolerance at the highest speed.
OffsetState coarse(const OffsetProblem& problem, double around_s, double fastest_mm_s) {
  const double step = std::clamp(kSampleTolerance / fastest_mm_s, 0.002, 0.02);
  const int steps = static_cast<int>(std::ceil(kReach / step));
  OffsetState best;
  double most = 0;
  for (int i = 0; i <= 2 * steps; ++i) {
    // Near ones first: one farther off must explain more.
    const double offset = around_s + step * (i % 2 == 0 ? -i / 2 : (i + 1) / 2);
    std::vector<Eigen::Vector3d> points;
    for (const auto& piece : problem.carried(offset))
      for (const MovingPoint& point : piece) points.push_back(point.position);
    if (points.size() < 3) continue;
    const std::vector<FlatFace> faces = flat_faces(points, kSampleTolerance);
    double score = 0;
    for (const FlatFace& face : faces) score += std::pow(face.points, 2);
    if (score > 1.01 * most) {
      most = score;
      best = {offset, 0, faces};
    }
  }
  return best;
}

// RMS distance of the pieces from their faces, carried with another offset.
double distance_rms(const OffsetProblem& problem, const OffsetAdjustment& found, double offset_s) {
  const auto points = problem.carried(offset_s);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (found.face_of[i] >= 0)
      for (const MovingPoint& point : points[i]) {
        sum += std::pow(
            found.state.faces[static_cast<std::size_t>(found.face_of[i])].plane.signed_distance(
                point.position),
            2);
        ++count;
      }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

// What each sweep saw: how fast it ran across the faces, and which offset it has alone.
std::vector<SweepFinding> sweeps_alone(const SweepData& record, const OffsetProblem& problem,
                                       const std::vector<SteadySweep>& sweeps,
                                       const std::vector<SweptPiece>& pieces,
                                       const OffsetAdjustment& found) {
  std::vector<SweepFinding> result(sweeps.size());
  std::vector<double> information(sweeps.size(), 0), gradient(sweeps.size(), 0);
  const auto points = problem.carried(found.state.offset_s);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (found.face_of[i] < 0) continue;
    const std::size_t sweep = pieces[i].sweep;
    const FlatFace& face = found.state.faces[static_cast<std::size_t>(found.face_of[i])];
    double approach = 0, height = 0;
    for (const MovingPoint& point : points[i]) {
      approach += face.plane.normal.dot(point.velocity);
      height += face.plane.signed_distance(point.position +
                                           found.state.play_mm * point.velocity.normalized());
    }
    approach /= static_cast<double>(points[i].size());
    height /= static_cast<double>(points[i].size());
    information[sweep] += approach * approach;
    gradient[sweep] += approach * height;
    if (std::abs(approach) > std::abs(result[sweep].approach_mm_s))
      result[sweep].approach_mm_s = approach;
  }
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    SweepFinding& finding = result[s];
    finding.scan_id = record.stripes[sweeps[s].first].scan_id;
    finding.speed_mm_s = sweeps[s].velocity.norm();
    finding.stripes = static_cast<int>(sweeps[s].last - sweeps[s].first + 1);
    if (!(information[s] > 0)) continue;
    finding.offset_s = found.state.offset_s - gradient[s] / information[s];
    finding.deviation_s = found.sweep_deviation_mm[s] / std::sqrt(information[s]);
  }
  return result;
}

// The largest share of a sweep's motion that runs across a face it saw.
double largest_approach(const std::vector<SweepFinding>& sweeps) {
  double largest = 0;
  for (const SweepFinding& sweep : sweeps)
    if (sweep.speed_mm_s > 0)
      largest = std::max(largest, std::abs(sweep.approach_mm_s) / sweep.speed_mm_s);
  return largest;
}

// Slowest and fastest speed across the faces.
std::pair<double, double> approach_speeds(const std::vector<SweepFinding>& sweeps) {
  double slowest = 1e9, fastest = 0;
  for (const SweepFinding& sweep : sweeps) {
    if (sweep.approach_mm_s == 0) continue;
    slowest = std::min(slowest, std::abs(sweep.approach_mm_s));
    fastest = std::max(fastest, std::abs(sweep.approach_mm_s));
  }
  return {slowest, fastest};
}

constexpr const char* kHow =
    "sweep to and fro over a flat face, at two speeds one twice the other, so that the sensor also "
    "comes nearer and goes away";

void judge(TimeOffset& result) {
  const auto [slowest, fastest] = approach_speeds(result.sweeps);
  if (fastest < kAlike * slowest)
    result.warnings.push_back(fmt::format(
        "all sweeps cross the faces at speeds too alike, {:.0f} to {:.0f} mm/s: a robot's play of "
        "{} mm would look like a time offset, which the deviation says; sweep also at twice or "
        "half the speed",
        slowest, fastest, kPlayDeviation));
  if (result.deviation_s > kDoubtful)
    result.warnings.push_back(
        fmt::format("the offset is known to {:.2f} ms only: sweep more often, or faster",
                    1e3 * result.deviation_s));
  for (const SweepFinding& sweep : result.sweeps) {
    const double off = std::abs(sweep.offset_s - result.offset_s);
    if (sweep.deviation_s > 0 && off > 5e-4 && off > 5 * sweep.deviation_s)
      result.warnings.push_back(fmt::format(
          "the sweep of {} stripes at {:.0f} mm/s has {:.2f} ms for itself: the offset is not the "
          "same all the time, or something moved",
          sweep.stripes, sweep.speed_mm_s, 1e3 * sweep.offset_s));
  }
  if (std::abs(result.play_mm) > std::max(0.05, 3 * result.play_deviation_mm))
    result.warnings.push_back(
        fmt::format("what is seen is shifted by {:.3f} mm against the motion at every speed: play "
                    "in the robot or the mount",
                    -result.play_mm));
}

}  // namespace

TimeOffset find_time_offset(const SweepData& record, const Calibration& calibration) {
  TimeOffset result;
  const std::vector<SteadySweep> steady = steady_sweeps(record, calibration);
  if (steady.empty()) {
    result.refused = std::string(
                         "no sweep of five stripes or more at a steady speed with "
                         "positions: ") +
                     kHow;
    return result;
  }
  double fastest = 0;
  for (const SteadySweep& sweep : steady) fastest = std::max(fastest, sweep.velocity.norm());
  const std::vector<SweptPiece> pieces = pieces_of(record, calibration, steady);
  const OffsetProblem problem(record, calibration.T_tool_camera, pieces, steady.size());
  const OffsetState start = coarse(problem, calibration.time_offset, fastest);
  if (start.faces.empty()) {
    result.refused = std::string("no flat face is seen by the sweeps: ") + kHow;
    return result;
  }
  const OffsetAdjustment found = problem.adjust(start, kPlayDeviation);
  if (!found.solved) {
    result.refused = std::string("the sweeps have no face in common: ") + kHow;
    return result;
  }
  result.offset_s = found.state.offset_s;
  result.deviation_s = std::sqrt(std::max(0.0, found.covariance(0, 0)));
  result.play_mm = found.state.play_mm;
  result.play_deviation_mm = std::sqrt(std::max(0.0, found.covariance(1, 1)));
  result.faces = found.state.faces;
  result.residual_mm = distance_rms(problem, found, found.state.offset_s);
  result.sweeps = sweeps_alone(record, problem, steady, pieces, found);
  result.approach = largest_approach(result.sweeps);
  for (const SweepFinding& sweep : result.sweeps) result.stripes += sweep.stripes;
  if (result.approach < kLeastApproach) {
    result.refused = fmt::format(
        "all faces lie parallel to the motion, within {:.1f} deg: such a face looks the same at "
        "any offset; {}, or tilt the plate",
        std::asin(kLeastApproach) * 180 / EIGEN_PI, kHow);
    return result;
  }
  if (!(result.deviation_s < kWorthless)) {
    result.refused = fmt::format(
        "the offset could be {:.1f} ms more or less: sweeps of one direction and speed, or too "
        "few; {}",
        1e3 * result.deviation_s, kHow);
    return result;
  }
  result.unmended_mm = distance_rms(problem, found, calibration.time_offset);
  judge(result);
  return result;
}

Calibration with_time_offset(const Calibration& calibration, const TimeOffset& found) {
  Calibration changed = calibration;
  changed.id.clear();
  changed.time_offset = found.offset_s;
  constexpr const char* kPart = "; time offset from ";
  changed.origin = fmt::format("{}{}{} stripes of {} sweeps, {:.2f} +- {:.2f} ms",
                               calibration.origin.substr(0, calibration.origin.find(kPart)), kPart,
                               found.stripes, found.sweeps.size(), 1e3 * found.offset_s,
                               1e3 * found.deviation_s);
  constexpr std::size_t n = Calibration::kParameters;
  if (changed.covariance.size() == n * n) {
    // Camera, plane and hand-eye were held: nothing is said of how they hang together with it.
    for (std::size_t i = 0; i < n; ++i)
      changed.covariance[(n - 1) * n + i] = changed.covariance[i * n + n - 1] = 0;
    changed.covariance.back() = found.deviation_s * found.deviation_s;
  }
  return changed;
}

}  // namespace arcstart::calibration
