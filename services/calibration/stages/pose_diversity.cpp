#include "services/calibration/stages/pose_diversity.hpp"

#include <fmt/core.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/geometry.hpp"

namespace arcstart::calibration {
namespace {

constexpr int kFewestViews = 5;
constexpr double kLeastTilt = 5, kLeastRotation = 15;  // deg
constexpr double kLeastAxisRatio = 0.1;
constexpr int kFreeCameraViews = 7;
constexpr double kFreeCameraRotation = 30;  // deg

}  // namespace

PoseDiversity pose_diversity(const std::vector<RigidTransform>& T_camera_plate) {
  PoseDiversity spread;
  spread.views = static_cast<int>(T_camera_plate.size());
  Eigen::Matrix3d turns = Eigen::Matrix3d::Zero();
  spread.nearest_mm = 1e9;
  bool towards[4] = {};
  for (std::size_t i = 0; i < T_camera_plate.size(); ++i) {
    const Eigen::Vector3d normal = T_camera_plate[i].linear().col(2);
    const double tilt = std::atan2(normal.head<2>().norm(), std::abs(normal.z())) / kDegree;
    spread.tilt_deg = std::max(spread.tilt_deg, tilt);
    if (tilt >= 15)
      towards[static_cast<int>(
                  std::floor((std::atan2(normal.y(), normal.x()) / kDegree + 225) / 90)) %
              4] = true;
    const double depth = T_camera_plate[i].translation().z();
    spread.nearest_mm = std::min(spread.nearest_mm, depth);
    spread.farthest_mm = std::max(spread.farthest_mm, depth);
    for (std::size_t j = i + 1; j < T_camera_plate.size(); ++j) {
      const Eigen::Matrix3d between =
          T_camera_plate[i].linear() * T_camera_plate[j].linear().transpose();
      spread.rotation_deg =
          std::max(spread.rotation_deg, Eigen::AngleAxisd(between).angle() / kDegree);
      const double roll =
          std::atan2(between(1, 0) - between(0, 1), between(0, 0) + between(1, 1)) / kDegree;
      spread.roll_deg = std::max(spread.roll_deg, std::abs(roll));
      const Eigen::Matrix3d difference = between - Eigen::Matrix3d::Identity();
      turns += difference.transpose() * difference;
    }
  }
  spread.tilted_towards = static_cast<int>(std::count(towards, towards + 4, true));
  const Eigen::Vector3d values = Eigen::JacobiSVD<Eigen::Matrix3d>(turns).singularValues();
  if (values(0) > 0) spread.axis_ratio = std::sqrt(values(2) / values(0));
  return spread;
}

std::string diversity_refusal(const PoseDiversity& spread) {
  if (spread.views < kFewestViews)
    return fmt::format(
        "{} usable poses, at least {} are needed: add poses tilted 20 to 40 deg to "
        "all sides",
        spread.views, kFewestViews);
  if (spread.tilt_deg < kLeastTilt)
    return fmt::format(
        "the plate is tilted by {:.1f} deg at most, which tells neither focal length "
        "nor hand-eye: add poses tilted 20 to 40 deg to all sides",
        spread.tilt_deg);
  if (spread.rotation_deg < kLeastRotation)
    return fmt::format(
        "the camera turned by {:.1f} deg at most between poses: add poses tilted 20 "
        "to 40 deg to all sides and rolled by 90 deg",
        spread.rotation_deg);
  if (spread.axis_ratio < kLeastAxisRatio)
    return fmt::format(
        "all poses turn about one axis (ratio {:.3f}), along which the camera's "
        "place cannot be told: add poses tilted about another axis",
        spread.axis_ratio);
  return "";
}

bool camera_must_be_held(const PoseDiversity& spread) {
  return spread.views < kFreeCameraViews || spread.rotation_deg < kFreeCameraRotation;
}

std::vector<std::string> diversity_advice(const PoseDiversity& spread) {
  std::vector<std::string> advice;
  if (spread.tilt_deg < 30)
    advice.push_back(
        fmt::format("tilt the plate more: it is at most {:.0f} deg from square, 20 to "
                    "40 deg are best",
                    spread.tilt_deg));
  if (spread.tilted_towards < 4)
    advice.push_back(
        fmt::format("tilt it to all sides: {} of 4 directions are there by 15 deg or "
                    "more",
                    spread.tilted_towards));
  if (spread.roll_deg < 120)
    advice.push_back(
        fmt::format("roll the camera about its axis by -90 to 90 deg: {:.0f} deg so "
                    "far between two poses",
                    spread.roll_deg));
  if (spread.farthest_mm < 1.3 * spread.nearest_mm)
    advice.push_back(
        fmt::format("vary the distance from 0.8 to 1.2 of the stand-off: {:.0f} to "
                    "{:.0f} mm so far",
                    spread.nearest_mm, spread.farthest_mm));
  if (spread.views < 20)
    advice.push_back(
        fmt::format("add poses: the error falls with the root of their number, {} so "
                    "far, 20 are usual",
                    spread.views));
  return advice;
}

}  // namespace arcstart::calibration
