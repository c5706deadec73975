// From a scan's profiles to its cloud, one profile after the other.
#pragma once

#include <arcstart/profile_t.hpp>
#include <cstdint>

#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// A whole image showed nothing within the working range: nothing was there. (Of one that was cut
// short or over-lit, or whose position is not known, nobody can say.)
bool showed_nothing(const profile_t& profile);

class CloudBuilder {
 public:
  // first_seq: of the scan's first image, -1 where that is not known: then as the first profile's
  // place in the scan tells it.
  explicit CloudBuilder(std::int64_t first_seq);

  // In order of seq. A kMissing stripe stands for each that was left out.
  void add(const profile_t& profile);
  void miss_until(std::int64_t seq);  // those before it did not come

  const ScanCloud& cloud() const { return cloud_; }
  ScanCloud take_cloud() { return std::move(cloud_); }

  // Of the scan's first image, as a profile tells it.
  static std::int64_t first_seq_by(const profile_t& profile) {
    return profile.seq - (profile.scan_index > 0 ? profile.scan_index : 0);
  }

 private:
  ScanCloud cloud_;
  std::int64_t next_seq_;
};

}  // namespace arcstart::seam_finding
