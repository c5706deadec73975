#include "services/seam_finding/geometry/joint_geometry.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/seam_finding/answer/accuracy.hpp"
#include "services/seam_finding/answer/seam_measurements.hpp"
#include "services/seam_finding/joints/crossing_joints.hpp"
#include "services/seam_finding/joints/parallel_joints.hpp"

namespace arcstart::seam_finding {
namespace {

// Tee and corners: the seam is where the planes cross.
class CrossingPlates : public JointGeometry {
 public:
  std::vector<Joint> candidates(const ScanView& scan, const std::vector<Face>& faces,
                                const Scales& scales,
                                const SeamFindingSettings& settings) const override {
    std::vector<Joint> joints;
    for (const JointType type : wanted_types(settings.joint_type)) {
      if (is_parallel(type)) continue;
      auto found =
          find_crossing_joints(scan.points_for(Stage::kSearch), scan.workpiece(Stage::kSearch),
                               faces, type, scales, settings);
      std::move(found.begin(), found.end(), std::back_inserter(joints));
    }
    return joints;
  }
  std::optional<SeamAccuracy> accuracy(const ScanCloud& cloud, const Joint& joint,
                                       const std::array<SeamEnd, 2>& ends, const Scales& scales,
                                       const SeamFindingSettings& settings) const override {
    return crossing_accuracy(joint, plane_accuracies(cloud, joint, scales, settings), ends);
  }
  std::vector<SeamMeasurement> measurements(const ScanCloud& cloud, const Joint& joint,
                                            double begin, double end,
                                            const Scales& scales) const override {
    return measure_crossing_seam(cloud, joint, begin, end, scales.spacing);
  }
  std::array<Eigen::Vector3d, 2> torch_faces(const Joint& joint) const override {
    return {joint.plates[0].plane.normal, joint.plates[1].plane.normal};
  }
};

// Lap, butt joint and V-groove: the seam is where the plates' edges lie.
class ParallelPlates : public JointGeometry {
 public:
  // They hang on where stripes pass from the one plate to the other: all points are needed.
  std::vector<Joint> candidates(const ScanView& scan, const std::vector<Face>& faces,
                                const Scales& scales,
                                const SeamFindingSettings& settings) const override {
    const auto wanted = wanted_types(settings.joint_type);
    if (std::none_of(wanted.begin(), wanted.end(), is_parallel)) return {};
    std::vector<Face> whole = faces;
    for (Face& face : whole)
      face.points = scan.all_on_plane(std::move(face.points), face.plane, scales.tolerance);
    return find_parallel_joints(scan.points_for(Stage::kMeasure), whole, scales, settings);
  }
  std::optional<SeamAccuracy> accuracy(const ScanCloud& cloud, const Joint& joint,
                                       const std::array<SeamEnd, 2>& ends, const Scales& scales,
                                       const SeamFindingSettings& settings) const override {
    return parallel_accuracy(joint, plane_accuracies(cloud, joint, scales, settings), ends);
  }
  std::vector<SeamMeasurement> measurements(const ScanCloud& cloud, const Joint& joint,
                                            double begin, double end,
                                            const Scales& scales) const override {
    return measure_parallel_seam(cloud, joint, begin, end, scales.spacing);
  }
  // For parallel plates the second face is virtual: for a lap the upper plate's edge face, for the
  // others both, a right angle about their normal.
  std::array<Eigen::Vector3d, 2> torch_faces(const Joint& joint) const override {
    const Eigen::Vector3d& normal = joint.plates[0].plane.normal;
    if (joint.type == JointType::kLap) return {normal, joint.plates[joint.parallel->lower].away};
    const Eigen::Vector3d across = normal.cross(joint.line.direction).normalized();
    return {(normal + across).normalized(), (normal - across).normalized()};
  }
};

}  // namespace

const JointGeometry& crossing_plates() {
  static const CrossingPlates crossing;
  return crossing;
}

const JointGeometry& parallel_plates() {
  static const ParallelPlates parallel;
  return parallel;
}

const JointGeometry& geometry_of(const Joint& joint) {
  return joint.parallel ? parallel_plates() : crossing_plates();
}

}  // namespace arcstart::seam_finding
