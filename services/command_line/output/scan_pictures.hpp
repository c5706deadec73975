// What a person can look at of replayed scans: of the last one the cloud as PCD, PLY and picture,
// and a stripe image with its centres; of each whose stripes contradict the seam, how they do.
#pragma once

#include <arcstart/image_t.hpp>
#include <arcstart/seam_t.hpp>
#include <arcstart/stripe_t.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "services/command_line/output/examined_seam.hpp"
#include "services/seam_finding/scan/scan_collector.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::command_line {

class ScanPictures {
 public:
  // The folder is there. Settings: those with which the seam was found.
  ScanPictures(const std::string& folder, const seam_finding::SeamFindingSettings& settings);

  // Follows a bus; this must outlive it.
  void listen(Bus& bus, const std::string& sensor);

  // cloud.pcd, cloud.ply and cloud.png of the last workpiece scan, stripe.png where the recording
  // held images, and contradiction_SCANID.png of each scan whose seam the referee refused or of
  // which it took an end away. Returns what was written, a line for people. Throws
  // std::runtime_error where there is nothing or no disk.
  std::string write() const;

 private:
  using Scan = std::shared_ptr<const seam_finding::CollectedScan>;
  struct Contradicted {
    Scan work, background;
  };
  void take(const stripe_t& stripe);
  void collect();
  void keep_contradicted();
  ExaminedSeam examined_again(const seam_finding::CollectedScan& work, Scan background) const;
  void write_cloud() const;
  void write_stripe() const;
  int write_contradictions() const;  // how many

  std::string folder_;
  seam_finding::SeamFindingSettings settings_;
  seam_finding::ScanCollector collector_;
  std::map<std::int64_t, Scan> backgrounds_;  // that can serve, by scan
  Scan workpiece_;                            // newest
  seam_t answer_{};                           // newest
  std::vector<Contradicted> contradicted_;
  image_t image_{};          // newest
  image_t richest_image_{};  // of the workpiece's stripe with the most segments
  stripe_t richest_{};
};

}  // namespace arcstart::command_line
