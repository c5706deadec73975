#include "services/seam_finding/cloud/outliers.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "tests/seam_finding/support/pcl_judge.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

ScanCloud plate_with_strays(int strays, std::vector<int>& all) {
  std::mt19937 engine(12);
  std::uniform_real_distribution<double> place(0, 60), off(3, 6);
  std::vector<Eigen::Vector3d> points;
  for (double x = 0; x < 60; x += 1.5)
    for (double y = 0; y < 60; y += 1.5) points.emplace_back(x, y, 0);
  for (int i = 0; i < strays; ++i) points.emplace_back(place(engine), place(engine), off(engine));
  all.resize(points.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return unorganised_cloud(points);
}

}  // namespace

TEST_CASE("outliers are those that PCL's statistical outlier removal drops") {
  std::vector<int> all;
  const ScanCloud cloud = plate_with_strays(12, all);
  for (const double deviations : {1.0, 3.0}) {
    const auto kept = without_outliers(cloud, all, 8, deviations, 2);
    const auto judged = pcl_judge::inliers(cloud.points, 8, deviations);
    std::set<int> ours(kept.begin(), kept.end()), theirs(judged.begin(), judged.end());
    std::vector<int> differ;
    std::set_symmetric_difference(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                                  std::back_inserter(differ));
    // A stray farther from all than the cells around is dropped here without a distance, and does
    // not raise the mean that the others are compared with.
    CHECK(differ.size() <= all.size() / 50);
    for (int stray = cloud.size() - 12; stray < cloud.size(); ++stray)
      CHECK(ours.contains(stray) == false);
  }
}

TEST_CASE("a plate without strays keeps its middle, and any set of one point") {
  std::vector<int> all;
  const ScanCloud cloud = plate_with_strays(0, all);
  const auto kept = without_outliers(cloud, all, 10, 3, 2);
  CHECK(kept.size() > 0.9 * static_cast<double>(all.size()));
  CHECK(without_outliers(cloud, {5}, 10, 3, 2) == std::vector<int>{5});
  CHECK(without_outliers(cloud, {}, 10, 3, 2).empty());
}
