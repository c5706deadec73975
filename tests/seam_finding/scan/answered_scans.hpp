// A background and a workpiece scan of one scene, as they were collected.
#pragma once

#include <cstddef>

#include "services/seam_finding/scan/scan_answer.hpp"
#include "tests/seam_finding/support/synthetic_messages.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

namespace arcstart::seam_finding::synthetic {

inline CollectedScan as_collected(const ScanMessages& messages) {
  CollectedScan scan;
  scan.state = messages.ended;
  scan.profiles = messages.profiles;
  return scan;
}

// Background and workpiece scan of one scene.
struct AnsweredScans {
  Scene scene = make_scene({.tool = true}, 11);
  CollectedScan empty, work;

  AnsweredScans() {
    Scene cell = scene;
    cell.boxes.clear();
    ScanIdentity identity;
    work = as_collected(to_messages(make_scan(scene, {}, 1).cloud, identity));
    identity.scan_id -= 60'000'000;
    identity.kind = scan_t::BACKGROUND;
    empty = as_collected(to_messages(make_scan(cell, {}, 2).cloud, identity));
  }
  seam_t answer(const SeamFindingSettings& settings = {}) const {
    const StoredBackground background(empty, settings);
    return answer_workpiece(work, &background, settings);
  }
  void lose(CollectedScan& scan, std::size_t from, std::size_t count) {
    scan.profiles.erase(scan.profiles.begin() + static_cast<std::ptrdiff_t>(from),
                        scan.profiles.begin() + static_cast<std::ptrdiff_t>(from + count));
    scan.profiles_lost += static_cast<int>(count);
  }
  double start_error(const seam_t& seam) const {
    return (Eigen::Map<const Eigen::Vector3d>(seam.start) - scene.start).norm();
  }
};

}  // namespace arcstart::seam_finding::synthetic
