// A stripe image with its centres, for people.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace arcstart::extraction {

struct PictureCentre {
  double u, v;  // px
  int segment;
  bool chosen;  // else a second candidate
};

// The grey image in dimmed colours, enlarged so that its longer side has about 2400 px (at least
// once, at most eight times), with every centre as a dot: chosen ones in their segment's colour,
// second candidates small and white.
cv::Mat draw_stripe(const cv::Mat& grey, const std::vector<PictureCentre>& centres);

}  // namespace arcstart::extraction
