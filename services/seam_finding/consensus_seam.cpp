#include "services/seam_finding/consensus_seam.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "services/seam_finding/cloud/scales.hpp"
#include "services/seam_finding/find_seam.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr int kDraws = 9;
constexpr int kAgree = 6;
constexpr double kWidest = 2;  // tolerance of the last draw over that of the first
constexpr double kSameDirection = 5 * M_PI / 180;
constexpr double kSamePlace = 10;  // between the lines; mm

bool found(const SeamResult& result) { return result.verdict == SeamResult::Verdict::kFound; }

bool agree(const SeamResult& a, const SeamResult& b) {
  const Line line{a.start, a.direction};
  const double from = line.along(b.start), to = line.along(b.end);
  const double length = (a.end - a.start).norm();
  const double shared = std::min(length, std::max(from, to)) - std::max(0.0, std::min(from, to));
  return std::abs(a.direction.dot(b.direction)) > std::cos(kSameDirection) &&
         line.distance((b.start + b.end) / 2) < kSamePlace &&
         2 * shared > std::min(length, std::abs(to - from));
}

}  // namespace

SeamResult find_consensus_seam(const ScanCloud& scan, const Background& background,
                               const SeamFindingSettings& settings, std::uint64_t seed) {
  std::vector<SeamResult> results, others;
  const double tolerance =
      scales_of(scan, measure_sampling(scan), settings.plane_tolerance_mm).tolerance;
  SeamFindingSettings drawn = settings;
  for (int draw = 0; draw < kDraws; ++draw) {
    if (settings.plane_tolerance_mm == 0)
      drawn.plane_tolerance_mm = tolerance * (1 + (kWidest - 1) * draw / (kDraws - 1));
    SeamResult result = find_seam(scan, background, drawn, seed + static_cast<std::uint64_t>(draw));
    (found(result) ? results : others).push_back(std::move(result));
  }
  const auto support = [&](const SeamResult& a) {
    return std::count_if(results.begin(), results.end(),
                         [&](const SeamResult& b) { return agree(a, b); });
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < results.size(); ++i)
    if (support(results[i]) > support(results[best])) best = i;
  if (!results.empty() && support(results[best]) >= kAgree) return results[best];
  if (static_cast<int>(others.size()) >= kAgree || results.empty()) return others.front();

  SeamResult refused;
  refused.reason = {Reason::Code::kDrawsDisagree, static_cast<double>(results.size()), kDraws,
                    static_cast<double>(support(results[best]))};
  for (const SeamResult& result : results)
    refused.alternatives.push_back({result.joint_type,
                                    static_cast<double>(support(result)),
                                    result.start,
                                    result.end,
                                    {Reason::Code::kFewDrawsAgree}});
  std::stable_sort(refused.alternatives.begin(), refused.alternatives.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  refused.background = results[best].background;
  return refused;
}

}  // namespace arcstart::seam_finding
