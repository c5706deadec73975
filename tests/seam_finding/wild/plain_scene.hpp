// A scene of the wild without anything wild: what its tests change by hand.
#pragma once

#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::seam_finding::synthetic {

// A tee in the table's middle: seam from (900, 0, 10) to (1000, 0, 10), the base plate begins 20 mm
// earlier. Nothing errs.
inline cell_simulator::WildScene plain_tee() {
  cell_simulator::WildScene scene;
  cell_simulator::WildWork work;
  work.first.thickness_mm = 10;
  work.first.away_mm = 50;
  work.first.behind_mm = 40;
  work.first.begin.at_mm = -70;
  work.first.end.at_mm = 70;
  work.second.thickness_mm = 8;
  work.second.away_mm = 40;
  scene.works = {work};
  scene.table.unevenness_mm = 0;
  scene.scan.jitter_mm = 0;
  return scene;
}

}  // namespace arcstart::seam_finding::synthetic
