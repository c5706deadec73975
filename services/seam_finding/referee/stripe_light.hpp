// The sheet of laser light of each stripe, as the calibration has it: a plane that is fixed to the
// tool.
#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

struct StripeLight {
  Plane plane;  // in base
  // Where its rays are taken to come from: the foot of the camera's centre in the plane. The
  // projector's true place is in no calibration; it lies within some 30 mm, for image columns then
  // run along the rays, as every such sensor is built.
  Eigen::Vector3d source = Eigen::Vector3d::Zero();  // in base; mm
};

// One a stripe of the cloud, nothing for one without points. The plane is fitted to all points in
// the tool's frame: they were put on it when they were carried to the base. Empty where they do
// not span a plane, as in a cloud without stripes.
std::vector<std::optional<StripeLight>> light_of(const ScanCloud& cloud);

}  // namespace arcstart::seam_finding
