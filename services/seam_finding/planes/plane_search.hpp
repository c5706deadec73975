// What counts as a plane of the cloud.
#pragma once

#include <functional>

#include "common/geometry.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

struct PlaneSearch {
  double tolerance = 0.5;  // distance from the plane up to which a point belongs to it; mm
  double connection =
      8;  // points farther apart than this, or at most twice this, do not hang together; mm
  int least_points = 40;  // a face of fewer is none
  int most_faces = 16;
  int hypotheses = 600;  // drawn for each face
  double locality = 40;  // the three points of a hypothesis lie in one cube of this side; mm
  std::function<bool(const Plane&)>
      accept;  // a hypothesis that fails it is rejected (Eq. 6); empty accepts all
};

// As the cloud's scales and the settings say.
PlaneSearch plane_search(const Scales& scales, const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
