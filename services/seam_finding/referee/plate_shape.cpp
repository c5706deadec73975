#include "services/seam_finding/referee/plate_shape.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr int kTerms = 5;  // 1, x, x^2 along, w, w^2 away
using Terms = Eigen::Matrix<double, kTerms, 1>;

// Numbers of order 1, for the equations' sake.
struct Scale {
  double middle, half;  // along; mm
  double begin, width;  // away; mm
  Terms terms(const Place& place) const {
    const double x = std::clamp((place.along - middle) / half, -1.0, 1.0);
    const double w = (place.away - begin) / width - 0.5;
    return {1, x, x * x, w, w * w};
  }
};

// Between the ends and in the strip, near the plane; evenly thinned out to some thousand.
std::vector<Place> places_within(const PlateView& view, double length, const Scale& scale) {
  std::vector<Place> all;
  for (const StripeOnPlate& stripe : view.stripes)
    for (const Place& place : stripe.places)
      if (place.along > 0 && place.along < length && place.away > scale.begin &&
          place.away < scale.begin + scale.width && std::abs(place.height) < 2 * kReferee.bend)
        all.push_back(place);
  const std::size_t step = all.size() / kReferee.shape_places + 1;
  std::vector<Place> some;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

// By stripes between the ends that nothing before the plate cuts short.
void set_width(double length, double tolerance, PlateView& view) {
  std::vector<double> widths, cut;
  for (const StripeOnPlate& stripe : view.stripes) {
    double reached = -1;
    int others = 0;  // in a row
    bool cut_short = false;
    for (const Place& place : stripe.places) {
      if (place.away < view.begin + kReferee.beside_seam) continue;
      if (place.along < 0 || place.along > length) continue;
      others = place.look == Look::kOn ? 0 : others + 1;
      cut_short = place.look == Look::kBefore;
      if (others == kReferee.others_in_a_row && reached >= 0) break;
      if (place.look == Look::kOn) reached = place.away;
    }
    if (reached > 0) (cut_short ? cut : widths).push_back(reached);
  }
  // Where nearly all are cut short, they must do.
  if (3 * widths.size() < cut.size()) widths.insert(widths.end(), cut.begin(), cut.end());
  if (widths.empty()) return;
  const auto quantile = [&](std::size_t quarters) {
    const auto at = widths.begin() + static_cast<std::ptrdiff_t>(quarters * widths.size() / 4);
    std::nth_element(widths.begin(), at, widths.end());
    return std::max(0.0, *at - 2 * tolerance);
  };
  view.width = quantile(1);
  view.widest = quantile(3);
}

// risen: over the shape, of the plate in the stripe before; then in this one.
void set_looks(const PlateShape& shape, double begin, StripeOnPlate& stripe, double& risen) {
  std::vector<double> heights;
  int others = 0;
  for (Place& place : stripe.places) {
    const double height = place.height - shape.height_at(place.along, place.away) - risen;
    place.look = height > shape.tolerance    ? Look::kBefore
                 : height < -shape.tolerance ? Look::kThrough
                                             : Look::kOn;
    if (place.away < begin + kReferee.beside_seam) continue;
    if (place.look == Look::kOn)
      heights.push_back(height);
    else
      ++others;
  }
  if (heights.size() < 3 || static_cast<int>(heights.size()) < others) return;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  risen += *middle;
}

// Between neighbours of a segment that look alike, what lies there looks so, too: the scan was
// thinned out, or its image has few pixels.
void fill_in(StripeOnPlate& stripe) {
  std::vector<Place> places = stripe.places;
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.point < b.point; });
  const std::size_t seen = stripe.places.size();
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Place &a = places[i - 1], &b = places[i];
    if (a.segment != b.segment || a.look != b.look || a.look == Look::kBefore) continue;
    const int steps = static_cast<int>(std::abs(b.away - a.away) / (2 * kReferee.step));
    for (int step = 1; step < steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      Place between = a;
      between.along += share * (b.along - a.along);
      between.away += share * (b.away - a.away);
      between.height += share * (b.height - a.height);
      between.ends = false;
      stripe.places.push_back(between);
    }
  }
  if (stripe.places.size() == seen) return;
  std::sort(stripe.places.begin(), stripe.places.end(),
            [](const Place& a, const Place& b) { return a.away < b.away; });
}

// From places so far away from where the plate begins, in a strip so wide; mm.
PlateShape shape_within(const PlateView& view, double length, double from, double width) {
  PlateShape shape;
  Scale scale{length / 2, length / 2, view.begin + from, width};
  shape.tolerance = kReferee.most_tolerance;
  shape.middle = scale.middle, shape.half = scale.half;
  const std::vector<Place> places = places_within(view, length, scale);
  Terms solution = Terms::Zero();
  double cut = kReferee.bend, squares = 0;
  Eigen::Matrix<double, kTerms, kTerms> inverse;
  int count = 0;
  for (int pass = 0; pass < 4; ++pass) {
    Eigen::Matrix<double, kTerms, kTerms> matrix =
        1e-6 * Eigen::Matrix<double, kTerms, kTerms>::Identity();
    Terms right = Terms::Zero();
    count = 0;
    for (const Place& place : places) {
      const Terms terms = scale.terms(place);
      if (std::abs(place.height - solution.dot(terms)) > cut) continue;
      matrix += terms * terms.transpose();
      right += place.height * terms;
      ++count;
    }
    if (count < 4 * kTerms) return shape;
    inverse = matrix.inverse();
    solution = inverse * right;
    squares = 0;
    double kept = 0, farthest = 0;
    for (const Place& place : places) {
      const double residual = place.height - solution.dot(scale.terms(place));
      if (std::abs(residual) > cut) continue;
      squares += residual * residual, ++kept;
      farthest = std::max(farthest, place.away);
    }
    shape.noise = std::sqrt(squares / std::max(1.0, kept - kTerms));
    shape.width = farthest - scale.begin;
    cut = std::clamp(3 * shape.noise, kReferee.least_tolerance, kReferee.bend);
  }
  shape.known = true;
  shape.tolerance = std::clamp(4 * shape.noise, kReferee.least_tolerance, kReferee.most_tolerance);
  // What a stripe is wrong by, it is wrong by in all its places.
  const double stripes = static_cast<double>(view.stripes.size());
  const double alike = std::max(1.0, count / std::max(1.0, stripes));
  const double variance = shape.noise * shape.noise * alike;
  shape.tilt = solution(3) / scale.width;
  shape.tilt_deviation = std::sqrt(variance * inverse(3, 3)) / scale.width;
  shape.curvature = 2 * solution(4) / (scale.width * scale.width);
  shape.curvature_deviation = 2 * std::sqrt(variance * inverse(4, 4)) / (scale.width * scale.width);
  // Carried to the seam: w there is -begin / width - 1/2.
  const double at_seam = -scale.begin / scale.width - 0.5;
  shape.bend = {solution(0) + solution(3) * at_seam, solution(1) / scale.half,
                solution(2) / (scale.half * scale.half)};
  return shape;
}

struct Count {
  int on = 0, off = 0;
};

Count count_beside(const PlateView& view, const StripeOnPlate& stripe, int& before) {
  const double from = view.begin + kReferee.beside_seam;
  Count count;
  for (const Place& place : stripe.places) {
    if (place.away < from || place.away > from + kReferee.near_seam) continue;
    if (place.look == Look::kOn) ++count.on;
    if (place.look == Look::kThrough) ++count.off;
    if (place.look == Look::kBefore) ++before;
  }
  return count;
}

AtSeam seen_at_seam(const PlateView& view, const StripeOnPlate& stripe) {
  int before = 0;
  const Count count = count_beside(view, stripe, before);
  const int known = count.on + count.off;
  if (known == 0) return before > 0 ? AtSeam::kHidden : AtSeam::kUnknown;
  if (count.on >= kReferee.clear * known) return AtSeam::kOn;
  if (count.off >= kReferee.clear * known) return AtSeam::kOff;
  return AtSeam::kPart;
}

// A single place at the plate's height beside what stands on the plate is on that thing's flank.
void leave_out_flanks(StripeOnPlate& stripe) {
  std::vector<Place>& places = stripe.places;
  const auto on = [&](std::size_t i) { return places[i].look == Look::kOn; };
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    if (!on(i) || on(i - 1) || on(i + 1)) continue;
    if (places[i - 1].look == Look::kBefore || places[i + 1].look == Look::kBefore)
      places[i].look = Look::kBefore;
  }
}

}  // namespace

double PlateShape::height_at_seam(double along) const {
  const double x = along - middle, inside = std::clamp(x, -half, half);
  return bend(0) + bend(1) * inside + bend(2) * inside * inside +
         (bend(1) + 2 * bend(2) * inside) * (x - inside);
}

double PlateShape::height_at(double along, double away) const {
  return height_at_seam(along) + tilt * away;
}

PlateShape shape_of(const PlateView& view, double length) {
  const PlateShape wide = shape_within(view, length, kReferee.shape_from, kReferee.shape_width);
  const bool good = wide.known && wide.tilt_deviation < kReferee.turned &&
                    std::abs(wide.height_at_seam(wide.middle)) < kReferee.bend;
  return good ? wide : shape_within(view, length, kReferee.beside_seam, kReferee.narrow);
}

void set_looks(const PlateShape& shape, double length, PlateView& view) {
  // From the seam's middle outward a bent plate is followed stripe by stripe: what shows it says
  // where the next must show it.
  std::vector<StripeOnPlate>& stripes = view.stripes;
  const auto middle = std::partition_point(
      stripes.begin(), stripes.end(),
      [&](const StripeOnPlate& stripe) { return stripe.crossing < length / 2; });
  double risen = 0;
  for (auto stripe = middle; stripe != stripes.end(); ++stripe)
    set_looks(shape, view.begin, *stripe, risen);
  risen = 0;
  for (auto stripe = middle; stripe != stripes.begin();)
    set_looks(shape, view.begin, *--stripe, risen);
  for (StripeOnPlate& stripe : stripes) {
    fill_in(stripe);
    leave_out_flanks(stripe);
    stripe.at_seam = seen_at_seam(view, stripe);
  }
  set_width(length, shape.tolerance, view);
}

}  // namespace arcstart::seam_finding
