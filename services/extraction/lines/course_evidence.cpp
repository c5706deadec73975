#include "services/extraction/lines/course_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::extraction {
namespace {

double quantile(FrameVector<float>& values, std::size_t numerator, std::size_t denominator) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() * numerator / denominator);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

CourseEvidence course_evidence(const std::vector<RidgePoint>& points,
                               const std::vector<Chain>& chains, const StripePath& course,
                               double factor, int lines, Memory memory) {
  FrameVector<char> of_course(points.size(), 0, memory);
  FrameVector<float> strengths(memory), others(memory);
  double sum = 0, segments = 0;
  for (const Branch& branch : course.branches) {
    if (!branch.chosen) continue;
    ++segments;
    for (const int i : branch.points) {
      of_course[i] = 1;
      strengths.push_back(static_cast<float>(factor) * points[i].curvature);
      sum += strengths.back();
    }
  }
  CourseEvidence evidence;
  if (strengths.empty()) return evidence;
  for (const Chain& chain : chains)
    for (const int i : chain)
      if (of_course[i] == 0) others.push_back(static_cast<float>(factor) * points[i].curvature);
  evidence.weight = sum * std::sqrt(static_cast<double>(strengths.size()) / segments / lines);
  evidence.centres = static_cast<int>(strengths.size());
  evidence.faint = quantile(strengths, 1, 4);
  evidence.usual = quantile(strengths, 1, 2);
  if (std::ssize(others) >= lines) evidence.others = quantile(others, 1, 2);
  return evidence;
}

}  // namespace arcstart::extraction
