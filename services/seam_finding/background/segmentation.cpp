#include "services/seam_finding/background/segmentation.hpp"

#include <span>

namespace arcstart::seam_finding {

void divide(const ScanCloud& scan, const Background& background, Division& division) {
  const int first = division.size();
  const auto rest = std::span(scan.points).subspan(static_cast<std::size_t>(first));
  std::vector<char> inside;
  inside.reserve(rest.size());
  background.classify(rest, inside);
  if (first == 0) division.background.reserve(rest.size()), division.left.reserve(rest.size());
  for (std::size_t i = 0; i < inside.size(); ++i)
    (inside[i] ? division.background : division.left).push_back(first + static_cast<int>(i));
}

Division division_of(const ThinnedCloud& thinned, const Division& whole) {
  Division division;
  auto left = whole.left.begin();
  for (int i = 0; i < thinned.cloud.size(); ++i) {
    while (left != whole.left.end() && *left < thinned.places[i]) ++left;
    const bool is_left = left != whole.left.end() && *left == thinned.places[i];
    (is_left ? division.left : division.background).push_back(i);
  }
  return division;
}

}  // namespace arcstart::seam_finding
