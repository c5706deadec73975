#include "services/extraction/centres/scale_map.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::extraction {
namespace {

constexpr int kMedianOver = 24;   // points to each side: more than a speckle or a scratch covers
constexpr int kOfOneMedian = 8;   // points
constexpr double kPerOctave = 4;  // sigmas

}  // namespace

void map_scales(const std::vector<Branch>& branches, const std::vector<float>& widths,
                const ScaleMapSettings& settings, std::vector<float>& sigmas, Memory memory) {
  sigmas.assign(widths.size(), 0);
  FrameVector<float> near(memory);
  for (const Branch& branch : branches) {
    if (!branch.chosen) continue;
    const int size = static_cast<int>(branch.points.size());
    for (int begin = 0; begin < size; begin += kOfOneMedian) {
      const int end = std::min(size, begin + kOfOneMedian);
      near.clear();
      for (int i = std::max(0, begin - kMedianOver); i < std::min(size, end + kMedianOver); ++i)
        if (widths[branch.points[i]] > 0) near.push_back(widths[branch.points[i]]);
      if (near.empty()) continue;
      const auto middle = near.begin() + std::ssize(near) / 2;
      std::nth_element(near.begin(), middle, near.end());
      const double wanted =
          std::clamp(settings.per_width * *middle, settings.least, settings.largest);
      const double step = std::exp2(std::round(kPerOctave * std::log2(wanted)) / kPerOctave);
      for (int i = begin; i < end; ++i) sigmas[branch.points[i]] = static_cast<float>(step);
    }
  }
}

}  // namespace arcstart::extraction
