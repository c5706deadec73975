// A scene of the wild, scanned in closed form, and what the pipeline answers to it.
#pragma once

#include <string>
#include <vector>

#include "services/cell_simulator/wild/wild_scene.hpp"
#include "services/cell_simulator/wild/wild_truth.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/scan/scan_answer.hpp"
#include "tests/seam_finding/support/wild_scan.hpp"

namespace arcstart {

// As the setting joint_type names the joint that a scene is asked for.
std::string joint_setting(const std::string& asked);

class WildCase {
 public:
  // Throws SceneError where the scene is impossible.
  explicit WildCase(const cell_simulator::WildScene& scene);

  // With the referee as seam_finding answers; without it, as it was found.
  seam_t answer(bool referee) const;

  // As it was found, before the referee; and the cloud that it was found in.
  const seam_finding::SeamResult& found() const { return found_; }
  const seam_finding::ScanCloud& cloud() const { return prepared_.cloud; }

  const cell_simulator::WildScene& scene() const { return scene_; }
  const cell_simulator::WildTruth& truth() const { return truth_; }
  // One for each of the truth's seams.
  const std::vector<seam_finding::synthetic::WildSeamSight>& sights() const { return sights_; }

 private:
  cell_simulator::WildScene scene_;
  cell_simulator::WildTruth truth_;
  std::vector<seam_finding::synthetic::WildSeamSight> sights_;
  seam_finding::SeamFindingSettings settings_;
  seam_finding::CollectedScan work_;
  seam_finding::StoredBackground background_;
  seam_finding::PreparedScan prepared_;
  seam_finding::SeamResult found_;
};

}  // namespace arcstart
