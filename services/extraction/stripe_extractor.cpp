#include "services/extraction/stripe_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "services/extraction/centres/blunt_ends.hpp"
#include "services/extraction/centres/centre_refinement.hpp"
#include "services/extraction/centres/segment_end_refinement.hpp"
#include "services/extraction/centres/segment_ends.hpp"
#include "services/extraction/centres/stripe_quality.hpp"

namespace arcstart::extraction {
namespace {

// px from the image's border: on the outermost pixels whatever grows brighter towards it looks like
// a line along it.
constexpr int kBorder = 2;
constexpr double kSigmaStep = 1.0 / 32;  // px, of the sigma followed: kernels need not be made anew
constexpr double kFollowing = 0.2;       // share of the difference taken up by each image
// Of centres by speckle, in sigma: of a contrast of 0.3 it is 0.08 to 0.12.
constexpr double kMostScatter = 0.15;
// Ridge points, and those in chains, per column of the image, or row, whichever are more. A stripe
// has one to two; together with texture that is looked for with a strength far below the usual an
// image holds up to 50, and 20 in chains. An image of more points is refused, since nothing can be
// told from it; of more in chains the strongest chains are kept.
constexpr int kMostPoints = 96, kMostChainPoints = 24;
// Standard deviation of a second derivative under white noise is 0.2443 noise / sigma^3 (3 / (16
// pi), rooted); what starts a segment stands out from it by eight times.
constexpr double kNoiseCurvature = 8 * 0.2443;

double median(FrameVector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double StripeExtractor::strong_curvature(double sigma) const {
  return std::max(std::max(settings_.least_strength, least_strength_) /
                      strength_factor(sigma, settings_.strength_exponent),
                  kNoiseCurvature * noise_ / (sigma * sigma * sigma));
}

void StripeExtractor::find_lines(const GreyImage& image, double sigma) {
  chains_.clear();
  selection_.branches.clear();
  memory_.take_back();
  if (kernels_.sigma != sigma) kernels_ = gaussian_kernels(sigma);
  used_sigma_ = sigma;
  const double strong = strong_curvature(sigma);
  crowded_ = !detector_.detect_lines(image, kernels_, settings_.weakest_share * strong, strong,
                                     border(), points_, kMostPoints * lines_);
  linker_.link(points_, {strong, settings_.fewest_centres, kMostChainPoints * lines_}, chains_,
               &memory_);
}

void StripeExtractor::choose_course(const GreyImage& image) {
  widths_.assign(points_.size(), 0);
  for (const Chain& chain : chains_)
    measure_widths(image, points_, chain, sigma_of(chain.front()), noise_, widths_, &memory_);
  StripePathSettings selection;
  selection.longest_hole = settings_.longest_hole_px;
  selection.fewest_points = settings_.fewest_centres;
  selection.width = image.width;
  selection.height = image.height;
  selection.margin = border();
  selection.along_rows = along_rows_;
  selection.junction_reach = 3 * used_sigma_;
  // Where widths differ along the stripe they tell nothing of what belongs to it.
  if (mixed_) no_widths_.assign(points_.size(), 0);
  selector_.select(points_, chains_, mixed_ ? no_widths_ : widths_, selection, selection_,
                   &memory_);
  if (along_rows_) drop_texture();
}

bool StripeExtractor::look_at(const GreyImage& image, double sigma) {
  find_lines(image, sigma);
  choose_course(image);
  return !crowded_ && !linker_.left_out();
}

double StripeExtractor::sigma_of(int point) const {
  return mixed_ ? merged_.sigmas[static_cast<std::size_t>(point)] : used_sigma_;
}

double StripeExtractor::wanted_sigma() {
  FrameVector<float> widths(&memory_);
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points)
        if (widths_[i] > 0) widths.push_back(widths_[i]);
  if (static_cast<int>(widths.size()) < settings_.fewest_centres) return 0;
  return std::clamp(settings_.sigma_per_width * median(widths), kLeastSigma, kLargestSigma);
}

void StripeExtractor::follow_scale() {
  if (const double wanted = wanted_sigma(); wanted > 0) sigma_ += kFollowing * (wanted - sigma_);
}

void StripeExtractor::set_out(const GreyImage& image, const Branch& branch) {
  course_points_.clear();
  for (const int i : branch.points) {
    const RidgePoint& p = points_[i];
    const MeasuredCentre& c = centres_[i];
    const bool at_border = std::min({p.column, p.row, image.width - 1 - p.column,
                                     image.height - 1 - p.row}) < std::ceil(2 * c.sigma);
    // What seems to scatter more than speckle can is the surface's own shape.
    const double seen = std::sqrt(scatter_.base + scatter_.per_law * c.deviation * c.deviation),
                 most = std::max<double>(kMostScatter * c.sigma, c.deviation);
    SmoothedPoint point{c.u, c.v, std::min(seen, most), c.sigma, at_border};
    if (selection_.along_rows) std::swap(point.along, point.across);
    course_points_.push_back(point);
  }
  if (branch.chosen && settings_.smooth_course) course_.smooth(course_points_);
}

void StripeExtractor::describe(const GreyImage& image, Stripe& stripe) {
  stripe.centres.clear();
  stripe.sigma = static_cast<float>(used_sigma_);
  stripe.noise = static_cast<float>(noise_);
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  int chosen = 0, saturated = 0;
  for (std::size_t b = 0; b < selection_.branches.size(); ++b) {
    const Branch& branch = selection_.branches[b];
    const BranchEnds ends = branch_ends(image, points_, selection_, b, used_sigma_, border());
    set_out(image, branch);
    const std::size_t first = stripe.centres.size();
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const RidgePoint& p = points_[branch.points[i]];
      const SmoothedPoint& course = course_points_[i];
      if (course.deviation == 0) continue;
      StripeCentre centre{};
      centre.u = static_cast<float>(selection_.along_rows ? course.across : course.along);
      centre.v = static_cast<float>(selection_.along_rows ? course.along : course.across);
      centre.strength = static_cast<float>(factor * p.curvature);
      centre.width = widths_[branch.points[i]];
      centre.deviation = static_cast<float>(course.deviation);
      centre.segment = static_cast<std::int16_t>(b);
      centre.chosen = branch.chosen;
      centre.end = SegmentEnd::kContinues;
      if (branch.chosen) {
        ++chosen;
        saturated += is_saturated(image, p.u, p.v);
      }
      stripe.centres.push_back(centre);
    }
    if (stripe.centres.size() == first) continue;
    stripe.centres[first].end = ends.first;
    stripe.centres.back().end = ends.last;
  }
  stripe.saturated_share =
      chosen > 0 ? static_cast<float>(saturated) / static_cast<float>(chosen) : 0;
}

// The chosen points' centres, as found or, where that leaves less noise, at the smaller sigma:
// a course's variance is that of its points times the length over which their errors hang together,
// and that goes with sigma. Noise of fine grain wants the larger sigma, of coarse grain the
// smaller.
void StripeExtractor::measure(const GreyImage& image) {
  const std::size_t found = points_.size();
  end_deviations_.clear();
  if (!mixed_) follow_blunt_ends(image, kernels_, border(), selection_, points_, end_deviations_);
  widths_.resize(points_.size(), 0);
  centres_.clear();
  const double factor = strength_factor(used_sigma_, settings_.strength_exponent);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const RidgePoint& p = points_[i];
    const double sigma = sigma_of(static_cast<int>(i));
    const double curvature =
        mixed_ ? p.curvature * factor / strength_factor(sigma, settings_.strength_exponent)
               : p.curvature;
    const double by_noise = centre_deviation(curvature, sigma, noise_);
    const double deviation =
        i < found ? by_noise : std::hypot(by_noise, end_deviations_[i - found]);
    centres_.push_back({p.u, p.v, static_cast<float>(deviation), static_cast<float>(sigma)});
  }
  const bool by_width = settings_.sigma_px == 0 && widths_differ();
  if (by_width) measure_by_width(image);
  double widest = used_sigma_;
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points) widest = std::max<double>(widest, centres_[i].sigma);
  scatter_ = centre_noise(selection_.branches, centres_, widest, &memory_);
  if (mixed_ || by_width || settings_.sigma_px != 0 || !settings_.smooth_course) return;
  const double share = settings_.measuring_sigma_per_width / settings_.sigma_per_width;
  const double sigma =
      std::max(kLeastSigma, std::round(share * used_sigma_ / kSigmaStep) * kSigmaStep);
  if (sigma >= used_sigma_) return;
  measure_at(image, sigma);
  const CentreNoise finer = centre_noise(selection_.branches, finer_, used_sigma_, &memory_);
  if (finer.variance * sigma >= scatter_.variance * used_sigma_) return;
  std::swap(centres_, finer_);
  scatter_ = finer;
}

void StripeExtractor::measure_at(const GreyImage& image, double sigma) {
  finer_ = centres_;
  if (measuring_kernels_.sigma != sigma) measuring_kernels_ = gaussian_kernels(sigma);
  about_.clear();
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points) about_.push_back(points_[i]);
  const int reach = static_cast<int>(std::lround(used_sigma_ / 2));
  detector_.detect_about(image, measuring_kernels_,
                         settings_.weakest_share * strong_curvature(sigma), border(), about_, reach,
                         measured_);
  const MeasuredAgain measured(measured_, selection_.along_rows);
  for (const Branch& branch : selection_.branches)
    if (branch.chosen)
      for (const int i : branch.points)
        if (const RidgePoint* q = measured.beside(points_[i], reach))
          finer_[i] = {q->u, q->v,
                       static_cast<float>(centre_deviation(q->curvature, sigma, noise_)),
                       static_cast<float>(sigma)};
}

int StripeExtractor::border() const {
  return settings_.smooth_course ? kBorder : RidgeDetector::margin(kernels_);
}

// At the scale of the images before; a surface full of lines that has come into view is searched.
void StripeExtractor::follow(const GreyImage& image) {
  find_lines(image, std::round(sigma_ / kSigmaStep) * kSigmaStep);
  if (!along_rows_ && in_texture())
    find_scale_in_texture(image);
  else
    choose_course(image);
}

void StripeExtractor::extract(const GreyImage& image, Stripe& stripe) {
  noise_ = noise_of(image);
  refused_ = false;
  lines_ = std::max(image.width, image.height);
  const bool follows = settings_.sigma_px == 0;
  if (!follows)
    look_at(image, settings_.sigma_px);
  else if (sigma_ == 0)
    find_scale(image);
  else if (mixed_)
    look_at_all_scales(image);
  else
    follow(image);
  measure(image);
  describe(image, stripe);
  if (settings_.smooth_course) refine_segment_ends(image, stripe.centres);
  stripe.why = !stripe.centres.empty() ? EmptyStripe::kNone
               : crowded_ || refused_  ? EmptyStripe::kTooMuchLight
                                       : EmptyStripe::kNoStripe;
  stripe.empty = to_words(stripe.why, crowded_ ? std::to_string(kMostPoints * lines_) : "");
  if (follows && sigma_ > 0 && !mixed_) follow_scale();
}

}  // namespace arcstart::extraction
