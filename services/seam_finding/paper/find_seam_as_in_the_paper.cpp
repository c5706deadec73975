#include "services/seam_finding/paper/find_seam_as_in_the_paper.hpp"

// The only file here that includes PCL: it must be compiled for the plain instruction set, as
// Debian's PCL is, or Eigen's alignment differs across the library's border.
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "common/geometry.hpp"
#include "services/seam_finding/planes/planes.hpp"

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

std::vector<Face> two_largest_faces(const ScanCloud& cloud, const std::vector<int>& workpiece,
                                    PlaneSearch search, const SeamFindingSettings& settings,
                                    std::uint64_t seed) {
  const double theta = settings.angle_deg * kDegree,
               epsilon = settings.angle_tolerance_deg * kDegree;
  search.most_faces = 1;
  auto faces = find_faces(cloud, workpiece, search, seed);
  if (faces.empty()) return faces;
  std::vector<int> rest;
  std::set_difference(workpiece.begin(), workpiece.end(), faces[0].points.begin(),
                      faces[0].points.end(), std::back_inserter(rest));
  const Eigen::Vector3d n1 = faces[0].plane.normal;
  search.accept = [&](const Plane& plane) {
    const double angle = std::acos(std::min(1.0, std::abs(n1.dot(plane.normal))));
    return std::min(std::abs(angle - theta), std::abs(M_PI - angle - theta)) < epsilon;
  };
  for (Face& face : find_faces(cloud, rest, search, seed)) faces.push_back(std::move(face));
  return faces;
}

double centroid_of_first(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                         const Line& line, const Coverage& course, int count) {
  std::vector<double> places;
  for (const JointPlate& plate : plates)
    for (const int i : plate.points) {
      const double t = line.along(cloud.points[i]);
      if (t >= course.begin && t <= course.end && line.distance(cloud.points[i]) <= plate.contact)
        places.push_back(t);
    }
  if (places.empty()) return course.begin;
  std::sort(places.begin(), places.end());
  places.resize(std::min(places.size(), static_cast<std::size_t>(count)));
  double sum = 0;
  for (const double t : places) sum += t;
  return sum / static_cast<double>(places.size());
}

}  // namespace arcstart::seam_finding
