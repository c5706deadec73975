// At which scale to look for the stripe.
#include <algorithm>
#include <cmath>

#include "services/extraction/centres/stripe_quality.hpp"
#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::extraction {
namespace {

constexpr double kFirstLook = 2.5, kSecondLook = 6;  // px, where no scale is known
constexpr double kLargestOfFirst = 4.5;  // px; a sigma wanted above it the first look cannot judge
constexpr double kWidestWhite = 4;       // px; nor a stripe with a white top wider than this
constexpr double kNearEnough = 0.1;      // share of sigma that makes no difference
// Points in chains a line of the image at the first look, above which they are mostly the surface's
// own. A stripe, its reflection and a scene's spatter have 1 to 3 (bench rows typical, glare,
// saturated; real images 2), ground, milled and blasted steel 5 to 70 (rows texture, neighbour).
constexpr int kInTexture = 4;
// px; looked at there. A stripe between two of them has nine tenths of its strength at one.
constexpr double kScales[] = {2.5, 4, 6, 9};
// Of the strength of the course's fainter quarter: what starts a segment from then on.
constexpr double kOfFaint = 0.4;

// Times the evidence of the best course through what is left without it; and its own, a line of the
// image. Rows texture, neighbour and mixed_width: stripes have 4.6 times and more, and 7 a line;
// ground, milled and brushed steel alone at most 2.3 times, or 1.3 a line.
constexpr double kOutdoes = 3, kLeastWeight = 2;
constexpr int kSearchEvery = 8;  // images of a scan, where none was found

bool fits(double wanted, double sigma) { return std::abs(wanted - sigma) < kNearEnough * sigma; }

}  // namespace

double StripeExtractor::chosen_strength() const {
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  double sum = 0;
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points) sum += factor * points_[i].curvature;
  return sum;
}

CourseEvidence StripeExtractor::evidence() {
  return course_evidence(points_, chains_, selection_,
                         strength_factor(used_sigma_, settings_.strength_exponent), lines_,
                         &memory_);
}

bool StripeExtractor::in_texture() const {
  std::size_t chained = 0;
  for (const Chain& chain : chains_) chained += chain.size();
  return crowded_ || linker_.left_out() || chained > static_cast<std::size_t>(kInTexture * lines_);
}

// A piece of the course that is no stronger than the lines beside it is one of them.
void StripeExtractor::drop_texture() {
  const double others = evidence().others;
  const auto others_by_scale = mixed_ ? others_of_scales() : std::array<double, 4>{};
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  for (Branch& branch : selection_.branches) {
    if (!branch.chosen) continue;
    double beyond = 0;
    for (const int i : branch.points)
      beyond += factor * points_[i].curvature -
                kStandsOut * (mixed_ ? others_of(others_by_scale, i) : others);
    branch.chosen = beyond >= 0;
  }
  auto chosen_end = selection_.branches.begin();  // by rotating: it takes no memory
  for (auto at = chosen_end; at != selection_.branches.end(); ++at)
    if (at->chosen) std::rotate(chosen_end++, at, at + 1);
}

// Whether the course is the only one: a stripe is, a scratch is one of many. What was chosen is
// lost.
bool StripeExtractor::outdoes_the_rest(const GreyImage& image) {
  const double weight = evidence().weight;
  const bool along_rows = selection_.along_rows;
  FrameVector<float> course(static_cast<std::size_t>(lines_), -1, &memory_);
  const auto line_of = [&](const RidgePoint& p) {
    return static_cast<std::size_t>(along_rows ? p.row : p.column);
  };
  const auto across_of = [&](const RidgePoint& p) { return along_rows ? p.u : p.v; };
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points) course[line_of(points_[i])] = across_of(points_[i]);
  for (Chain& chain : chains_)
    std::erase_if(chain, [&](int i) {
      const float at = course[line_of(points_[i])];
      return at >= 0 && std::abs(across_of(points_[i]) - at) < kBesideCourse;
    });
  std::erase_if(chains_, [&](const Chain& chain) {
    return static_cast<int>(chain.size()) < settings_.fewest_centres;
  });
  choose_course(image);
  return weight >= kLeastWeight * lines_ && weight >= kOutdoes * evidence().weight;
}

void StripeExtractor::refuse() {
  chains_.clear();
  selection_.branches.clear();
  refused_ = true;
  ++since_refused_;
  mixed_ = false;
  sigma_ = 0;
}

// From a look whose course is the stripe towards the sigma that its width wants. False where an
// image is full of lines there.
bool StripeExtractor::correct_scale(const GreyImage& image, int corrected) {
  for (; corrected < 3; ++corrected) {
    const double wanted = wanted_sigma();
    if (wanted == 0) return true;
    if (fits(wanted, used_sigma_)) break;
    if (!look_at(image, wanted)) return false;
  }
  if (wanted_sigma() > 0) sigma_ = used_sigma_;
  return true;
}

// A look at a small sigma tells the stripe's width, unless that is a wide one, of which it sees the
// sides, or whose white top has nothing to see for it. In doubt a look at a large sigma follows; of
// both the stronger is right, for strength is largest where sigma is the stripe's own width
// (ridge.hpp).
void StripeExtractor::find_scale(const GreyImage& image) {
  least_strength_ = 0;
  mixed_ = false;
  along_rows_.reset();
  find_lines(image, kFirstLook);
  if (in_texture()) return find_scale_in_texture(image);
  choose_course(image);
  int corrected = 0;
  const double first = wanted_sigma();
  if (first == 0 || first > kLargestOfFirst || white_width(image) > kWidestWhite) {
    const double strength = chosen_strength();
    if (!look_at(image, kSecondLook)) return;
    if (strength > chosen_strength()) {
      corrected = fits(first, kFirstLook) ? 0 : 1;
      if (!look_at(image, corrected > 0 ? first : kFirstLook)) return;
    }
  }
  correct_scale(image, corrected);
  try_all_scales(image);
}

// Lines of the texture hide the stripe at small scales and look like one themselves. So all scales
// are looked at, at each with the least strength that leaves few lines, and the course that most
// speaks for is the stripe's, if it stands out from what else is seen there; else the image has too
// many lines to tell.
void StripeExtractor::find_scale_in_texture(const GreyImage& image) {
  if (since_refused_ > 0 && since_refused_ % kSearchEvery != 0) return refuse();
  const bool crowded = crowded_;
  CourseEvidence best;
  double best_sigma = 0, best_least = 0;
  bool best_along_rows = false;
  for (const double sigma : kScales)
    for (const double raised : kRaised) {
      least_strength_ = raised * settings_.least_strength;
      find_lines(image, sigma);
      if (in_texture()) continue;
      for (const bool along_rows : {false, true}) {
        along_rows_ = along_rows;
        choose_course(image);
        const CourseEvidence here = evidence();
        if (here.usual < kStandsOut * here.others || here.weight <= best.weight) continue;
        best = here;
        best_sigma = sigma;
        best_least = least_strength_;
        best_along_rows = along_rows;
      }
      break;
    }
  least_strength_ = std::max(best_least, kOfFaint * best.faint);
  along_rows_ = best_along_rows;
  crowded_ = crowded && best_sigma == 0;
  if (best_sigma == 0) return refuse();
  look_at(image, best_sigma);
  correct_scale(image, 0);
  if (evidence().weight < best.weight / 2) {
    look_at(image, best_sigma);
    sigma_ = best_sigma;
  }
  try_all_scales(image);
  if (!outdoes_the_rest(image)) return refuse();
  since_refused_ = 0;
  if (mixed_)
    look_at_all_scales(image);
  else
    look_at(image, used_sigma_);
}

}  // namespace arcstart::extraction
