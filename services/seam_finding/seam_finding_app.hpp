// The service `seam_finding`: <SENSOR>_PROFILE, _SCAN and _CALIBRATION in, <SENSOR>_SEAM out, one
// for each scan.
#pragma once

#include <arcstart/calibration_t.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/calibration.hpp"
#include "common/service.hpp"
#include "services/seam_finding/jobs/job_book.hpp"
#include "services/seam_finding/scan/running_scan.hpp"
#include "services/seam_finding/scan/scan_store.hpp"

namespace arcstart::seam_finding {

class SeamFindingApp : public App {
 public:
  // The bus must outlive the app. Without a state folder nothing touches the disk. Throws
  // ScanStoreError where the folder cannot be made.
  SeamFindingApp(Bus& bus, const SeamFindingSettings& settings, const Instance& instance,
                 JobBook jobs);
  SeamFindingApp(Bus& bus, const SeamFindingSettings& settings, const Instance& instance)
      : SeamFindingApp(bus, settings, instance, JobBook(settings)) {}

  // Repeats the answer at 1 Hz until the next scan starts, and gives up a scan whose chain is dead.
  // Nothing else here hangs on real time.
  void tick(std::int64_t now_utime) override;
  Health health() const override;

 private:
  void take(const scan_t& state);
  void take(const profile_t& profile);
  void take(const calibration_t& message);
  void answer_decided();
  seam_t take_background(const CollectedScan& scan);
  void remember(const CollectedScan& scan);
  const Calibration* calibration_for(const CollectedScan& scan) const;
  const StoredBackground* background_for(std::int64_t scan_id,
                                         const std::string& calibration) const;
  seam_t take_workpiece(const CollectedScan& scan);
  void send(const seam_t& seam);

  Bus& bus_;
  SeamFindingSettings settings_;
  JobBook jobs_;
  std::string seam_channel_;
  ScanCollector collector_;
  RunningScan running_;
  ScanStore store_;
  std::vector<std::unique_ptr<StoredBackground>> backgrounds_;  // oldest first
  std::vector<Calibration> calibrations_;                       // newest last

  std::vector<std::uint8_t> answer_;  // as sent, empty once the next scan has started
  std::int64_t answered_scan_ = 0;
  std::string answer_mark_;  // of answer_
  // us, steady. alive_: the last sign of life of a scan that is open.
  std::int64_t next_repeat_ = 0, alive_ = 0;
  std::string store_error_, background_store_error_, last_error_;
};

// The whole main of arcstart-seam-finding.
int run(int argc, char** argv);

}  // namespace arcstart::seam_finding
