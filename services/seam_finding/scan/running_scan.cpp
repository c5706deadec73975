#include "services/seam_finding/scan/running_scan.hpp"

#include <algorithm>

#include "services/seam_finding/scan/scan_limits.hpp"

namespace arcstart::seam_finding {
namespace {

std::int64_t id_of(const StoredBackground* background) {
  return background ? background->scan_id() : 0;
}

}  // namespace

void RunningScan::take(const profile_t& profile, const StoredBackground* background) {
  if (profile.scan_id == 0) return;
  if (profile.scan_id != scan_id_ || profile.run_id != run_id_) {
    *this = RunningScan();
    scan_id_ = profile.scan_id, run_id_ = profile.run_id;
    first_seq_ = CloudBuilder::first_seq_by(profile);
    builder_.emplace(first_seq_);
  }
  if (!builder_) return;  // finished
  // What comes late, or twice, or beyond all bounds is left to finish().
  if (!seqs_.empty() && profile.seq <= seqs_.back()) return;
  if (builder_->cloud().points.size() + profile.x.size() > kMostPoints) return;
  if (background_id_ == 0 && prepared_.segmentation.size() == 0) background_id_ = id_of(background);
  builder_->add(profile);
  downsample(builder_->cloud(), prepared_.downsampled);
  thin_out(builder_->cloud(), prepared_.thinned);
  seqs_.push_back(profile.seq);
  if (background && background->scan_id() == background_id_)
    segment(builder_->cloud(), background->model(), prepared_.segmentation);
}

bool RunningScan::is_ready(const CollectedScan& scan) const {
  const std::int64_t first_seq = scan.state.first_seq >= 0 || scan.profiles.empty()
                                     ? scan.state.first_seq
                                     : CloudBuilder::first_seq_by(scan.profiles.front());
  return builder_ && scan.state.scan_id == scan_id_ && scan.state.run_id == run_id_ &&
         first_seq == first_seq_ &&
         std::equal(seqs_.begin(), seqs_.end(), scan.profiles.begin(), scan.profiles.end(),
                    [](std::int64_t seq, const profile_t& profile) { return seq == profile.seq; });
}

const PreparedScan& RunningScan::finish(const CollectedScan& scan,
                                        const StoredBackground* background) {
  was_ready_ = is_ready(scan);
  if (!was_ready_) return prepared_ = prepare(scan, background);
  builder_->miss_until(scan.state.last_seq + 1);
  downsample(builder_->cloud(), prepared_.downsampled);
  thin_out(builder_->cloud(), prepared_.thinned);
  prepared_.cloud = builder_->take_cloud();
  builder_.reset();
  if (!background || background->scan_id() != background_id_) prepared_.segmentation = {};
  if (background) segment(prepared_.cloud, background->model(), prepared_.segmentation);
  return prepared_;
}

}  // namespace arcstart::seam_finding
