// A workpiece scan made ready while it runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/seam_finding/scan/cloud_builder.hpp"
#include "services/seam_finding/scan/scan_answer.hpp"

namespace arcstart::seam_finding {

// Takes the profiles as they come, builds the cloud and tells its points from the background, so
// that after the last one only the seam is to be sought. What it gives is what prepare() gives of
// the same scan: where it is not sure of that, the work is done anew.
class RunningScan {
 public:
  // background: the one that the scan will be compared with as far as is known now, nullptr for
  // none. A profile of another scan, or another run, begins anew.
  void take(const profile_t& profile, const StoredBackground* background);

  // Of the scan as it was collected. Ready at once where the profiles came in their order, all that
  // were taken are in it, and the background is still the same. Valid until the next take().
  const PreparedScan& finish(const CollectedScan& scan, const StoredBackground* background);

  bool was_ready() const { return was_ready_; }  // of the last finish()

 private:
  bool is_ready(const CollectedScan& scan) const;

  std::int64_t scan_id_ = 0, run_id_ = 0;
  std::int64_t background_id_ = 0;  // 0 while there was none
  std::optional<CloudBuilder> builder_;
  PreparedScan prepared_;  // but for the cloud, until it is finished
  std::int64_t first_seq_ = 0;
  std::vector<std::int64_t> seqs_;  // taken
  bool was_ready_ = false;
};

}  // namespace arcstart::seam_finding
