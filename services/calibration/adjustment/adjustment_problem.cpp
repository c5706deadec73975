#include "services/calibration/adjustment/adjustment_problem.hpp"

#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/solver.h>

#include <cmath>

#include "services/calibration/adjustment/adjustment_residuals.hpp"
#include "services/calibration/linear_algebra/dense_solvers.hpp"

namespace arcstart::calibration {
namespace {

// Standard deviations beyond which a residual counts linearly; six numbers together for the robot.
constexpr double kImageHuber = 3, kRobotHuber = 4.5;

std::array<double, 6> unturned(const RigidTransform& transform) {
  const Eigen::Vector3d p = transform.translation();
  return {0, 0, 0, p.x(), p.y(), p.z()};
}

RigidTransform changed(const std::array<double, 6>& change, const RigidTransform& start) {
  RigidTransform result = RigidTransform::Identity();
  result.linear() = turned(change.data(), Eigen::Matrix3d(start.linear()));
  result.translation() = Eigen::Map<const Eigen::Vector3d>(change.data() + 3);
  return result;
}

}  // namespace

double Group::factor() const { return redundancy > 0.5 ? std::sqrt(squares / redundancy) : 1; }

AdjustmentProblem::AdjustmentProblem(const Target& plate, const std::vector<View>& views,
                                     const AdjustmentState& start, const Deviations& deviations,
                                     bool camera_free)
    : views_(views),
      start_(start),
      deviations_(deviations),
      camera_free_(camera_free),
      camera_{start.model.fx, start.model.fy, start.model.cx, start.model.cy},
      distortion_(start.model.distortion),
      plane_{0, 0, start.model.laser_plane.offset},
      hand_eye_(unturned(start.T_tool_camera)),
      plate_(unturned(start.T_base_plate)) {
  for (const RigidTransform& pose : start.T_camera_plate) poses_.push_back(unturned(pose));
  // Their order is that of the covariance.
  problem_.AddParameterBlock(camera_.data(), 4);
  problem_.AddParameterBlock(distortion_.data(), 5, new ceres::SubsetManifold(5, {4}));  // k3
  problem_.AddParameterBlock(plane_.data(), 3);
  problem_.AddParameterBlock(hand_eye_.data(), 6);
  problem_.AddParameterBlock(plate_.data(), 6);
  for (std::size_t i = 0; i < views.size(); ++i) add_view(plate, views[i], i);
  hold_camera(!camera_free);
}

void AdjustmentProblem::add_view(const Target& plate, const View& view, std::size_t number) {
  double* pose = poses_[number].data();
  const Eigen::Matrix3d start = start_.T_camera_plate[number].linear();
  const std::vector<Eigen::Vector3d> points = plate.points();
  for (std::size_t k = 0; k < points.size(); ++k)
    target_.push_back(problem_.AddResidualBlock(
        new TargetResidual::Cost(new TargetResidual{view.target[k], points[k],
                                                    plate.radius(static_cast<int>(k)),
                                                    deviations_.pixel, start}),
        new ceres::HuberLoss(kImageHuber), camera_.data(), distortion_.data(), pose));
  const Eigen::Vector3d normal = start_.model.laser_plane.normal;
  for (const Eigen::Vector2d& seen : view.stripe)
    if (const auto ray = undistorted_ray(start_.model, seen.x(), seen.y()))
      laser_.push_back(problem_.AddResidualBlock(
          new LaserResidual::Cost(new LaserResidual{seen, ray->head<2>(), deviations_.laser_mm,
                                                    start, normal, plane_axes(normal)}),
          new ceres::HuberLoss(kImageHuber), camera_.data(), distortion_.data(), pose,
          plane_.data()));
  robot_.push_back(problem_.AddResidualBlock(
      new RobotResidual::Cost(
          new RobotResidual{view.T_base_tool, deviations_.robot_mm, deviations_.robot_rad, start,
                            start_.T_tool_camera.linear(), start_.T_base_plate.linear()}),
      new ceres::HuberLoss(kRobotHuber), pose, hand_eye_.data(), plate_.data()));
}

void AdjustmentProblem::hold_camera(bool hold) {
  for (double* block : {camera_.data(), distortion_.data()})
    hold ? problem_.SetParameterBlockConstant(block) : problem_.SetParameterBlockVariable(block);
}

bool AdjustmentProblem::solve() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  return summary.IsSolutionUsable();
}

AdjustmentState AdjustmentProblem::state() const {
  AdjustmentState state = start_;
  SensorModel& model = state.model;
  model.fx = camera_[0];
  model.fy = camera_[1];
  model.cx = camera_[2];
  model.cy = camera_[3];
  model.distortion = distortion_;
  const Eigen::Vector3d normal = start_.model.laser_plane.normal;
  model.laser_plane.normal =
      (normal + plane_axes(normal) * Eigen::Vector2d(plane_[0], plane_[1])).normalized();
  model.laser_plane.offset = plane_[2];
  state.T_tool_camera = changed(hand_eye_, start_.T_tool_camera);
  state.T_base_plate = changed(plate_, start_.T_base_plate);
  for (std::size_t i = 0; i < poses_.size(); ++i)
    state.T_camera_plate[i] = changed(poses_[i], start_.T_camera_plate[i]);
  return state;
}

Redundancy AdjustmentProblem::redundancy() {
  hold_camera(false);
  ceres::Problem::EvaluateOptions options;
  options.residual_blocks = target_;
  options.residual_blocks.insert(options.residual_blocks.end(), laser_.begin(), laser_.end());
  options.residual_blocks.insert(options.residual_blocks.end(), robot_.begin(), robot_.end());
  options.parameter_blocks = {camera_.data(), distortion_.data(), plane_.data(), hand_eye_.data(),
                              plate_.data()};
  for (auto& pose : poses_) options.parameter_blocks.push_back(pose.data());
  std::vector<double> residuals;
  ceres::CRSMatrix jacobian;
  problem_.Evaluate(options, nullptr, &residuals, nullptr, &jacobian);
  hold_camera(!camera_free_);

  const Eigen::Index columns = jacobian.num_cols;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(columns, columns);
  const auto for_pairs_of = [&](int row, const auto& visit) {
    const auto r = static_cast<std::size_t>(row);
    for (int i = jacobian.rows[r]; i < jacobian.rows[r + 1]; ++i)
      for (int j = jacobian.rows[r]; j < jacobian.rows[r + 1]; ++j) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        visit(jacobian.cols[a], jacobian.cols[b], jacobian.values[a] * jacobian.values[b]);
      }
  };
  for (int row = 0; row < jacobian.num_rows; ++row)
    for_pairs_of(row, [&](int a, int b, double product) { information(a, b) += product; });
  // Scaled to a unit diagonal: px, mm and rad lie far apart. Without a stripe the plane is unknown.
  Eigen::VectorXd scale = information.diagonal().cwiseSqrt();
  for (double& s : scale) s = s > 0 ? 1 / s : 0;
  Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  for (Eigen::Index i = 0; i < columns; ++i)
    if (scale(i) == 0) scaled(i, i) = 1;
  const Eigen::MatrixXd covariance =
      scale.asDiagonal() * symmetric_inverse(scaled) * scale.asDiagonal();

  Redundancy result;
  const int lasers = static_cast<int>(2 * target_.size()),
            robots = lasers + static_cast<int>(laser_.size());
  result.view_translation.assign(views_.size(), 0);
  result.view_rotation.assign(views_.size(), 0);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    double redundant = 1;
    for_pairs_of(row,
                 [&](int a, int b, double product) { redundant -= product * covariance(a, b); });
    const int in_view = (row - robots) % 6;
    Group& group = row < lasers   ? result.pixel
                   : row < robots ? result.laser
                   : in_view < 3  ? result.robot_translation
                                  : result.robot_rotation;
    const double residual = residuals[static_cast<std::size_t>(row)];
    group.squares += residual * residual;
    group.redundancy += redundant;
    if (row >= robots) {
      const auto view = static_cast<std::size_t>((row - robots) / 6);
      (in_view < 3 ? result.view_translation : result.view_rotation)[view] += redundant;
    }
  }
  // k3 has no column: rows and columns 8 of the set's covariance stay 0.
  result.covariance.setZero();
  const auto place = [](int parameter) { return parameter < 8 ? parameter : parameter + 1; };
  for (int i = 0; i + 1 < kSetParameters; ++i)
    for (int j = 0; j + 1 < kSetParameters; ++j)
      result.covariance(place(i), place(j)) = covariance(i, j);
  return result;
}

}  // namespace arcstart::calibration
