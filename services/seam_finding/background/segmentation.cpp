#include "services/seam_finding/background/segmentation.hpp"

#include <cstddef>
#include <span>

namespace arcstart::seam_finding {

void segment(const ScanCloud& scan, const Background& background, Segmentation& segmentation) {
  const int first = segmentation.size();
  const auto rest = std::span(scan.points).subspan(static_cast<std::size_t>(first));
  std::vector<char> inside;
  inside.reserve(rest.size());
  background.classify(rest, inside);
  if (first == 0)
    segmentation.background.reserve(rest.size()), segmentation.workpiece.reserve(rest.size());
  for (std::size_t i = 0; i < inside.size(); ++i)
    (inside[i] ? segmentation.background : segmentation.workpiece)
        .push_back(first + static_cast<int>(i));
}

Segmentation segmentation_of(const DownsampledCloud& downsampled, const Segmentation& whole) {
  Segmentation segmentation;
  auto left = whole.workpiece.begin();
  for (int i = 0; i < downsampled.cloud.size(); ++i) {
    while (left != whole.workpiece.end() && *left < downsampled.places[i]) ++left;
    const bool is_left = left != whole.workpiece.end() && *left == downsampled.places[i];
    (is_left ? segmentation.workpiece : segmentation.background).push_back(i);
  }
  return segmentation;
}

}  // namespace arcstart::seam_finding
