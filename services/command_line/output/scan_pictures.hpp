// What a person can look at of a replayed scan: the cloud as PCD, PLY and picture, and a stripe
// image with its centres.
#pragma once

#include <arcstart/image_t.hpp>
#include <arcstart/stripe_t.hpp>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "services/seam_finding/scan/scan_collector.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::command_line {

class ScanPictures {
 public:
  // The folder is there. Settings: those with which the seam was found.
  ScanPictures(const std::string& folder, const seam_finding::SeamFindingSettings& settings);

  // Follows a bus; this must outlive it.
  void listen(Bus& bus, const std::string& sensor);

  // cloud.pcd, cloud.ply and cloud.png of the last workpiece scan, and stripe.png where the
  // recording held images. Returns what was written, a line for people. Throws std::runtime_error
  // where there is nothing or no disk.
  std::string write() const;

 private:
  void take(const stripe_t& stripe);
  void write_cloud() const;
  void write_stripe() const;

  std::string folder_;
  seam_finding::SeamFindingSettings settings_;
  seam_finding::ScanCollector collector_;
  std::optional<seam_finding::CollectedScan> background_, workpiece_;  // newest
  image_t image_{};                                                    // newest
  image_t richest_image_{};  // of the workpiece's stripe with the most segments
  stripe_t richest_{};
};

}  // namespace arcstart::command_line
