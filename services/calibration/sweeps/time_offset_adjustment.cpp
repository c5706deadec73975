#include "services/calibration/sweeps/time_offset_adjustment.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "common/time.hpp"
#include "services/calibration/adjustment/adjustment.hpp"
#include "services/calibration/linear_algebra/dense_solvers.hpp"

namespace arcstart::calibration {
namespace {

constexpr int kRounds = 25;
constexpr double kFirstGate = 1.0, kLastGate = 0.5;  // mm: a piece farther off is of another face
constexpr double kFirstDeviation = 0.1, kLeastDeviation = 0.003;  // mm
constexpr double kHuber = 2;            // deviations beyond which a piece counts linearly
constexpr double kOffsetDeviation = 1;  // s, before anything is seen
constexpr double kSettled = 1e-6;       // s

// Share of the motion's direction; near rest there is none.
Eigen::Vector3d direction(const Eigen::Vector3d& velocity) {
  return velocity / std::sqrt(velocity.squaredNorm() + 1);
}

// Scaled to a unit diagonal: s, mm and rad lie far apart.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  return scale.asDiagonal() * symmetric_inverse(scaled) * scale.asDiagonal();
}

// Two tilts about the face's centre and a shift along its normal.
void move(FlatFace& face, const Eigen::Vector3d& step) {
  const double height = face.plane.signed_distance(face.centre) + step.z();
  face.plane.normal =
      (face.plane.normal + plane_axes(face.plane.normal) * step.head<2>()).normalized();
  face.plane.offset = height - face.plane.normal.dot(face.centre);
}

}  // namespace

// A piece's node: distance from its face and its derivatives.
struct OffsetProblem::Row {
  std::size_t piece;
  double distance;
  Eigen::VectorXd derivative;
};

std::vector<std::vector<MovingPoint>> OffsetProblem::carried(double offset_s) const {
  std::vector<std::vector<MovingPoint>> result(pieces_.size());
  std::optional<SensorMotion> motion;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (i == 0 || pieces_[i].stripe != pieces_[i - 1].stripe)
      motion = SensorMotion::at(record_.trajectory, T_tool_camera_,
                                pieces_[i].utime + seconds_to_us(offset_s));
    if (!motion) continue;
    for (const Eigen::Vector3d& node : pieces_[i].in_camera)
      result[i].push_back(motion->point(node));
  }
  return result;
}

std::vector<OffsetProblem::Row> OffsetProblem::rows(const OffsetState& state,
                                                    const std::vector<int>& face_of) const {
  const auto points = carried(state.offset_s);
  const auto columns = static_cast<Eigen::Index>(2 + 3 * state.faces.size());
  std::vector<Row> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (face_of[i] < 0) continue;
    const FlatFace& face = state.faces[static_cast<std::size_t>(face_of[i])];
    const Eigen::Vector3d& normal = face.plane.normal;
    const auto axes = plane_axes(normal);
    for (const MovingPoint& point : points[i]) {
      Row row{i, 0, Eigen::VectorXd::Zero(columns)};
      const Eigen::Vector3d along = direction(point.velocity);
      const Eigen::Vector3d position = point.position + state.play_mm * along;
      row.distance = face.plane.signed_distance(position);
      row.derivative(0) = normal.dot(point.velocity);
      row.derivative(1) = normal.dot(along);
      row.derivative.segment<2>(2 + 3 * face_of[i]) = axes.transpose() * (position - face.centre);
      row.derivative(4 + 3 * face_of[i]) = 1;
      result.push_back(std::move(row));
    }
  }
  return result;
}

// Each piece to the nearest face on which it lies with its whole length, none farther than `gate`.
std::vector<int> OffsetProblem::faces_of_pieces(const OffsetState& state, double gate) const {
  const auto points = carried(state.offset_s);
  std::vector<int> face_of(pieces_.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = gate;
    for (std::size_t k = 0; k < state.faces.size(); ++k) {
      double farthest = points[i].empty() ? gate : 0;
      for (const MovingPoint& point : points[i])
        farthest =
            std::max(farthest, std::abs(state.faces[k].plane.signed_distance(point.position)));
      if (farthest < nearest) nearest = farthest, face_of[i] = static_cast<int>(k);
    }
  }
  return face_of;
}

// What stripe noise, unevenness, robot and stamps together make of a piece's mean distance, by its
// sweep.
std::vector<double> OffsetProblem::deviations(const std::map<std::size_t, double>& height) const {
  std::vector<std::vector<double>> of_sweep(sweeps_);
  for (const auto& [piece, mean] : height) of_sweep[pieces_[piece].sweep].push_back(std::abs(mean));
  std::vector<double> result(sweeps_, kFirstDeviation);
  for (std::size_t s = 0; s < sweeps_; ++s)
    if (!of_sweep[s].empty()) result[s] = std::max(kLeastDeviation, 1.4826 * median(of_sweep[s]));
  return result;
}

OffsetAdjustment OffsetProblem::adjust(const OffsetState& start, double play_deviation) const {
  OffsetAdjustment result;
  result.state = start;
  OffsetState& state = result.state;
  const auto columns = static_cast<Eigen::Index>(2 + 3 * state.faces.size());
  for (int round = 0; round < kRounds; ++round) {
    const double gate = std::max(kLastGate, kFirstGate * std::pow(0.8, round));
    result.face_of = faces_of_pieces(state, gate);
    const std::vector<Row> all = rows(state, result.face_of);
    if (all.empty()) return result;
    std::map<std::size_t, double> height;  // of each piece over its face, mean
    for (const Row& row : all)
      height[row.piece] += row.distance / static_cast<double>(pieces_[row.piece].in_camera.size());
    result.sweep_deviation_mm = deviations(height);

    // What a stripe's pieces have in common (its stamp, the robot's noise) makes their errors
    // alike: the covariance is that of whole stripes' contributions.
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(columns, columns);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(columns);
    std::map<std::size_t, Eigen::VectorXd> of_stripe;
    for (const Row& row : all) {
      const SweptPiece& piece = pieces_[row.piece];
      const double deviation = result.sweep_deviation_mm[piece.sweep];
      const double huber = std::min(1.0, kHuber * deviation / std::abs(height[row.piece]));
      const double weight =
          huber / (deviation * deviation * static_cast<double>(piece.in_camera.size()));
      information += weight * row.derivative * row.derivative.transpose();
      of_stripe.try_emplace(piece.stripe, Eigen::VectorXd::Zero(columns)).first->second +=
          weight * row.distance * row.derivative;
    }
    Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(columns, columns);
    for (const auto& [stripe, part] : of_stripe) {
      gradient += part;
      scatter += part * part.transpose();
    }
    const auto stripes = static_cast<double>(of_stripe.size());
    scatter *= stripes / std::max(1.0, stripes - static_cast<double>(columns));
    const Eigen::Vector2d known(1 / (kOffsetDeviation * kOffsetDeviation),
                                1 / (play_deviation * play_deviation));
    information.diagonal().head<2>() += known;
    scatter.diagonal().head<2>() += known;
    gradient(1) += known(1) * state.play_mm;

    const Eigen::MatrixXd inverse = inverse_of(information);
    const Eigen::VectorXd step = -inverse * gradient;
    if (!step.allFinite()) return result;
    result.covariance = inverse * scatter * inverse;
    state.offset_s += step(0);
    state.play_mm += step(1);
    for (std::size_t k = 0; k < state.faces.size(); ++k)
      move(state.faces[k], step.segment<3>(static_cast<Eigen::Index>(2 + 3 * k)));
    result.solved = gate == kLastGate;
    if (result.solved && std::abs(step(0)) < kSettled) break;
  }
  return result;
}

}  // namespace arcstart::calibration
