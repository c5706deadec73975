// The referee: holds an answer against every stripe. It shares nothing with what found the answer
// but the model's types: from the plates, the seam and its ends as they are claimed it predicts
// what each stripe must show there, and looks whether it does.
#pragma once

#include <array>
#include <optional>

#include "services/seam_finding/model/reason.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/referee/end_bounds.hpp"
#include "services/seam_finding/referee/plate_shape.hpp"
#include "services/seam_finding/referee/plate_view.hpp"
#include "services/seam_finding/referee/seam_edges.hpp"

namespace arcstart::seam_finding {

struct Examination {
  int stripes = 0;        // that were held against the seam; 0: none could be
  double explained = -1;  // share of what is seen where the plates are claimed that is on them
  Reason contradiction;   // why the seam as a whole is not as claimed; none where it is
  std::array<EndBounds, 2> ends;                  // start and end; outward from the claim
  std::array<PlateShape, 2> shapes;               // of the plates
  std::array<std::optional<SeamEdges>, 2> edges;  // of the plates that end at the seam
  std::array<PlateView, 2> views;                 // what the stripes show of them
  double spacing = 0;                             // of the stripes along the seam; mm
};

// Of a found seam; of any other nothing is examined, nor in a cloud without stripes.
Examination examine(const ScanCloud& cloud, const SeamResult& seam);
// The same of a scan that is thinned out already.
Examination examine(const ScanCloud& cloud, const ThinnedScan& thinned, const SeamResult& seam);

}  // namespace arcstart::seam_finding
