// A stripe that is narrow here and wide there: looked for at several scales at once.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/extraction/centres/centre_refinement.hpp"
#include "services/extraction/centres/scale_map.hpp"
#include "services/extraction/centres/stripe_quality.hpp"
#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::extraction {
namespace {

// px: for stripes of a width from 1 to 8. Of a step of 1.9 in sigma a stripe between two of them
// loses a tenth of its strength.
constexpr std::array kMixedScales{1.4f, 2.6f, 5.0f, 9.5f};
// Of the widths along a course, the twentieth from above by the twentieth from below, from which on
// no single sigma does for both.
constexpr double kUnlikeWidths = 2.5;
constexpr int kFarthestMoved = 5;  // px, of a centre measured at another sigma
// Of the image's columns or rows: a course that covers less may be seen at another scale elsewhere.
constexpr double kCovered = 0.9;
// Times the evidence of the single scale's course, and its centres: several scales are for what one
// leaves out; where it leaves out nothing it tells the course as well. Row mixed_width (seeds 201
// to 218) has 1.16 to 1.94 and 1.11 to 1.58 where they are needed.
constexpr double kBetter = 1.1, kMoreCentres = 1.08;

// Of the columns or rows, by a course of several scales: over a print and the like, where less is
// found, its pieces are as often the print's own (row print, seed 304).
constexpr double kLeastCovered = 0.8;

// A white top is a bar, which needs a sigma of half its width / sqrt(3) at least: a smaller one
// finds a line on each of its rims.
bool beside_white_bar(const GreyImage& image, const RidgePoint& p, double sigma) {
  const int reach = static_cast<int>(std::ceil(4 * sigma));
  int white = 0;
  for (int k = -reach; k <= reach; ++k)
    white += is_saturated(image, p.u + static_cast<float>(k) * p.normal_u,
                          p.v + static_cast<float>(k) * p.normal_v);
  return white > 2 * std::numbers::sqrt3 * sigma;
}

}  // namespace

bool StripeExtractor::widths_differ() {
  FrameVector<float> known(&memory_);
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points)
        if (widths_[i] > 0) known.push_back(widths_[i]);
  if (known.empty()) return false;
  const auto low = known.begin() + std::ssize(known) / 20,
             high = known.begin() + std::ssize(known) * 19 / 20;
  std::nth_element(known.begin(), low, known.end());
  const float narrow = *low;
  std::nth_element(known.begin(), high, known.end());
  return *high > kUnlikeWidths * narrow;
}

void StripeExtractor::look_at_all_scales(const GreyImage& image) {
  merged_.clear();
  used_sigma_ = kMixedScales[1];
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  for (std::size_t k = 0; k < kMixedScales.size(); ++k) {
    least_strength_ = least_of_scale_[k];
    find_lines(image, kMixedScales[k]);
    if (in_texture()) continue;
    for (Chain& chain : chains_)
      std::erase_if(chain,
                    [&](int i) { return beside_white_bar(image, points_[i], kMixedScales[k]); });
    merged_.add(points_, chains_, kMixedScales[k],
                strength_factor(kMixedScales[k], settings_.strength_exponent), factor, heap());
  }
  chains_.clear();
  selection_.branches.clear();
  memory_.take_back();
  keep_best_scale(merged_, settings_.fewest_centres / 2, heap());
  points_.swap(merged_.points);
  chains_.swap(merged_.chains);
  used_sigma_ = kMixedScales[1];
  crowded_ = false;
  choose_course(image);
}

// Strength of the middle one of the chained points beside the course, of each scale: the marks of a
// mill may be strong at a small sigma where a wide stripe is not.
std::array<double, 4> StripeExtractor::others_of_scales() {
  FrameVector<float> course(static_cast<std::size_t>(lines_), -1, &memory_);
  const auto line_of = [&](const RidgePoint& p) {
    return selection_.along_rows ? p.row : p.column;
  };
  const auto across_of = [&](const RidgePoint& p) { return selection_.along_rows ? p.u : p.v; };
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points) course[line_of(points_[i])] = across_of(points_[i]);
  const auto of_course = [&](const RidgePoint& p) {  // also at another scale
    const float at = course[line_of(p)];
    return at >= 0 && std::abs(across_of(p) - at) < kBesideCourse;
  };
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  std::array<double, 4> others{};
  FrameVector<float> strengths(&memory_);
  for (std::size_t k = 0; k < kMixedScales.size(); ++k) {
    strengths.clear();
    for (const Chain& chain : chains_)
      for (const int i : chain)
        if (merged_.sigmas[i] == kMixedScales[k] && !of_course(points_[i]))
          strengths.push_back(static_cast<float>(factor) * points_[i].curvature);
    if (std::ssize(strengths) < lines_ / 2) continue;
    const auto middle = strengths.begin() + std::ssize(strengths) / 2;
    std::nth_element(strengths.begin(), middle, strengths.end());
    others[k] = *middle;
  }
  return others;
}

double StripeExtractor::others_of(const std::array<double, 4>& others, int point) const {
  const auto at = std::find(kMixedScales.begin(), kMixedScales.end(), merged_.sigmas[point]);
  return others[static_cast<std::size_t>(at - kMixedScales.begin())];
}

void StripeExtractor::try_all_scales(const GreyImage& image) {
  const CourseEvidence single = evidence();
  if (single.weight == 0 || (single.centres >= kCovered * lines_ && !widths_differ())) return;
  const double single_sigma = used_sigma_, least = least_strength_;
  const auto single_along_rows = along_rows_;
  for (std::size_t k = 0; k < kMixedScales.size(); ++k)
    for (const double raised : kRaised) {
      least_of_scale_[k] = least_strength_ = raised * settings_.least_strength;
      find_lines(image, kMixedScales[k]);
      if (!in_texture()) break;
    }
  mixed_ = true;
  double best = kBetter * single.weight;
  std::optional<bool> along_rows;
  for (const bool tried : {false, true}) {
    along_rows_ = tried;
    look_at_all_scales(image);
    const CourseEvidence here = evidence();
    if (!widths_differ()) continue;
    if (here.weight <= best ||
        here.centres < std::max(kMoreCentres * single.centres, kLeastCovered * lines_))
      continue;
    best = here.weight;
    along_rows = tried;
  }
  mixed_ = along_rows.has_value();
  along_rows_ = mixed_ ? along_rows : single_along_rows;
  if (mixed_) {
    look_at_all_scales(image);
    sigma_ = used_sigma_;
    return;
  }
  least_strength_ = least;
  look_at(image, single_sigma);
}

// Each chosen centre at the sigma that its own place's width wants. A width measured with kernels
// that see the stripe's sides alone is too small, so that a second round follows.
void StripeExtractor::measure_by_width(const GreyImage& image) {
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  const double per_width =
      std::sqrt(settings_.sigma_per_width * settings_.measuring_sigma_per_width);
  for (int round = 0; round < 2; ++round) {
    map_scales(selection_.branches, widths_, {per_width, kLeastSigma, kLargestSigma},
               wanted_sigmas_, &memory_);
    sigmas_.assign(wanted_sigmas_.begin(), wanted_sigmas_.end());
    std::sort(sigmas_.begin(), sigmas_.end());
    sigmas_.erase(std::unique(sigmas_.begin(), sigmas_.end()), sigmas_.end());
    for (const float sigma : sigmas_) {
      const auto wants = [&](int i) {
        return wanted_sigmas_[i] == sigma && centres_[i].sigma != sigma;
      };
      about_.clear();
      for (const Branch& branch : selection_.branches)
        if (branch.chosen)
          for (const int i : branch.points)
            if (wants(i)) about_.push_back(points_[i]);
      if (sigma == 0 || about_.empty()) continue;
      measuring_kernels_ = gaussian_kernels(sigma);
      const double strength = strength_factor(sigma, settings_.strength_exponent);
      const int reach = std::min(
          kFarthestMoved, static_cast<int>(std::ceil(std::max<double>(sigma, used_sigma_) / 2)));
      detector_.detect_about(image, measuring_kernels_,
                             settings_.weakest_share * settings_.least_strength / strength,
                             border(), about_, reach, measured_);
      const MeasuredAgain measured(measured_, selection_.along_rows);
      for (const Branch& branch : selection_.branches)
        if (branch.chosen)
          for (const int i : branch.points) {
            const RidgePoint* q = wants(i) ? measured.beside(points_[i], reach) : nullptr;
            if (q == nullptr) continue;
            centres_[i] = {q->u, q->v,
                           static_cast<float>(centre_deviation(q->curvature, sigma, noise_)),
                           sigma};
            points_[i] = *q;
            points_[i].curvature *= static_cast<float>(strength / factor);
          }
    }
    for (const Branch& branch : selection_.branches)
      for (std::size_t begin = 0, end; branch.chosen && begin < branch.points.size(); begin = end) {
        const float sigma = centres_[branch.points[begin]].sigma;
        for (end = begin;
             end < branch.points.size() && centres_[branch.points[end]].sigma == sigma;)
          ++end;
        measure_widths(image, points_, {&branch.points[begin], end - begin}, sigma, noise_, widths_,
                       &memory_);
      }
  }
}

}  // namespace arcstart::extraction
