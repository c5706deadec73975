// A seam as it was found, and what the referee had against it.
#pragma once

#include <arcstart/seam_t.hpp>
#include <vector>

#include "services/seam_finding/model/reason.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/referee/examination.hpp"

namespace arcstart::command_line {

struct ExaminedSeam {
  seam_finding::SeamResult found;  // before the referee ruled
  seam_finding::SeamResult ruled;
  seam_finding::Examination examination;
  // Why the seam was refused, or else why its ends are not determined; none where it was upheld.
  std::vector<seam_finding::Reason> objections;
};
ExaminedSeam examined(const seam_finding::ScanCloud& cloud, const seam_finding::SeamResult& found);

// Whether the answer may be one that the referee refused, or an end of which it took away: all that
// are, and of the others those alone that are not usable for another reason.
bool may_be_contradicted(const seam_t& answer);

}  // namespace arcstart::command_line
