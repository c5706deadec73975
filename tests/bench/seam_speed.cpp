#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "services/seam_finding/find_seam.hpp"
#include "tests/bench/seam_scenes.hpp"
#include "tests/seam_finding/pcl_judge.hpp"
#include "tests/seam_finding/synthetic_scan.hpp"

namespace arcstart {
namespace {

template <class Work>
double milliseconds(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

// The paper's chain with PCL's parts: K-th neighbours, two planes, outlier removal.
void paper_in_pcl(const ScanCloud& empty, const ScanCloud& work) {
  const auto distances = pcl_judge::kth_distance(empty.points, work.points, 3);
  pcl_judge::Points left;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (distances[i] >= 1.5) left.push_back(work.points[i]);
  for (int plate = 0; plate < 2; ++plate) {
    const auto plane = pcl_judge::plane(left, 0.5);
    pcl_judge::Points on_it, rest;
    std::size_t next = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const bool inlier = next < plane.inliers.size() && plane.inliers[next] == static_cast<int>(i);
      next += inlier;
      (inlier ? on_it : rest).push_back(left[i]);
    }
    pcl_judge::inliers(on_it, 50, 1);
    left = std::move(rest);
  }
}

}  // namespace

void bench_speed(nlohmann::json& json) {
  fmt::print(
      "\nTime from a whole scan to its seam, one core, ms: median and 99 % of n runs; beside it "
      "the "
      "paper's chain by PCL, once\n");
  fmt::print("{:>9} {:>9} {:>5} {:>9} {:>9} {:>10}\n", "row", "points", "n", "median", "99 %",
             "PCL");
  struct Row {
    const char* name;
    int thin;
    double pitch;
    int runs;
    bool pcl;
  };
  for (const Row& row : {Row{"4400", 15, 3.6, 200, true}, Row{"67000", 1, 3.6, 60, true},
                         Row{"100000", 1, 2.4, 40, true}, Row{"1000000", 1, 0.24, 8, false}}) {
    const synthetic::ScanChoice choice{.pitch = row.pitch, .thin = row.thin};
    const synthetic::Scene scene = synthetic::make_scene({.tool = true}, 3);
    synthetic::Scene cell = scene;
    cell.boxes.clear();
    const ScanCloud empty = make_scan(cell, choice, 1).cloud;
    const ScanCloud work = make_scan(scene, choice, 2).cloud;
    const SurfaceBackground background(empty, 1.5);
    std::vector<double> times;
    for (int run = 0; run < row.runs; ++run)
      times.push_back(milliseconds([&] { find_seam(work, background, {}, 1); }));
    std::sort(times.begin(), times.end());
    const double median = times[times.size() / 2];
    const double high =
        times[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(times.size()))) - 1];
    const std::string name = fmt::format("speed.{}", row.name);
    json[name + ".points"] = work.size();
    json[name + ".n"] = row.runs;
    json[name + ".ms"] = median;
    json[name + ".p99_ms"] = high;
    std::string pcl = "not run";
    if (row.pcl) {
      const double time = milliseconds([&] { paper_in_pcl(empty, work); });
      json[name + ".pcl_ms"] = time;
      pcl = fmt::format("{:.1f}", time);
    }
    fmt::print("{:>9} {:>9} {:>5} {:>9.2f} {:>9.2f} {:>10}\n", row.name, work.size(), row.runs,
               median, high, pcl);
    std::fflush(stdout);
  }
}

}  // namespace arcstart
