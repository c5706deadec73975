#include "services/calibration/sweeps/drift_check.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/time.hpp"
#include "services/calibration/adjustment/error_prediction.hpp"
#include "services/calibration/sweeps/ball_fit.hpp"
#include "services/calibration/sweeps/flat_faces.hpp"

namespace arcstart::calibration {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kBallTolerance = 1.5;  // mm: what a calibration may be off and still find the ball
constexpr double kFaceTolerance = 0.6;  // mm: rough tables are flat
constexpr int kEvery = 4;               // of a stripe's centres on the ball
constexpr double kTurn = 20;            // deg between two sides, at least
constexpr double kSameFace = 5;         // deg between the normals, at most
constexpr double kSamePlace = 8;        // mm between the faces, at most
constexpr double kNear = 15;            // mm: both scans see a place where each has points so near
constexpr double kShown = 0.2;          // mm a mm of shift
constexpr double kRepeatability = 0.15;  // mm, of a robot, in what two scans differ by
constexpr double kDeviations = 4;        // of the calibration's own, beyond which it has drifted

double degrees(double radians) { return radians * 180 / EIGEN_PI; }

struct ScannedStripe {
  const SweepProfile* stripe;
  RigidTransform T_base_tool;
};

// By scan, those with a position.
std::map<std::int64_t, std::vector<ScannedStripe>> by_scan(const SweepData& record,
                                                           const Calibration& calibration) {
  std::map<std::int64_t, std::vector<ScannedStripe>> scans;
  for (const SweepProfile& stripe : record.stripes) {
    const auto lookup = record.trajectory.at(stripe.utime + seconds_to_us(calibration.time_offset));
    if (lookup.state == reconstruction::TrajectoryQueue::State::found)
      scans[stripe.scan_id].push_back({&stripe, lookup.T_base_tool});
  }
  return scans;
}

double turn_between(const RigidTransform& a, const RigidTransform& b) {
  return degrees(Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle());
}

double largest_turn(const std::vector<ScanView>& views) {
  double largest = 0;
  for (const ScanView& a : views)
    for (const ScanView& b : views)
      largest = std::max(largest, turn_between(a.T_base_tool, b.T_base_tool));
  return largest;
}

// Each row: what of a shift in tool makes two views differ, as the distance from their mean. Says
// so where a sensor could be shifted unseen in two directions of three or all.
void tell_what_shows(const std::vector<Eigen::RowVector3d>& rows, DriftCheck& result) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double most = 0;
  for (const Eigen::RowVector3d& row : rows) {
    sum += row.transpose() * row;
    most = std::max(most, row.norm());
  }
  if (!(most > 0)) return;
  // Scaled so that more rows alike show no more than one of them.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(sum);
  result.shift_shown = directions.eigenvalues().cwiseMax(0).cwiseSqrt().reverse();
  result.shift_shown *= most / result.shift_shown(0);
  if (result.shift_shown(1) < kShown)
    result.warnings.push_back(fmt::format(
        "a sensor shifted by 1 mm in an awkward direction would change these scans by {:.2f} mm "
        "only: add a scan turned otherwise, or of an upright face, or of a ball",
        result.shift_shown(1)));
}

// Root mean square over what was seen, -1 where the calibration does not say.
double predicted(const SweepData& record, const Calibration& calibration) {
  constexpr int n = Calibration::kParameters;
  if (calibration.covariance.size() != n * n) return -1;
  SetCovariance covariance;
  for (int row = 0; row < kSetParameters; ++row)
    for (int column = 0; column < kSetParameters; ++column)
      covariance(row, column) = calibration.covariance[static_cast<std::size_t>(row * n + column)];
  std::vector<Eigen::Vector2d> pixels;
  for (const SweepProfile& stripe : record.stripes)
    for (const auto& segment : stripe.segments) pixels.push_back(segment[segment.size() / 2]);
  AdjustmentState state;
  state.model = calibration.sensor_model;
  state.T_tool_camera = calibration.T_tool_camera;
  return predicted_rms(state, covariance, pixels);
}

// A scan's faces, each with its points.
struct SeenFace {
  FlatFace face;
  Points points;
};

std::vector<SeenFace> faces_of(const std::vector<ScannedStripe>& scan,
                               const Calibration& calibration) {
  Points points;
  for (const ScannedStripe& seen : scan)
    for (const auto& segment : seen.stripe->segments)
      for (const StraightPiece& piece : straight_pieces(calibration.sensor_model, segment))
        for (const Eigen::Vector3d& node : piece)
          points.push_back(seen.T_base_tool * calibration.T_tool_camera * node);
  std::vector<SeenFace> faces;
  for (const FlatFace& face : flat_faces(points, kFaceTolerance)) {
    SeenFace& seen = faces.emplace_back(SeenFace{face, {}});
    for (const Eigen::Vector3d& point : points)
      if (std::abs(face.plane.signed_distance(point)) < kFaceTolerance)
        seen.points.push_back(point);
  }
  return faces;
}

// RMS over the places that both have seen of half the distance between their planes; nothing where
// they are not the same face.
std::optional<double> disagreement(const SeenFace& a, const SeenFace& b) {
  const double angle = angle_between(a.face.plane.normal, b.face.plane.normal);
  const Plane other = angle > EIGEN_PI / 2 ? b.face.plane.flipped() : b.face.plane;
  if (degrees(std::min<double>(angle, EIGEN_PI - angle)) > kSameFace) return std::nullopt;
  const auto seen_by = [](const Points& points, const Eigen::Vector3d& place) {
    return std::any_of(points.begin(), points.end(), [&](const auto& point) {
      return (point - place).squaredNorm() < kNear * kNear;
    });
  };
  double sum = 0;
  int count = 0;
  const auto add = [&](const Points& points, const Points& others) {
    for (const Eigen::Vector3d& point : points) {
      if (!seen_by(others, point)) continue;
      sum += std::pow(a.face.plane.signed_distance(point) - other.signed_distance(point), 2) / 4;
      ++count;
    }
  };
  add(a.points, b.points);
  add(b.points, a.points);
  constexpr int kFewest = 40;
  if (count < kFewest) return std::nullopt;
  const double off = std::sqrt(sum / count);
  return 2 * off < kSamePlace ? std::optional(off) : std::nullopt;
}

ScanView view_of(std::int64_t scan_id, const std::vector<ScannedStripe>& scan) {
  ScanView view;
  view.scan_id = scan_id;
  view.T_base_tool = scan[scan.size() / 2].T_base_tool;
  return view;
}

constexpr const char* kSecondSide =
    "scan the same thing from a second side, the tool turned by 40 deg or more, best by 180 deg "
    "about the vertical";

}  // namespace

DriftCheck check_on_ball(const SweepData& record, const Calibration& calibration,
                         double radius_mm) {
  DriftCheck result;
  result.predicted_mm = predicted(record, calibration);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [id, scan] : by_scan(record, calibration)) {
    Points points;
    for (const ScannedStripe& seen : scan) {
      int number = 0;
      for (const auto& segment : seen.stripe->segments)
        for (const Eigen::Vector2d& pixel : segment)
          if (number++ % kEvery == 0)
            if (const auto point = camera_point(calibration.sensor_model, pixel.x(), pixel.y()))
              points.push_back(seen.T_base_tool * calibration.T_tool_camera * *point);
    }
    const auto ball = find_ball(points, radius_mm, kBallTolerance);
    if (!ball) {
      result.warnings.push_back(
          fmt::format("scan {}: no ball of {} mm radius in it", id, radius_mm));
      continue;
    }
    ScanView view = view_of(id, scan);
    view.points = ball->points.size();
    view.centre = ball->centre;
    view.radius_mm = ball->radius_mm;
    view.shape_mm = ball->rms_mm;
    sum += view.centre;
    result.radius_mm = std::max(result.radius_mm, std::abs(view.radius_mm - radius_mm));
    result.shape_mm = std::max(result.shape_mm, view.shape_mm);
    result.views.push_back(view);
  }
  if (result.views.empty()) {
    result.refused = fmt::format(
        "no scan shows a ball of {} mm radius: sweep slowly over its middle, 50 mm/s or less",
        radius_mm);
    return result;
  }
  const Eigen::Vector3d mean = sum / static_cast<double>(result.views.size());
  for (const ScanView& view : result.views)
    result.place_mm = std::max(result.place_mm, (view.centre - mean).norm());
  std::vector<Eigen::RowVector3d> shown;
  Eigen::Matrix3d mean_turn = Eigen::Matrix3d::Zero();
  for (const ScanView& view : result.views)
    mean_turn += view.T_base_tool.linear() / static_cast<double>(result.views.size());
  for (const ScanView& view : result.views)
    for (int axis = 0; axis < 3; ++axis)
      shown.push_back((view.T_base_tool.linear() - mean_turn).row(axis));
  result.turn_deg = largest_turn(result.views);
  if (result.turn_deg >= kTurn)
    tell_what_shows(shown, result);
  else
    result.warnings.push_back(fmt::format(
        "the tool is turned alike in all scans: a hand-eye that is shifted does not show; {}",
        kSecondSide));
  result.error_mm = std::max({result.place_mm, result.radius_mm, result.shape_mm});
  return result;
}

DriftCheck check_on_faces(const SweepData& record, const Calibration& calibration) {
  DriftCheck result;
  result.predicted_mm = predicted(record, calibration);
  std::vector<std::vector<SeenFace>> seen;
  for (const auto& [id, scan] : by_scan(record, calibration)) {
    seen.push_back(faces_of(scan, calibration));
    ScanView view = view_of(id, scan);
    double sum = 0;
    for (const SeenFace& face : seen.back()) {
      view.points += face.points.size();
      for (const Eigen::Vector3d& point : face.points)
        sum += std::pow(face.face.plane.signed_distance(point), 2);
    }
    if (view.points > 0) view.shape_mm = std::sqrt(sum / static_cast<double>(view.points));
    result.views.push_back(view);
  }
  result.turn_deg = largest_turn(result.views);
  std::vector<Eigen::RowVector3d> shown;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t k = i + 1; k < seen.size(); ++k) {
      if (turn_between(result.views[i].T_base_tool, result.views[k].T_base_tool) < kTurn) continue;
      for (const SeenFace& a : seen[i])
        for (const SeenFace& b : seen[k])
          if (const auto off = disagreement(a, b)) {
            ++result.faces;
            shown.push_back(
                a.face.plane.normal.transpose() *
                (result.views[i].T_base_tool.linear() - result.views[k].T_base_tool.linear()) / 2);
            result.place_mm = std::max(result.place_mm, *off);
          }
    }
  if (result.turn_deg < kTurn)
    result.refused = std::string("all scans are from one side: ") + kSecondSide;
  else if (result.faces == 0)
    result.refused =
        "no flat face is seen by two scans from different sides within 8 mm and 5 deg of the same "
        "place: scan a plate or a joint, or the calibration is worth nothing";
  result.error_mm = result.place_mm;
  tell_what_shows(shown, result);
  return result;
}

std::string drift(const DriftCheck& agreement, double limit_mm) {
  if (agreement.error_mm > limit_mm)
    return fmt::format("the scans disagree by {:.3f} mm, the limit is {} mm", agreement.error_mm,
                       limit_mm);
  if (agreement.predicted_mm >= 0 && agreement.error_mm > kRepeatability &&
      agreement.error_mm > kDeviations * agreement.predicted_mm)
    return fmt::format(
        "the scans disagree by {:.3f} mm, more than {} times what the calibration itself expects, "
        "{:.3f} mm",
        agreement.error_mm, kDeviations, agreement.predicted_mm);
  return "";
}

}  // namespace arcstart::calibration
