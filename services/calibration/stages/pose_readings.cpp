#include "services/calibration/stages/pose_readings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/calibration/stages/euler_angles.hpp"

namespace arcstart::calibration {
namespace {

using Poses = std::vector<PairedPose>;
using Rotation = Eigen::Matrix3d;

constexpr const char* kAsWpr = "arcstart import calibration --pose-format wpr reads W, P, R";
constexpr const char* kAsRotvec =
    "arcstart import calibration --pose-format rotvec reads rotation vectors";

// Each pose by itself.
template <class Change>
auto each(const Change& change) {
  return [change](Poses poses) {
    for (PairedPose& pose : poses) pose.T_base_tool = change(pose.T_base_tool);
    return poses;
  };
}

// Each orientation by itself, positions as they are.
template <class Change>
auto each_rotation(const Change& change) {
  return each([change](const RigidTransform& pose) {
    RigidTransform other = pose;
    other.linear() = change(Rotation(pose.linear()));
    return other;
  });
}

Eigen::Vector3d rotation_vector(const Rotation& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Rotation turned_by(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Rotation::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

// The image at place i has the pose that stands at place i + by; where there is none, no image.
Poses shifted(const Poses& poses, int by) {
  Poses result;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i) + by;
    if (at < 0 || at >= static_cast<std::ptrdiff_t>(poses.size())) continue;
    result.push_back({poses[static_cast<std::size_t>(at)].T_base_tool, poses[i].T_camera_plate});
  }
  return result;
}

Poses reversed(const Poses& poses) {
  Poses result = poses;
  for (std::size_t i = 0; i < poses.size(); ++i)
    result[i].T_base_tool = poses[poses.size() - 1 - i].T_base_tool;
  return result;
}

// W, P, R taken for a rotation vector may be longer than half a turn: two triples a pose come to
// the same. Settled from one pose's, then each by whether it turned from there as the image shows.
Poses angles_of_rotation_vectors(const Poses& poses) {
  const auto triple = [](const Rotation& rotation, int which) {
    const Eigen::AngleAxisd turn(rotation);
    return composed(
        kFixedXyz,
        Eigen::Vector3d((turn.angle() - which * 2 * std::numbers::pi) * turn.axis()).reverse());
  };
  Poses best = poses;
  double least = std::numeric_limits<double>::infinity();
  for (const PairedPose& first : poses)
    for (int which = 0; which < 2 && first.T_camera_plate; ++which) {
      const Rotation start = triple(first.T_base_tool.linear(), which);
      Poses settled = poses;
      double sum = 0;
      for (PairedPose& pose : settled) {
        const Rotation said = pose.T_base_tool.linear();
        double nearest = std::numeric_limits<double>::infinity();
        for (int other = 0; other < 2 && pose.T_camera_plate; ++other) {
          const Rotation rotation = triple(said, other);
          const double robot = Eigen::AngleAxisd(Rotation(start.transpose() * rotation)).angle(),
                       seen =
                           Eigen::AngleAxisd(Rotation(first.T_camera_plate->linear().transpose() *
                                                      pose.T_camera_plate->linear()))
                               .angle();
          if (std::abs(robot - seen) >= nearest) continue;
          nearest = std::abs(robot - seen);
          pose.T_base_tool.linear() = rotation;
        }
        if (pose.T_camera_plate) sum += nearest;
      }
      if (sum >= least) continue;
      least = sum;
      best = settled;
    }
  return best;
}

void add_quaternions(std::vector<PoseReading>& readings) {
  // What was read as w, x, y, z was x, y, z, w, and the other way round.
  readings.push_back({"quaternions read as x, y, z, w",
                      "poses.csv wants qw,qx,qy,qz, the scalar first; arcstart import calibration "
                      "--pose-format xyzw reads the others",
                      each_rotation([](const Rotation& rotation) {
                        const Eigen::Quaterniond q(rotation);
                        return Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
                      })});
  readings.push_back({"quaternions whose scalar stood first and was read as the last",
                      "arcstart import calibration --pose-format wxyz reads those",
                      each_rotation([](const Rotation& rotation) {
                        const Eigen::Quaterniond q(rotation);
                        return Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
                      })});
}

// Three angles that were composed in another order than they are meant.
void add_orders(std::vector<PoseReading>& readings) {
  const auto recomposed = [](EulerOrder read, EulerOrder meant, bool exchanged) {
    return each_rotation([=](const Rotation& rotation) {
      Eigen::Vector3d angles = euler_angles(read, rotation);
      // In the same order each stays about its axis as it is, in the other one turned round.
      if ((read.axes != meant.axes) != exchanged) angles.reverseInPlace();
      return composed(meant, angles);
    });
  };
  const std::string wanted = std::string(
                                 ": Rz Ry Rx by the angles about z, y and x is FANUC's W, "
                                 "P, R, KUKA's C, B, A and roll, pitch, yaw; ") +
                             kAsWpr;
  readings.push_back({"the three angles turned in the order Rz Ry Rx, where Rx Ry Rz was read",
                      "compose them about fixed axes" + wanted,
                      recomposed(kRotatingXyz, kFixedXyz, false)});
  readings.push_back(
      {"first and third angle exchanged (KUKA's A, B, C are about z, y, x, FANUC's "
       "W, P, R about x, y, z)",
       std::string("give the angle about x first; ") + kAsWpr,
       recomposed(kFixedXyz, kFixedXyz, true)});
  readings.push_back(
      {"first and third angle exchanged and turned in the order Rz Ry Rx, where Rx Ry Rz was read",
       "compose them about fixed axes" + wanted, recomposed(kRotatingXyz, kFixedXyz, true)});
  const std::string rotating = "compose them about the axes as they turn, and give quaternions";
  readings.push_back({"the three angles turned in the order Rx Ry Rz, where Rz Ry Rx was read",
                      rotating, recomposed(kFixedXyz, kRotatingXyz, false)});
  readings.push_back(
      {"first and third angle exchanged and turned in the order Rx Ry Rz, where Rz Ry Rx was read",
       rotating, recomposed(kFixedXyz, kRotatingXyz, true)});
  readings.push_back({"first and third angle exchanged in the order Rx Ry Rz", rotating,
                      recomposed(kRotatingXyz, kRotatingXyz, true)});
  for (const EulerOrder& read : {kFixedXyz, kRotatingXyz})
    for (const bool turned : {false, true})
      readings.push_back(
          {std::string("the three angles turned as Rz Ry Rz (Kawasaki's O, A, T), where ") +
               read.product + " was read",
           "compose them so, and give quaternions", each_rotation([=](const Rotation& rotation) {
             Eigen::Vector3d angles = euler_angles(read, rotation);
             if (turned) angles.reverseInPlace();
             return composed(kZyz, angles);
           })});
  for (const bool turned : {false, true})
    readings.push_back({"the three angles turned as Rz Ry Rx, where Rz Ry Rz was read",
                        "compose them about fixed axes" + wanted,
                        each_rotation([=](const Rotation& rotation) {
                          Eigen::Vector3d angles = euler_angles(kZyz, rotation);
                          if (turned) angles.reverseInPlace();
                          return composed(kFixedXyz, angles);
                        })});
}

void add_angle_units(std::vector<PoseReading>& readings) {
  const std::string what = "angles in radians, which were read as degrees";
  const std::string cure = std::string("give degrees where they are wanted; ") + kAsWpr +
                           " in degrees, and rotvec reads radians";
  for (const EulerOrder& order : {kFixedXyz, kRotatingXyz, kZyz})
    readings.push_back({what, cure, each_rotation([=](const Rotation& rotation) {
                          return composed(order, euler_angles(order, rotation) / kDegree);
                        })});
  readings.push_back({what, cure, each_rotation([](const Rotation& rotation) {
                        return turned_by(rotation_vector(rotation) / kDegree);
                      })});
  for (const double unit : {1.0, 1 / kDegree})
    readings.push_back({"rotation vectors, which were read as W, P, R", kAsRotvec,
                        each_rotation([=](const Rotation& rotation) {
                          return turned_by(unit * euler_angles(kFixedXyz, rotation).reverse());
                        })});
}

std::vector<PoseReading> make_readings() {
  std::vector<PoseReading> readings;
  readings.push_back({"", "", [](const Poses& poses) { return poses; }});
  add_quaternions(readings);
  readings.push_back({"poses that say where base lies in the tool",
                      "invert each pose: poses.csv wants the tool in base",
                      each([](const RigidTransform& pose) { return pose.inverse(); }), true});
  readings.push_back(
      {"orientations that are inverted (conjugate quaternions, or matrices written "
       "column by column)",
       "turn each the other way round: the tool's axes as columns, seen in base",
       each_rotation([](const Rotation& rotation) { return Rotation(rotation.transpose()); })});
  add_orders(readings);
  add_angle_units(readings);
  const std::string pairs = "pair images and poses anew in poses.csv";
  readings.push_back({"each image paired with the pose before the one it stands with", pairs,
                      [](const Poses& poses) { return shifted(poses, -1); }});
  readings.push_back({"each image paired with the pose after the one it stands with", pairs,
                      [](const Poses& poses) { return shifted(poses, 1); }});
  readings.push_back({"the rows of poses.csv from the last to the first", pairs, reversed});
  for (int axis = 0; axis < 3; ++axis)
    readings.push_back({std::string("the positions' ") + "xyz"[axis] + " with the other sign",
                        "give positions and orientations in one right-handed base",
                        each([axis](RigidTransform pose) {
                          pose.translation()(axis) *= -1;
                          return pose;
                        })});
  readings.push_back(
      {"W, P, R, which were read as a rotation vector", kAsWpr, angles_of_rotation_vectors});
  return readings;
}

}  // namespace

const std::vector<PoseReading>& pose_readings() {
  static const std::vector<PoseReading> readings = make_readings();
  return readings;
}

}  // namespace arcstart::calibration
