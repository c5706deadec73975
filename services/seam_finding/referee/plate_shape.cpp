#include "services/seam_finding/referee/plate_shape.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr int kTerms = 5;            // 1, x, x^2 along, w, w^2 away
constexpr int kFewest = 4 * kTerms;  // places
constexpr double kRidge =
    1e-6;  // beside sums of order 1 to 1000: nothing, unless they tell nothing
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
        kRidge * Eigen::Matrix<double, kTerms, kTerms>::Identity();
    Terms right = Terms::Zero();
    count = 0;
    for (const Place& place : places) {
      const Terms terms = scale.terms(place);
      if (std::abs(place.height - solution.dot(terms)) > cut) continue;
      matrix += terms * terms.transpose();
      right += place.height * terms;
      ++count;
    }
    if (count < kFewest) return shape;
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
    cut = std::clamp(kReferee.cut * shape.noise, kReferee.least_tolerance, kReferee.bend);
  }
  shape.known = true;
  shape.tolerance = std::clamp(kReferee.tolerance * shape.noise, kReferee.least_tolerance,
                               kReferee.most_tolerance);
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

}  // namespace arcstart::seam_finding
