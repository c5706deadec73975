// What PCL answers to the same questions. The only files of the tests that include it are these: it
// takes long to compile, and Eigen's alignment must be Debian's across its border.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace arcstart::pcl_judge {

using Points = std::vector<Eigen::Vector3d>;

struct Plane {
  Eigen::Vector4d coefficients;  // unit normal and offset
  std::vector<int> inliers;
};
Plane plane(const Points& points, double tolerance);  // SACSegmentation
std::vector<int> inliers(const Points& points, int neighbours,
                         double deviations);  // StatisticalOutlierRemoval
std::vector<double> kth_distance(const Points& cloud, const Points& queries, int k);  // KdTreeFLANN

Points read_pcd(const std::string& path);
Points read_ply(const std::string& path);
void write_compressed_pcd(const std::string& path, const Points& points);

struct Oriented {
  Points points, normals;
};
Oriented read_oriented_pcd(const std::string& path);

// Takes scan into the frame of the model by ICP, point to plane, from a first guess.
struct Registration {
  Eigen::Isometry3d T_model_scan = Eigen::Isometry3d::Identity();
  double rms = 0;
  bool converged = false;
};
Registration icp(const Points& scan, const Oriented& model, const Eigen::Isometry3d& guess,
                 double reach);

}  // namespace arcstart::pcl_judge
