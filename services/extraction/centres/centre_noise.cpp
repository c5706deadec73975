#include "services/extraction/centres/centre_noise.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace arcstart::extraction {
namespace {

constexpr std::size_t kFewestSamples = 40;

}  // namespace

CentreNoise centre_noise(const std::vector<Branch>& branches,
                         const std::vector<MeasuredCentre>& centres, double sigma, Memory memory) {
  const auto lag = static_cast<std::ptrdiff_t>(std::max(3.0, std::ceil(2 * sigma)));
  struct Sample {
    float law, square;  // variance by the law and as seen; px^2
  };
  FrameVector<Sample> samples(memory);
  for (const Branch& branch : branches) {
    if (!branch.chosen) continue;
    for (std::ptrdiff_t i = 2 * lag; i + 2 * lag < std::ssize(branch.points); ++i) {
      const int* here = branch.points.data() + i;
      const MeasuredCentre &a = centres[here[-2 * lag]], &b = centres[here[-lag]],
                           &p = centres[*here], &c = centres[here[lag]],
                           &d = centres[here[2 * lag]];
      const double du = c.u - b.u, dv = c.v - b.v, length = std::hypot(du, dv);
      if (length == 0) continue;
      const double u = a.u - 4 * b.u + 6 * p.u - 4 * c.u + d.u,
                   v = a.v - 4 * b.v + 6 * p.v - 4 * c.v + d.v;
      const double across = (u * dv - v * du) / length;
      const double near = std::exp(-static_cast<double>(lag * lag) / (4 * p.sigma * p.sigma));
      const double variances = 70 - 112 * near + 56 * std::pow(near, 4) - 16 * std::pow(near, 9);
      samples.push_back(
          {p.deviation * p.deviation, static_cast<float>(across * across / variances)});
    }
  }
  if (samples.size() < kFewestSamples) return {};
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end(),
                   [](const Sample& a, const Sample& b) { return a.law < b.law; });
  // Median of a square is 0.4549 of its mean, for a normal error.
  const auto half = [](auto begin, auto end) {
    const auto at = begin + (end - begin) / 2;
    std::nth_element(begin, at, end,
                     [](const Sample& a, const Sample& b) { return a.law < b.law; });
    const double law = at->law;
    std::nth_element(begin, at, end,
                     [](const Sample& a, const Sample& b) { return a.square < b.square; });
    return std::pair(law, at->square / 0.4549);
  };
  const auto [strong_law, strong_square] = half(samples.begin(), middle);
  const auto [faint_law, faint_square] = half(middle, samples.end());
  CentreNoise scatter;
  scatter.variance = (strong_square + faint_square) / 2;
  scatter.per_law = (faint_square - strong_square) / (faint_law - strong_law);
  if (scatter.per_law < strong_square / strong_law) {
    scatter.per_law = std::max(scatter.per_law, 1.0);
    scatter.base = std::max(0.0, scatter.variance - scatter.per_law * (strong_law + faint_law) / 2);
  } else {  // all of it grows with the law
    scatter.per_law = std::max(1.0, 2 * scatter.variance / (strong_law + faint_law));
  }
  return scatter;
}

}  // namespace arcstart::extraction
