// What the adjustment holds together: a plate's point as seen, a stripe's point in the laser plane,
// the robot where it said. Poses are small changes of a start: R = exp(w) R0, t.
#pragma once

#include <ceres/autodiff_cost_function.h>
#include <ceres/rotation.h>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "services/calibration/target/projection.hpp"

namespace arcstart::calibration {

template <class T>
Matrix3<T> turned(const T* vector, const Eigen::Matrix3d& start) {
  Matrix3<T> rotation;
  ceres::AngleAxisToRotationMatrix(vector, rotation.data());
  return rotation * start.cast<T>();
}

// pose: rotation vector, position.
template <class T>
TargetInCamera<T> plate_in_camera(const T* pose, const Eigen::Matrix3d& start) {
  return {turned(pose, start), Eigen::Map<const Vector3<T>>(pose + 3)};
}

// Of a plate's point in the image: 2, in standard deviations.
struct TargetResidual {
  Eigen::Vector2d seen;
  Eigen::Vector3d point;
  double radius, deviation;
  Eigen::Matrix3d start;

  template <class T>
  bool operator()(const T* camera, const T* distortion, const T* pose, T* residual) const {
    const Vector2<T> expected =
        seen_centre(camera, distortion, plate_in_camera(pose, start), point, radius);
    residual[0] = (expected.x() - seen.x()) / deviation;
    residual[1] = (expected.y() - seen.y()) / deviation;
    return true;
  }
  using Cost = ceres::AutoDiffCostFunction<TargetResidual, 2, 4, 5, 6>;
};

// Of a stripe's ray, cut with the plate, from the laser plane: 1, in standard deviations. plane:
// tilts and offset.
struct LaserResidual {
  Eigen::Vector2d seen, undistorted_start;
  double deviation;
  Eigen::Matrix3d start;
  Eigen::Vector3d normal;
  Eigen::Matrix<double, 3, 2> axes;

  template <class T>
  bool operator()(const T* camera, const T* distortion, const T* pose, const T* plane,
                  T* residual) const {
    const TargetInCamera<T> plate = plate_in_camera(pose, start);
    const Vector2<T> flat = undistorted(camera, distortion, seen, undistorted_start);
    const Vector3<T> ray(flat.x(), flat.y(), T(1)), up = plate.rotation.col(2);
    const T depth = up.dot(plate.position) / up.dot(ray);
    const Vector3<T> tilted =
        normal.cast<T>() + axes.col(0).cast<T>() * plane[0] + axes.col(1).cast<T>() * plane[1];
    residual[0] = (depth * tilted.dot(ray) / tilted.norm() + plane[2]) / deviation;
    return true;
  }
  using Cost = ceres::AutoDiffCostFunction<LaserResidual, 1, 4, 5, 6, 3>;
};

// How far the robot was from where it said: translation in base and rotation about the tool centre
// point, 6 numbers, in mm and rad.
template <class T>
void robot_deviation(const TargetInCamera<T>& plate, const Matrix3<T>& hand_eye_rotation,
                     const Vector3<T>& hand_eye_position, const Matrix3<T>& plate_rotation,
                     const Vector3<T>& plate_position, const RigidTransform& said, T* deviation) {
  const Matrix3<T> tool_plate = hand_eye_rotation * plate.rotation;
  const Matrix3<T> rotation = plate_rotation * tool_plate.transpose();
  const Vector3<T> plate_in_tool = hand_eye_rotation * plate.position + hand_eye_position;
  Eigen::Map<Vector3<T>>(deviation, 3) =
      plate_position - rotation * plate_in_tool - said.translation().cast<T>();
  const Matrix3<T> turn = rotation * said.linear().transpose().cast<T>();
  ceres::RotationMatrixToAngleAxis(turn.data(), deviation + 3);
}

// The same in standard deviations.
struct RobotResidual {
  RigidTransform said;
  double deviation_mm, deviation_rad;
  Eigen::Matrix3d start, hand_eye_start, plate_start;

  template <class T>
  bool operator()(const T* pose, const T* hand_eye, const T* plate, T* residual) const {
    robot_deviation<T>(plate_in_camera(pose, start), turned(hand_eye, hand_eye_start),
                       Eigen::Map<const Vector3<T>>(hand_eye + 3), turned(plate, plate_start),
                       Eigen::Map<const Vector3<T>>(plate + 3), said, residual);
    for (int i = 0; i < 3; ++i) {
      residual[i] /= T(deviation_mm);
      residual[i + 3] /= T(deviation_rad);
    }
    return true;
  }
  using Cost = ceres::AutoDiffCostFunction<RobotResidual, 6, 6, 6, 6>;
};

}  // namespace arcstart::calibration
