// How the torch is to be held at the start of a seam, and whence it comes.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

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

// Of a found seam, from its start, direction and torch faces. Where its orientation is taught, it
// stands so, if from there the wire comes out of the open side of both faces, else not at all. The
// bias moves the tip and the approach.
void set_torch(const SeamFindingSettings& settings, SeamResult& seam);

}  // namespace arcstart::seam_finding
