// The paper's background rule.
#pragma once

#include <memory>

#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// The paper's rule (5): the K-th nearest point of the background is nearer than the distance. By
// PCL's KD-tree.
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

}  // namespace arcstart::seam_finding
