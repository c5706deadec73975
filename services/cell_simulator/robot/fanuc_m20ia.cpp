#include "services/cell_simulator/robot/fanuc_m20ia.hpp"

#include <cmath>
#include <kdl/frames.hpp>
#include <numbers>

namespace arcstart::cell_simulator {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Limits in degrees, in the model's counting (ros-industrial/fanuc, m20ia_macro.xacro).
constexpr std::array<double, 6> kLowest = {-170, -100, -185, -200, -140, -270};
constexpr std::array<double, 6> kHighest = {170, 160, 273.1, 200, 140, 270};

// Joint frames are parallel at zero; origins in the parent in mm (the same source).
KDL::Chain make_chain() {
  KDL::Chain chain;
  const auto add = [&chain](const KDL::Vector& origin, const KDL::Vector& axis) {
    chain.addSegment(
        KDL::Segment(KDL::Joint("joint", origin, axis, KDL::Joint::RotAxis), KDL::Frame(origin)));
  };
  add({0, 0, 0}, {0, 0, 1});
  add({150, 0, 0}, {0, 1, 0});
  add({0, 0, 790}, {0, -1, 0});
  add({0, 0, 250}, {-1, 0, 0});
  add({835, 0, 0}, {0, -1, 0});
  add({100, 0, 0}, {-1, 0, 0});
  const KDL::Rotation flange_to_tool0 =
      KDL::Rotation::RPY(std::numbers::pi, -std::numbers::pi / 2, 0);
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), KDL::Frame(flange_to_tool0)));
  return chain;
}

// A radian weighs as much as 300 mm.
Eigen::Matrix<double, 6, 1> task_weights() {
  return (Eigen::Matrix<double, 6, 1>() << 1, 1, 1, 300, 300, 300).finished();
}

RigidTransform from_kdl(const KDL::Frame& frame) {
  RigidTransform transform = RigidTransform::Identity();
  for (int row = 0; row < 3; ++row) {
    transform.translation()(row) = frame.p(row);
    for (int column = 0; column < 3; ++column)
      transform.linear()(row, column) = frame.M(row, column);
  }
  return transform;
}

KDL::Frame to_kdl(const RigidTransform& transform) {
  const Eigen::Matrix3d r = transform.linear();
  const Eigen::Vector3d p = transform.translation();
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                        r(2, 2)),
          KDL::Vector(p.x(), p.y(), p.z())};
}

KDL::JntArray to_kdl(const Joints& joints) {
  KDL::JntArray array(6);
  for (unsigned i = 0; i < 6; ++i) array(i) = joints[i];
  return array;
}

// The turn of the angle that is nearest to `near` and within the joint's limits; false where no
// turn is.
bool within_limits(double& angle, double near, std::size_t joint) {
  constexpr double kTurn = 2 * std::numbers::pi;
  angle -= kTurn * std::round((angle - near) / kTurn);
  if (angle < kLowest[joint] * kDegree) angle += kTurn;
  if (angle > kHighest[joint] * kDegree) angle -= kTurn;
  return angle >= kLowest[joint] * kDegree && angle <= kHighest[joint] * kDegree;
}

}  // namespace

XyzWpr to_xyzwpr(const RigidTransform& transform) {
  const Eigen::Matrix3d r = transform.linear();
  const Eigen::Vector3d t = transform.translation();
  const double cosine_p = std::hypot(r(0, 0), r(1, 0));
  XyzWpr frame{t.x(), t.y(), t.z(), 0, std::atan2(-r(2, 0), cosine_p) / kDegree, 0};
  if (cosine_p > 1e-9) {
    frame.w = std::atan2(r(2, 1), r(2, 2)) / kDegree;
    frame.r = std::atan2(r(1, 0), r(0, 0)) / kDegree;
  } else {
    frame.r = std::atan2(-r(0, 1), r(1, 1)) / kDegree;
  }
  return frame;
}

RigidTransform from_xyzwpr(const XyzWpr& frame) {
  const auto turn = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * kDegree, axis);
  };
  RigidTransform transform = RigidTransform::Identity();
  transform.linear() =
      (turn(frame.r, Eigen::Vector3d::UnitZ()) * turn(frame.p, Eigen::Vector3d::UnitY()) *
       turn(frame.w, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  transform.translation() << frame.x, frame.y, frame.z;
  return transform;
}

Joints fanuc_count(const Joints& model) {
  Joints counted = model;
  counted[2] -= model[1];
  return counted;
}

FanucM20ia::FanucM20ia(const RigidTransform& T_tool0_tool)
    : T_tool0_tool_(T_tool0_tool),
      chain_(make_chain()),
      forward_(chain_),
      inverse_(chain_, task_weights(), 1e-6, 200, 1e-15) {}

RigidTransform FanucM20ia::tool_pose(const Joints& joints) const {
  KDL::Frame frame;
  forward_.JntToCart(to_kdl(joints), frame);
  return from_kdl(frame) * T_tool0_tool_;
}

std::optional<Joints> FanucM20ia::joints(const RigidTransform& T_base_tool, const Joints& near) {
  const RigidTransform T_base_tool0 = T_base_tool * T_tool0_tool_.inverse();
  KDL::JntArray solution(6);
  // The solver also ends with an error code at a pose it has already reached; what counts is where
  // it got to.
  inverse_.CartToJnt(to_kdl(near), to_kdl(T_base_tool0), solution);
  Joints joints{};
  for (unsigned i = 0; i < 6; ++i) {
    joints[i] = solution(i);
    if (!std::isfinite(joints[i]) || !within_limits(joints[i], near[i], i)) return std::nullopt;
  }
  const RigidTransform reached = tool_pose(joints);
  const double turned =
      Eigen::AngleAxisd(reached.linear().transpose() * T_base_tool.linear()).angle();
  // KDL takes turns below 1e-6 rad for none.
  if ((reached.translation() - T_base_tool.translation()).norm() > 1e-3 || turned > 2e-6)
    return std::nullopt;
  return joints;
}

std::optional<Joints> FanucM20ia::joints(const RigidTransform& T_base_tool) {
  const Eigen::Vector3d wrist =
      (T_base_tool * T_tool0_tool_.inverse()) * Eigen::Vector3d(0, 0, -100);
  const double shoulder = std::atan2(wrist.y(), wrist.x());
  for (const double j5 : {-90.0, -40.0, 40.0, 90.0})
    for (const double j4 : {0.0, 90.0, -90.0, 180.0})
      for (const double j6 : {0.0, 120.0, -120.0})
        if (const auto found = joints(T_base_tool, {shoulder, 10 * kDegree, -15 * kDegree,
                                                    j4 * kDegree, j5 * kDegree, j6 * kDegree}))
          return found;
  return std::nullopt;
}

}  // namespace arcstart::cell_simulator
