// What of a SEAM may be given to the robot: all of it within the limits, or a refusal.
#pragma once

#include <arcstart/seam_t.hpp>
#include <array>
#include <cstdint>
#include <string>

#include "services/robot_link/handshake/refusals.hpp"
#include "services/robot_link/handshake/registers.hpp"

namespace arcstart::robot_link {

struct DeliveryLimits {
  RigidTransform T_base_frame =
      RigidTransform::Identity();               // the frame that positions are given in
  std::array<double, 3> box_low{}, box_high{};  // approach, start and end lie within; base, mm
  // Standard deviation in any direction, random and systematic; mm.
  double longest_start_deviation = 0.5, longest_end_deviation = 2;
  double longest_age = 60;  // since the scan's end; s
};

struct SeamDelivery {
  std::int32_t verdict = 0;  // kValid or a refusal number
  std::string reason;        // why it is none, in words
  Positions positions{};     // T_frame_tool, of a valid one
};

// now_utime: us, UTC. Whose answer it is, is not looked at.
SeamDelivery deliver(const seam_t& seam, const DeliveryLimits& limits, std::int64_t now_utime);

}  // namespace arcstart::robot_link
