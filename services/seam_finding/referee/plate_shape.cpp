#include "services/seam_finding/referee/plate_shape.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr int kTerms = 5;            // 1, x, x^2 along, w, w^2 away
constexpr int kFewest = 4 * kTerms;  // places
constexpr double kRidge =
    1e-6;  // beside sums of order 1 to 1000: nothing, unless they tell nothing
using Terms = Eigen::Matrix<double, kTerms, 1>;
using Square = Eigen::Matrix<double, kTerms, kTerms>;

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

// A place as the fit needs it.
struct ShapePlace {
  Terms terms;
  double height, away;  // mm
  double residual;      // over the shape as it was fitted last; mm
};

// Between the ends and in the strip, near the plane; evenly thinned out to some thousand. A place's
// first residual is its height over half of those of its stripe: what lies beside the plate, as the
// cut or the round edge at its far side, draws no fit then, however the plate is bent.
std::vector<ShapePlace> places_within(const PlateView& view, double length, const Scale& scale) {
  std::vector<ShapePlace> all;
  std::vector<double> heights;
  for (const StripeOnPlate& stripe : view.stripes) {
    const std::size_t before = all.size();
    heights.clear();
    for (const Place& place : stripe.places)
      if (place.along > 0 && place.along < length && place.away > scale.begin &&
          place.away < scale.begin + scale.width && std::abs(place.height) < 2 * kReferee.bend) {
        all.push_back({scale.terms(place), place.height, place.away, 0});
        heights.push_back(place.height);
      }
    if (heights.empty()) continue;
    const double level = median(heights);
    for (std::size_t i = before; i < all.size(); ++i) all[i].residual = all[i].height - level;
  }
  const std::size_t step = 1 + all.size() / kReferee.sample;
  if (step == 1) return all;
  std::vector<ShapePlace> some;
  some.reserve(all.size() / step + 1);
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

// Normal equations of the places no farther off than `cut`.
struct Sums {
  Square matrix = kRidge * Square::Identity();
  Terms right = Terms::Zero();
  int count = 0;

  Sums(const std::vector<ShapePlace>& places, double cut) {
    for (const ShapePlace& place : places) {
      if (std::abs(place.residual) > cut) continue;
      for (int column = 0; column < kTerms; ++column)
        for (int row = column; row < kTerms; ++row)
          matrix(row, column) += place.terms(row) * place.terms(column);
      right += place.height * place.terms;
      ++count;
    }
    matrix.triangularView<Eigen::StrictlyUpper>() = matrix.transpose();
  }
};

// From places so far away from where the plate begins, in a strip so wide; mm.
PlateShape shape_within(const PlateView& view, double length, double from, double width) {
  PlateShape shape;
  Scale scale{length / 2, length / 2, view.begin + from, width};
  shape.tolerance = kReferee.bend;
  shape.middle = scale.middle, shape.half = scale.half;
  std::vector<ShapePlace> places = places_within(view, length, scale);
  Terms solution = Terms::Zero();
  double cut = kReferee.least_tolerance;
  Square inverse;
  int count = 0;
  for (int pass = 0; pass < 4; ++pass) {
    const Sums sums(places, cut);
    count = sums.count;
    if (count < kFewest) return shape;
    inverse = sums.matrix.inverse();
    solution = inverse * sums.right;
    double squares = 0, farthest = 0;
    std::vector<double> off;
    for (ShapePlace& place : places) {
      place.residual = place.height - solution.dot(place.terms);
      if (std::abs(place.residual) > cut) continue;
      squares += place.residual * place.residual;
      off.push_back(std::abs(place.residual));
      farthest = std::max(farthest, place.away);
    }
    const double kept = static_cast<double>(off.size());
    shape.noise = std::sqrt(squares / std::max(1.0, kept - kTerms));
    shape.width = farthest - scale.begin;
    // By half of the places: the cut along a plate's far edge is no noise of its face.
    cut = std::clamp(kFit.outlier * kFit.median_to_deviation * median(off),
                     kReferee.least_tolerance, kReferee.bend);
  }
  shape.known = true;
  shape.tolerance =
      std::clamp(kFit.on_plane * shape.noise, kReferee.least_tolerance, kReferee.bend);
  // What a stripe is wrong by, it is wrong by in all its places.
  const double stripes = static_cast<double>(view.stripes.size());
  const double alike = std::max(1.0, count / std::max(1.0, stripes));
  const double variance = shape.noise * shape.noise * alike;
  // In the middle of what was seen of the strip: farther out it may be round.
  const double middle = shape.width / 2, w = middle / scale.width - 0.5;
  shape.tilt = (solution(3) + 2 * solution(4) * w) / scale.width;
  shape.tilt_deviation =
      std::sqrt(variance * (inverse(3, 3) + 4 * w * (inverse(3, 4) + w * inverse(4, 4)))) /
      scale.width;
  shape.curvature = 2 * solution(4) / (scale.width * scale.width);
  shape.curvature_deviation = 2 * std::sqrt(variance * inverse(4, 4)) / (scale.width * scale.width);
  // Carried to the seam.
  const double height = solution(0) + solution(3) * w + solution(4) * w * w;
  shape.bend = {height - shape.tilt * (scale.begin + middle), solution(1) / scale.half,
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
  const PlateShape wide = shape_within(view, length, kReferee.near_seam, kModel.beside_seam);
  const bool good = wide.known && wide.tilt_deviation < kReferee.turned &&
                    std::abs(wide.height_at_seam(wide.middle)) < kReferee.bend;
  return good ? wide : shape_within(view, length, kReferee.beside_seam, kReferee.narrow);
}

}  // namespace arcstart::seam_finding
