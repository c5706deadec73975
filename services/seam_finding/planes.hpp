// Planes in a cloud, one after the other, by RANSAC with least-squares refinement (paper 5, steps 1
// and 2).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/scan_cloud.hpp"

namespace arcstart {

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

// A connected piece of a plane, as one side of a plate gives it.
struct Face {
  Plane plane;              // normal of either sign
  double rms = 0;           // of its points; mm
  double spacing = 0;       // of its points, the wider one where it differs by direction; mm
  std::vector<int> points;  // indices into the cloud, rising
};

// The faces of the points named by `indices`, about the largest first. Each takes its points away
// from the next; what lies in its plane and does not hang together with it is left. Points that
// only end a segment are not fitted: an end is where the stripe's centre is least certain. They are
// given to the face they lie on. The same seed gives the same faces.
std::vector<Face> find_faces(const ScanCloud& cloud, std::vector<int> indices,
                             const PlaneSearch& search, std::uint64_t seed);

}  // namespace arcstart
