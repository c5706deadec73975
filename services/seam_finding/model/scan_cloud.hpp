// The point cloud of a scan: its points with where they come from, and its stripes in order.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace arcstart::seam_finding {

// One stripe of a scan, also one that gave no points. (Not Stripe: that is extraction's, and one
// program holds both.)
struct ScanStripe {
  enum class Seen {
    kSeen,    // has points
    kEmpty,   // the image showed no stripe
    kMissing  // lost on its way, or its position is not known: what it would have shown is not
              // known
  };
  Seen seen = Seen::kMissing;
  int first = 0;                                                  // index of its first point
  int count = 0;                                                  // its points
  Eigen::Vector3d camera_centre = Eigen::Vector3d::Zero();        // in base; mm; where kSeen
  Eigen::Vector3d tool_position = Eigen::Vector3d::Zero();        // in base; mm; where kSeen
  Eigen::Quaterniond tool_turn = Eigen::Quaterniond::Identity();  // tool to base; where kSeen
};

// Where a point comes from.
struct PointOrigin {
  int stripe = -1;           // index into the stripes, -1 in a cloud without stripes
  int segment = 0;           // of the stripe
  bool segment_end = false;  // first or last of its segment
  float deviation = 0;       // standard deviation across the stripe; mm, 0 where not measured
  float step = 0;            // a pixel of the image along the stripe; mm, 0 where not known
};

// Either a scan, with stripes, or an unorganised cloud, without, seen from one viewpoint.
struct ScanCloud {
  std::vector<Eigen::Vector3d> points;  // in base; mm
  std::vector<PointOrigin> origins;     // as many
  std::vector<ScanStripe> stripes;      // in order of the scan

  // Of an unorganised cloud.
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  bool viewpoint_known = false;                     // given, not assumed
  std::optional<Eigen::Vector3d> search_direction;  // given

  bool organised() const { return !stripes.empty(); }
  int size() const { return static_cast<int>(points.size()); }
  const Eigen::Vector3d& seen_from(int point) const {
    const int stripe = origins[point].stripe;
    return stripe < 0 ? viewpoint : stripes[stripe].camera_centre;
  }
};

// Appends a stripe; its points are those already appended behind the stripe before.
void end_stripe(ScanCloud& cloud, ScanStripe::Seen seen,
                const Eigen::Vector3d& camera_centre = {0, 0, 0},
                const Eigen::Vector3d& tool_position = {0, 0, 0},
                const Eigen::Quaterniond& tool_turn = Eigen::Quaterniond::Identity());

ScanCloud unorganised_cloud(std::vector<Eigen::Vector3d> points);

// The tool's way through the scan, unit, in base; nothing where it moved less than 5 mm in all, or
// in a cloud without stripes that says none.
std::optional<Eigen::Vector3d> search_direction(const ScanCloud& cloud);

}  // namespace arcstart::seam_finding
