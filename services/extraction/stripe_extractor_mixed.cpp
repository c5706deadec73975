// A stripe that is narrow here and wide there: looked for at several scales at once.
#include <algorithm>
#include <cmath>

#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::extraction {
namespace {

// px: for stripes of a width from 1 to 8. Of a step of 1.9 in sigma a stripe between two of them
// loses a tenth of its strength.
constexpr std::array kMixedScales{1.4, 2.6, 5.0, 9.5};
// Of the widths along a course, the twentieth from above by the twentieth from below, from which on
// no single sigma does for both.
constexpr double kUnlikeWidths = 2.5;
// Of the image's columns or rows: a course that covers less may be seen at another scale elsewhere.
constexpr double kCovered = 0.9;
// Times the evidence of the single scale's course, and its centres: several scales are for what one
// leaves out. Where it leaves out nothing its centres are the better ones, all of one width. Row
// mixed_width has 1.36 to 1.8 where it is needed, a plate with a clipped stripe 1.19.
constexpr double kBetter = 1.3, kMoreCentres = 1.08;

struct CourseWidths {
  std::size_t centres = 0;
  bool unlike = false;
};
CourseWidths widths_of(const StripePath& course, const std::vector<float>& widths, Memory memory) {
  CourseWidths found;
  FrameVector<float> known(memory);
  for (const Branch& branch : course.branches)
    if (branch.chosen)
      for (const int i : branch.points) {
        ++found.centres;
        if (widths[i] > 0) known.push_back(widths[i]);
      }
  std::sort(known.begin(), known.end());
  found.unlike =
      !known.empty() && known[known.size() * 19 / 20] > kUnlikeWidths * known[known.size() / 20];
  return found;
}

}  // namespace

bool StripeExtractor::may_be_mixed() {
  const CourseWidths found = widths_of(selection_, widths_, &memory_);
  return found.unlike || static_cast<double>(found.centres) < kCovered * lines_;
}

void StripeExtractor::look_at_all_scales(const GreyImage& image) {
  merged_.clear();
  used_sigma_ = kMixedScales[1];
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  for (std::size_t k = 0; k < kMixedScales.size(); ++k) {
    least_strength_ = least_of_scale_[k];
    find_lines(image, kMixedScales[k]);
    if (in_texture()) continue;
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

void StripeExtractor::try_all_scales(const GreyImage& image) {
  const CourseEvidence single = evidence();
  if (single.weight == 0 || !may_be_mixed()) return;
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
    if (!widths_of(selection_, widths_, &memory_).unlike) continue;
    if (here.weight <= best || here.centres < kMoreCentres * single.centres ||
        here.usual < kStandsOut * here.others)
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

}  // namespace arcstart::extraction
