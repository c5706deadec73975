// How the torch is to be held at the start of a seam, and whence it comes.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "services/seam_finding/model/seam.hpp"

namespace arcstart::seam_finding {

struct TorchChoice {
  double work_angle = 0;  // between the torch and the flatter plate, 0: in the middle of both; rad
  double travel_angle =
      0;  // leaning back from square to the seam, so that the wire points ahead; rad
  double approach = 100;  // from the start along the torch; mm
};

// The flatter plate is the one whose normal is nearer to base z. The work angle is held within the
// joint's open angle less a tenth on either side.
TorchPose torch_at(const Eigen::Vector3d& start, const Eigen::Vector3d& direction,
                   const std::array<Eigen::Vector3d, 2>& normals, const TorchChoice& choice);

}  // namespace arcstart::seam_finding
