#include "services/seam_finding/background/segmentation.hpp"

#include <cstddef>
#include <span>

namespace arcstart::seam_finding {

void segment(const ScanCloud& scan, const Background& background, Segmentation& segmentation) {
  const int first = segmentation.size();
  const auto rest = std::span(scan.points).subspan(static_cast<std::size_t>(first));
  std::vector<Belonging> belonging;
  belonging.reserve(rest.size());
  background.classify(rest, belonging);
  if (first == 0)
    segmentation.background.reserve(rest.size()), segmentation.workpiece.reserve(rest.size());
  for (std::size_t i = 0; i < belonging.size(); ++i) {
    const int point = first + static_cast<int>(i);
    const bool inside = belonging[i] == Belonging::kBackground;
    (inside ? segmentation.background : segmentation.workpiece).push_back(point);
    if (belonging[i] == Belonging::kOff) segmentation.off.push_back(point);
  }
}

Segmentation segmentation_of(const DownsampledCloud& downsampled, const Segmentation& whole) {
  Segmentation segmentation;
  auto left = whole.workpiece.begin(), off = whole.off.begin();
  const auto is_next = [&](auto& next, const std::vector<int>& of, int place) {
    while (next != of.end() && *next < place) ++next;
    return next != of.end() && *next == place;
  };
  for (int i = 0; i < downsampled.cloud.size(); ++i) {
    const int place = downsampled.places[i];
    (is_next(left, whole.workpiece, place) ? segmentation.workpiece : segmentation.background)
        .push_back(i);
    if (is_next(off, whole.off, place)) segmentation.off.push_back(i);
  }
  return segmentation;
}

}  // namespace arcstart::seam_finding
