// The only file here that includes PCL: it must be compiled for the plain instruction set, as
// Debian's PCL is, or Eigen's alignment differs across the library's border.
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include "services/seam_finding/background/background.hpp"

namespace arcstart::seam_finding {

struct NeighbourBackground::Tree {
  pcl::KdTreeFLANN<pcl::PointXYZ> search;
  pcl::PointCloud<pcl::PointXYZ>::Ptr points{new pcl::PointCloud<pcl::PointXYZ>};
  Eigen::Vector3d origin =
      Eigen::Vector3d::Zero();  // PCL's points are floats: taken relative to one of them
};

NeighbourBackground::NeighbourBackground(const ScanCloud& cloud, int neighbours, double distance_mm)
    : tree_(std::make_unique<Tree>()), neighbours_(neighbours), distance_(distance_mm) {
  if (cloud.size() < neighbours) return;
  tree_->origin = cloud.points.front();
  for (const auto& point : cloud.points) {
    const Eigen::Vector3f p = (point - tree_->origin).cast<float>();
    tree_->points->emplace_back(p.x(), p.y(), p.z());
  }
  tree_->search.setInputCloud(tree_->points);
}

NeighbourBackground::~NeighbourBackground() = default;

bool NeighbourBackground::contains(const Eigen::Vector3d& point) const {
  if (tree_->points->empty()) return false;
  const Eigen::Vector3f p = (point - tree_->origin).cast<float>();
  std::vector<int> indices(static_cast<std::size_t>(neighbours_));
  std::vector<float> squared(indices.size());
  if (tree_->search.nearestKSearch(pcl::PointXYZ(p.x(), p.y(), p.z()), neighbours_, indices,
                                   squared) < neighbours_)
    return false;
  return squared.back() < distance_ * distance_;
}

}  // namespace arcstart::seam_finding
