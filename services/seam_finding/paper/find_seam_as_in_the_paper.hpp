// The paper's own rules (5), to be chosen in the settings: what is background, which planes make
// the joint, and where its seam starts. The product's answers come from others.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/planes/plane_search.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// background_rule neighbours: the K-th nearest point of the background is nearer than the distance.
// By PCL's KD-tree.
class NeighbourBackground : public Background {
 public:
  NeighbourBackground(const ScanCloud& cloud, int neighbours, double distance_mm);
  ~NeighbourBackground() override;
  bool contains(const Eigen::Vector3d& point) const override;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  int neighbours_;
  double distance_;
};

// plane_rule largest: the largest plane, then the largest that satisfies Eq. 6 with it.
// `workpiece`: indices of the points that are not background.
std::vector<Face> two_largest_faces(const ScanCloud& cloud, const std::vector<int>& workpiece,
                                    PlaneSearch search, const SeamFindingSettings& settings,
                                    std::uint64_t seed);

// start_rule centroid: where along the line the centroid of the first `count` points of both plates
// lies, from the coverage's begin on; mm.
double centroid_of_first(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                         const Line& line, const Coverage& course, int count);

}  // namespace arcstart::seam_finding
