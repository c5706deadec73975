#include "tests/seam_finding/support/pcl_judge.hpp"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <cmath>
#include <stdexcept>

namespace arcstart::pcl_judge {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr to_pcl(const Points& points) {
  Cloud::Ptr cloud(new Cloud);
  for (const auto& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  return cloud;
}

Points from_pcl(const Cloud& cloud) {
  Points points;
  for (const auto& p : cloud) points.emplace_back(p.x, p.y, p.z);
  return points;
}

}  // namespace

Plane plane(const Points& points, double tolerance) {
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setMaxIterations(1000);
  segmentation.setDistanceThreshold(tolerance);
  segmentation.setInputCloud(to_pcl(points));
  pcl::ModelCoefficients coefficients;
  pcl::PointIndices indices;
  segmentation.segment(indices, coefficients);
  Plane found;
  for (int i = 0; i < 4; ++i) found.coefficients[i] = coefficients.values.at(i);
  found.inliers.assign(indices.indices.begin(), indices.indices.end());
  return found;
}

std::vector<int> inliers(const Points& points, int neighbours, double deviations) {
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(to_pcl(points));
  filter.setMeanK(neighbours);
  filter.setStddevMulThresh(deviations);
  std::vector<int> kept;
  filter.filter(kept);
  return kept;
}

std::vector<double> kth_distance(const Points& cloud, const Points& queries, int k) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(to_pcl(cloud));
  std::vector<double> distances;
  std::vector<int> indices(k);
  std::vector<float> squared(k);
  for (const auto& q : queries) {
    tree.nearestKSearch(pcl::PointXYZ(q.x(), q.y(), q.z()), k, indices, squared);
    distances.push_back(std::sqrt(squared.back()));
  }
  return distances;
}

Points read_pcd(const std::string& path) {
  Cloud cloud;
  if (pcl::io::loadPCDFile(path, cloud) < 0) throw std::runtime_error(path);
  return from_pcl(cloud);
}

Points read_ply(const std::string& path) {
  Cloud cloud;
  if (pcl::io::loadPLYFile(path, cloud) < 0) throw std::runtime_error(path);
  return from_pcl(cloud);
}

void write_compressed_pcd(const std::string& path, const Points& points) {
  if (pcl::PCDWriter().writeBinaryCompressed(path, *to_pcl(points)) < 0)
    throw std::runtime_error(path);
}

Oriented read_oriented_pcd(const std::string& path) {
  pcl::PointCloud<pcl::PointNormal> cloud;
  if (pcl::io::loadPCDFile(path, cloud) < 0) throw std::runtime_error(path);
  Oriented oriented;
  for (const auto& p : cloud) {
    oriented.points.emplace_back(p.x, p.y, p.z);
    oriented.normals.emplace_back(p.normal_x, p.normal_y, p.normal_z);
  }
  return oriented;
}

Registration icp(const Points& scan, const Oriented& model, const Eigen::Isometry3d& guess,
                 double reach) {
  using Oriented1 = pcl::PointNormal;
  pcl::PointCloud<Oriented1>::Ptr source(new pcl::PointCloud<Oriented1>);
  pcl::PointCloud<Oriented1>::Ptr target(new pcl::PointCloud<Oriented1>);
  for (const auto& p : scan) source->emplace_back(p.x(), p.y(), p.z(), 0, 0, 0);
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const auto &p = model.points[i], &n = model.normals[i];
    target->emplace_back(p.x(), p.y(), p.z(), n.x(), n.y(), n.z());
  }
  pcl::IterativeClosestPoint<Oriented1, Oriented1> icp;
  icp.setTransformationEstimation(
      pcl::make_shared<
          pcl::registration::TransformationEstimationPointToPlaneLLS<Oriented1, Oriented1>>());
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(reach);
  icp.setMaximumIterations(100);
  icp.setTransformationEpsilon(1e-10);
  pcl::PointCloud<Oriented1> aligned;
  icp.align(aligned, guess.matrix().cast<float>());
  Registration registration;
  const Eigen::Matrix4d found = icp.getFinalTransformation().cast<double>();
  registration.T_model_scan.linear() =
      Eigen::Quaterniond(found.topLeftCorner<3, 3>()).normalized().toRotationMatrix();
  registration.T_model_scan.translation() = found.topRightCorner<3, 1>();
  registration.rms = std::sqrt(icp.getFitnessScore(reach));
  registration.converged = icp.hasConverged();
  return registration;
}

}  // namespace arcstart::pcl_judge
