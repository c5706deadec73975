// Kinematics of the FANUC M-20iA by orocos-kdl, and its pose as FANUC writes it.
#pragma once

#include <array>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <optional>

#include "common/geometry.hpp"

namespace arcstart::cell_simulator {

// J1..J6 of the model, whose J3 does not follow J2; rad.
using Joints = std::array<double, 6>;

// A frame as FANUC writes it: X Y Z in mm; W, P, R in degrees, rotations about the fixed axes x, y,
// z in this order: R = Rz(R) Ry(P) Rx(W). At P = +-90 only R - W or R + W is determined; W is then
// 0.
struct XyzWpr {
  double x, y, z, w, p, r;
};
XyzWpr to_xyzwpr(const RigidTransform& transform);
RigidTransform from_xyzwpr(const XyzWpr& frame);

// J1..J6 as the pendant and HSPO count them: there J3 is measured from the horizontal, so that J3 =
// model's J3 - J2.
Joints fanuc_count(const Joints& model);

// Base is the robot's World: its origin lies on J1's axis at the height of J2's, 525 mm above the
// foot. Not to be used by two threads at once.
class FanucM20ia {
 public:
  // T_tool0_tool: the tool centre point in the flange frame tool0 (z out of the flange).
  explicit FanucM20ia(const RigidTransform& T_tool0_tool = RigidTransform::Identity());

  RigidTransform tool_pose(const Joints& joints) const;  // T_base_tool

  // The joints within their limits that reach the pose to 0.001 mm and 2e-6 rad, from the branch of
  // `near`; nothing where there are none.
  std::optional<Joints> joints(const RigidTransform& T_base_tool, const Joints& near);

  // Likewise without a hint, from the branch with the shoulder forward and the elbow up where it
  // reaches the pose.
  std::optional<Joints> joints(const RigidTransform& T_base_tool);

 private:
  RigidTransform T_tool0_tool_;
  KDL::Chain chain_;
  mutable KDL::ChainFkSolverPos_recursive forward_;
  KDL::ChainIkSolverPos_LMA inverse_;
};

}  // namespace arcstart::cell_simulator
