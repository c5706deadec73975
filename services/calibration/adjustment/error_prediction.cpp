#include "services/calibration/adjustment/error_prediction.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "services/calibration/adjustment/adjustment_residuals.hpp"

namespace arcstart::calibration {
namespace {

// The set with one parameter changed, in the covariance's order.
AdjustmentState changed(const AdjustmentState& state, int parameter, double change) {
  AdjustmentState result = state;
  SensorModel& model = result.model;
  double* const camera[] = {&model.fx, &model.fy, &model.cx, &model.cy};
  if (parameter < 4) {
    *camera[parameter] += change;
  } else if (parameter < 9) {
    model.distortion[static_cast<std::size_t>(parameter - 4)] += change;
  } else if (parameter < 11) {
    Eigen::Vector3d& normal = model.laser_plane.normal;
    normal = (normal + change * plane_axes(normal).col(parameter - 9)).normalized();
  } else if (parameter == 11) {
    model.laser_plane.offset += change;
  } else if (parameter < 15) {
    const Eigen::Vector3d vector = change * Eigen::Vector3d::Unit(parameter - 12);
    result.T_tool_camera.linear() =
        turned(vector.data(), Eigen::Matrix3d(state.T_tool_camera.linear()));
  } else {
    result.T_tool_camera.translation() += change * Eigen::Vector3d::Unit(parameter - 15);
  }
  return result;
}

constexpr double kSteps[] = {1e-2, 1e-6, 1e-6, 1e-3, 1e-6, 1e-3};  // of the groups of parameters

double step_of(int parameter) {
  return kSteps[parameter < 4    ? 0
                : parameter < 9  ? 1
                : parameter < 11 ? 2
                : parameter < 12 ? 3
                : parameter < 15 ? 4
                                 : 5];
}

std::optional<Eigen::Vector3d> tool_point(const AdjustmentState& state, const Eigen::Vector2d& at) {
  const auto point = camera_point(state.model, at.x(), at.y());
  if (!point) return std::nullopt;
  return state.T_tool_camera * *point;
}

}  // namespace

Eigen::Matrix3d predicted_covariance(const AdjustmentState& state, const SetCovariance& covariance,
                                     const Eigen::Vector2d& pixel) {
  Eigen::Matrix<double, 3, kSetParameters> derivative;
  for (int parameter = 0; parameter < kSetParameters; ++parameter) {
    const double step = step_of(parameter);
    const auto up = tool_point(changed(state, parameter, step), pixel),
               down = tool_point(changed(state, parameter, -step), pixel);
    if (!up || !down) return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
    derivative.col(parameter) = (*up - *down) / (2 * step);
  }
  return derivative * covariance * derivative.transpose();
}

double predicted_rms(const AdjustmentState& state, const SetCovariance& covariance,
                     const std::vector<Eigen::Vector2d>& pixels) {
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector2d& pixel : pixels)
    if (const double trace = predicted_covariance(state, covariance, pixel).trace(); trace >= 0) {
      sum += trace;
      ++count;
    }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

std::vector<PredictedError> predicted_field(const AdjustmentState& state,
                                            const SetCovariance& covariance,
                                            const std::vector<View>& views) {
  constexpr int kCells = 7;
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const View& view : views)
    for (const Eigen::Vector2d& pixel : view.stripe) {
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
  std::vector<PredictedError> field;
  if (!(low.x() <= high.x())) return field;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      const Eigen::Vector2d share(column / (kCells - 1.0), row / (kCells - 1.0));
      const Eigen::Vector2d pixel = low + share.cwiseProduct(high - low);
      const auto point = camera_point(state.model, pixel.x(), pixel.y());
      const Eigen::Matrix3d error = predicted_covariance(state, covariance, pixel);
      if (!point || !error.allFinite()) continue;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(error);
      field.push_back({pixel, *point, axes.eigenvalues().cwiseMax(0).cwiseSqrt().reverse(),
                       axes.eigenvectors().col(2)});
    }
  return field;
}

}  // namespace arcstart::calibration
