// What depends on how a joint's plates lie to each other: crossing or parallel.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "services/seam_finding/background/scan_view.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

class JointGeometry {
 public:
  virtual ~JointGeometry() = default;

  // The joints of the wanted types between the faces (Eq. 6), with a flaw where something speaks
  // against one; none where no such type is wanted. faces: of the points for the search, their
  // normals toward the sensor.
  virtual std::vector<Joint> candidates(const ScanView& scan, const std::vector<Face>& faces,
                                        const Scales& scales,
                                        const SeamFindingSettings& settings) const = 0;
  // Nothing where it is not determined.
  virtual std::optional<SeamAccuracy> accuracy(const ScanCloud& cloud, const Joint& joint,
                                               const std::array<SeamEnd, 2>& ends,
                                               const Scales& scales,
                                               const SeamFindingSettings& settings) const = 0;
  // Along the seam, from begin to end on the joint's line; mm.
  virtual std::vector<SeamMeasurement> measurements(const ScanCloud& cloud, const Joint& joint,
                                                    double begin, double end,
                                                    const Scales& scales) const = 0;
  // Normals of the two faces between which the torch stands.
  virtual std::array<Eigen::Vector3d, 2> torch_faces(const Joint& joint) const = 0;
};

const JointGeometry& crossing_plates();  // tee and corners
const JointGeometry& parallel_plates();  // lap, butt joint and V-groove
const JointGeometry& geometry_of(const Joint& joint);

}  // namespace arcstart::seam_finding
