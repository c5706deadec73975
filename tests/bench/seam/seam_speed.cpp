#include <fmt/format.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/seam_finding_app.hpp"
#include "tests/bench/seam/seam_scenes.hpp"
#include "tests/seam_finding/support/pcl_judge.hpp"
#include "tests/seam_finding/support/synthetic_messages.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

namespace arcstart {

using namespace seam_finding;
namespace {

// Of this thread alone: what else runs on the machine does not count, as on one core of its own.
double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
}

template <class Work>
double milliseconds(Work work) {
  const double begin = processor_ms();
  work();
  return processor_ms() - begin;
}

double nearest_rank(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) -
                1];
}

// Resident memory now and at its peak since reset_peak(), MB.
double memory_mb(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return std::atof(line.c_str() + key.size()) / 1024;
  return 0;
}
void reset_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

// The paper's chain with PCL's parts: K-th neighbours, two planes, outlier removal.
void paper_in_pcl(const seam_finding::ScanCloud& empty, const seam_finding::ScanCloud& work) {
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

struct Row {
  const char* name;
  int points;
  int downsample;
  double pitch;  // where the search for so many points begins; mm
  int runs;
  bool while_scanning;
};

struct Scans {
  seam_finding::ScanCloud empty, work;
};

// The paper's scan, its stripes so far apart that there are about so many points.
Scans scans_of(const Row& row) {
  const synthetic::Scene scene = synthetic::make_scene({.tool = true}, 3);
  synthetic::Scene cell = scene;
  cell.boxes.clear();
  synthetic::ScanChoice choice{.pitch = row.pitch, .downsample = row.downsample};
  Scans scans{make_scan(cell, choice, 1).cloud, make_scan(scene, choice, 2).cloud};
  if (std::abs(scans.work.size() - row.points) < row.points / 50) return scans;
  choice.pitch *= static_cast<double>(scans.work.size()) / row.points;
  return {make_scan(cell, choice, 1).cloud, make_scan(scene, choice, 2).cloud};
}

// The service on a bus in memory: profiles one by one, the scan's end told before the last.
struct WhileScanning {
  std::vector<double> of_profiles, of_last;  // ms; of_last: to the SEAM
  int answers = 0, found = 0;
};
WhileScanning measure_while_scanning(const Scans& scans, int runs) {
  WhileScanning measured;
  const auto bus = Bus::in_memory();
  bus->subscribe<seam_t>("LASER0_SEAM", Queue::measurements(), [&](const seam_t& seam) {
    ++measured.answers;
    measured.found += seam.verdict == seam_t::FOUND;
  });
  seam_finding::SeamFindingSettings settings;
  settings.dead_chain_s = 600;
  seam_finding::SeamFindingApp app(*bus, settings, Instance{"LASER0", "ROBOT0", ""});
  const auto handle = [&] {
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
  };
  const auto send = [&](const profile_t& profile) {
    return milliseconds([&] {
      bus->publish("LASER0_PROFILE", profile);
      handle();
    });
  };
  synthetic::ScanIdentity identity;
  for (int run = 0; run <= runs; ++run) {
    identity.kind = run == 0 ? scan_t::BACKGROUND : scan_t::WORKPIECE;
    identity.scan_id += 100'000'000, identity.first_seq += 10'000;
    const synthetic::ScanMessages messages =
        to_messages(run == 0 ? scans.empty : scans.work, identity);
    bus->publish("LASER0_SCAN", messages.scanning);
    handle();
    for (std::size_t k = 0; k < messages.profiles.size(); ++k) {
      const bool last = k + 1 == messages.profiles.size();
      if (last) bus->publish("LASER0_SCAN", messages.ended);
      if (last) handle();
      const double time = send(messages.profiles[k]);
      if (run > 0) (last ? measured.of_last : measured.of_profiles).push_back(time);
    }
  }
  return measured;
}

}  // namespace

void bench_speed(nlohmann::json& json) {
  fmt::print(
      "\nTime from a whole scan to its seam, processor time of one thread, ms: median and 99 % of "
      "n "
      "runs; beside it the paper's chain by PCL, once. Memory: at its peak above that of the "
      "clouds, "
      "with the background's model\n");
  fmt::print("{:>9} {:>9} {:>5} {:>9} {:>9} {:>10} {:>7} {:>9} {:>9}\n", "row", "points", "n",
             "median", "99 %", "PCL", "ratio", "MB", "byte/pt");
  for (const Row& row :
       {Row{"4400", 4'400, 15, 4.5, 200, false}, Row{"67000", 67'000, 1, 4.3, 100, true},
        Row{"100000", 100'000, 1, 2.9, 60, false}, Row{"1000000", 1'000'000, 1, 0.29, 10, false}}) {
    const Scans scans = scans_of(row);
    malloc_trim(0);
    reset_peak();
    const double before = memory_mb("VmRSS:");
    const seam_finding::SurfaceBackground background(scans.empty, 1.5);
    seam_finding::find_seam(scans.work, background, {}, 1);
    const double memory = memory_mb("VmHWM:") - before;
    std::vector<double> times;
    for (int run = 0; run < row.runs; ++run)
      times.push_back(
          milliseconds([&] { seam_finding::find_seam(scans.work, background, {}, 1); }));
    const double median = nearest_rank(times, 0.5), high = nearest_rank(times, 0.99);
    const double pcl = milliseconds([&] { paper_in_pcl(scans.empty, scans.work); });
    const std::string name = fmt::format("speed.{}", row.name);
    json[name + ".points"] = scans.work.size();
    json[name + ".n"] = row.runs;
    json[name + ".ms"] = median;
    json[name + ".p99_ms"] = high;
    json[name + ".pcl_ms"] = pcl;
    json[name + ".times_faster"] = pcl / median;
    json[name + ".memory_mb"] = memory;
    fmt::print("{:>9} {:>9} {:>5} {:>9.2f} {:>9.2f} {:>10.1f} {:>7.0f} {:>9.1f} {:>9.0f}\n",
               row.name, scans.work.size(), row.runs, median, high, pcl, pcl / median, memory,
               memory * 1024 * 1024 / scans.work.size());
    std::fflush(stdout);
    if (!row.while_scanning) continue;
    const WhileScanning measured = measure_while_scanning(scans, row.runs);
    const double p99 = nearest_rank(measured.of_last, 0.99);
    json[name + ".incremental_ms"] = nearest_rank(measured.of_last, 0.5);
    json[name + ".incremental_p99_ms"] = p99;
    json[name + ".incremental_profile_ms"] = nearest_rank(measured.of_profiles, 0.99);
    fmt::print(
        "          while scanning: from the last profile to SEAM {:.2f} (99 % {:.2f}), a profile "
        "before it {:.3f} (99 %); {} of {} scans found\n",
        nearest_rank(measured.of_last, 0.5), p99, nearest_rank(measured.of_profiles, 0.99),
        measured.found, row.runs);
    std::fflush(stdout);
  }
}

}  // namespace arcstart
