#include "services/calibration/stages/hand_eye.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "common/order_statistics.hpp"
#include "services/calibration/linear_algebra/dense_solvers.hpp"

namespace arcstart::calibration {
namespace {

cv::Mat to_cv(const Eigen::Matrix3d& matrix) {
  cv::Mat result(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) result.at<double>(row, column) = matrix(row, column);
  return result;
}

cv::Mat to_cv(const Eigen::Vector3d& vector) {
  return (cv::Mat_<double>(3, 1) << vector.x(), vector.y(), vector.z());
}

RigidTransform from_cv(const cv::Mat& rotation, const cv::Mat& position) {
  RigidTransform result = RigidTransform::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      result.linear()(row, column) = rotation.at<double>(row, column);
    result.translation()(row) = position.at<double>(row);
  }
  return result;
}

double consistency(const HandEyeMethod& method, const std::vector<RigidTransform>& T_base_tool,
                   const std::vector<RigidTransform>& T_camera_plate,
                   const std::vector<Eigen::Vector3d>& points) {
  double sum = 0;
  for (const Eigen::Vector3d& point : points) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double squares = 0;
    for (std::size_t i = 0; i < T_base_tool.size(); ++i) {
      const Eigen::Vector3d p =
          T_base_tool[i] * (method.T_tool_camera * (T_camera_plate[i] * point));
      mean += p;
      squares += p.squaredNorm();
    }
    const auto n = static_cast<double>(T_base_tool.size());
    sum += squares / n - (mean / n).squaredNorm();
  }
  return std::sqrt(std::max(0.0, sum / static_cast<double>(points.size())));
}

double angle(const RigidTransform& a, const RigidTransform& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

const HandEyeMethod& most_consistent(const std::vector<HandEyeMethod>& methods) {
  return *std::min_element(methods.begin(), methods.end(), [](const auto& a, const auto& b) {
    return a.consistency_mm < b.consistency_mm;
  });
}

}  // namespace

std::vector<HandEyeMethod> closed_form_hand_eye(const std::vector<RigidTransform>& T_base_tool,
                                                const std::vector<RigidTransform>& T_camera_plate,
                                                const std::vector<Eigen::Vector3d>& points) {
  std::vector<cv::Mat> tool_rotations, tool_positions, plate_rotations, plate_positions;
  for (std::size_t i = 0; i < T_base_tool.size(); ++i) {
    tool_rotations.push_back(to_cv(Eigen::Matrix3d(T_base_tool[i].linear())));
    tool_positions.push_back(to_cv(Eigen::Vector3d(T_base_tool[i].translation())));
    plate_rotations.push_back(to_cv(Eigen::Matrix3d(T_camera_plate[i].linear())));
    plate_positions.push_back(to_cv(Eigen::Vector3d(T_camera_plate[i].translation())));
  }
  const std::pair<const char*, cv::HandEyeCalibrationMethod> methods[] = {
      {"Tsai", cv::CALIB_HAND_EYE_TSAI},
      {"Park", cv::CALIB_HAND_EYE_PARK},
      {"Horaud", cv::CALIB_HAND_EYE_HORAUD},
      {"Daniilidis", cv::CALIB_HAND_EYE_DANIILIDIS}};
  std::vector<HandEyeMethod> results;
  for (const auto& [name, method] : methods) {
    HandEyeMethod result;
    result.name = name;
    result.consistency_mm = std::numeric_limits<double>::infinity();
    cv::Mat rotation, position;
    try {
      cv::calibrateHandEye(tool_rotations, tool_positions, plate_rotations, plate_positions,
                           rotation, position, method);
    } catch (const cv::Exception&) {
    }
    if (!rotation.empty() && !position.empty()) result.T_tool_camera = from_cv(rotation, position);
    if (!rotation.empty() && result.T_tool_camera.matrix().allFinite()) {
      result.T_base_plate = mean_plate(T_base_tool, result.T_tool_camera, T_camera_plate);
      result.consistency_mm = consistency(result, T_base_tool, T_camera_plate, points);
    } else {
      result.T_tool_camera.setIdentity();
      result.T_base_plate.setIdentity();
    }
    results.push_back(result);
  }
  return results;
}

const HandEyeMethod& best_method(const std::vector<HandEyeMethod>& methods) {
  const HandEyeMethod& park = methods[1];
  if (std::isfinite(park.consistency_mm)) return park;
  return most_consistent(methods);
}

double spread_of_methods(const std::vector<HandEyeMethod>& methods) {
  constexpr double kFailed = 3;  // times the best's consistency
  const double limit = kFailed * most_consistent(methods).consistency_mm;
  double largest = 0;
  for (const HandEyeMethod& a : methods)
    for (const HandEyeMethod& b : methods)
      if (std::max(a.consistency_mm, b.consistency_mm) < limit)
        largest = std::max(largest,
                           (a.T_tool_camera.translation() - b.T_tool_camera.translation()).norm());
  return largest;
}

RigidTransform mean_plate(const std::vector<RigidTransform>& T_base_tool,
                          const RigidTransform& T_tool_camera,
                          const std::vector<RigidTransform>& T_camera_plate) {
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < T_base_tool.size(); ++i) {
    const RigidTransform plate = T_base_tool[i] * T_tool_camera * T_camera_plate[i];
    rotations += plate.linear();
    position += plate.translation();
  }
  RigidTransform mean = RigidTransform::Identity();
  mean.linear() = nearest_rotation(rotations);
  mean.translation() = position / static_cast<double>(T_base_tool.size());
  return mean;
}

std::vector<double> angle_disagreement(const std::vector<RigidTransform>& T_base_tool,
                                       const std::vector<RigidTransform>& T_camera_plate) {
  std::vector<double> result;
  for (std::size_t i = 0; i < T_base_tool.size(); ++i) {
    std::vector<double> differences;
    for (std::size_t j = 0; j < T_base_tool.size(); ++j)
      if (j != i)
        differences.push_back(std::abs(angle(T_base_tool[i], T_base_tool[j]) -
                                       angle(T_camera_plate[i], T_camera_plate[j])));
    if (differences.empty()) differences.push_back(0);
    result.push_back(median(std::move(differences)));
  }
  return result;
}

}  // namespace arcstart::calibration
