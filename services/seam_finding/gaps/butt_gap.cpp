#include "services/seam_finding/gaps/butt_gap.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/order_statistics.hpp"
#include "services/seam_finding/gaps/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// Place of the farther plate's edge at the middle, slope, width, rounding.
using Parameters = Eigen::Vector4d;

// Of a sawtooth that is 0 at 0, falls by `steepness` for each mm before it, and ends at -width,
// smoothed by a normal distribution.
double rounded_sawtooth(double x, double width, double rounding, double steepness) {
  const auto below = [](double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; };
  const auto density = [](double z) { return std::exp(-z * z / 2) / std::sqrt(2 * M_PI); };
  const double from = (x + width) / rounding, to = x / rounding;
  return steepness * (x * (below(from) - below(to)) + rounding * (density(from) - density(to)));
}

class Fit {
 public:
  Fit(const std::vector<SeenPlace>& places, const ButtGapSearch& search)
      : search_(search), steepness_(1 / std::abs(search.sight)) {
    const std::size_t step = 1 + places.size() / kGaps.most_places;
    for (std::size_t i = 0; i < places.size(); i += step) places_.push_back(places[i]);
    std::vector<double> depths;
    for (const SeenPlace& place : places_)
      if (is_below(place)) depths.push_back(-place.height), seen_ += x_of(place, {0, 0, 0, 0});
    if (std::ssize(depths) < kModel.sure_points) return;
    seen_ /= static_cast<double>(depths.size());
    scale_ = kGaps.outlier_share * quantile(depths, 0.9);
  }

  // Whether there is anything to fit; and where it was seen, on the average.
  bool shows_a_gap() const { return scale_ > 0; }
  double seen() const { return seen_; }

  // The farther plate's edge is at 0, the gap at negative x.
  double x_of(const SeenPlace& place, const Parameters& p) const {
    const double across =
        place.across - search_.across - (search_.slope + p[1]) * (place.along - search_.middle);
    return (search_.sight > 0 ? across : -across) - p[0];
  }
  double height(const SeenPlace& place, const Parameters& p) const {
    return rounded_sawtooth(x_of(place, p), p[2], p[3], steepness_);
  }
  double weight(const SeenPlace& place, const Parameters& p) const {
    const double z = (place.height - height(place, p)) / scale_;
    return std::abs(z) < 1 ? (1 - z * z) * (1 - z * z) : 0;
  }
  // Tukey's, each place at most 1.
  double cost(const Parameters& p) const {
    double sum = 0;
    for (const SeenPlace& place : places_) {
      const double z = std::min(1.0, std::abs(place.height - height(place, p)) / scale_);
      sum += 1 - std::pow(1 - z * z, 3);
    }
    return sum;
  }

  // Levenberg and Marquardt's, with the weights anew in each pass.
  Parameters refined(Parameters p) const {
    double damping = 1e-2, least = cost(p);
    for (int pass = 0; pass < kGaps.passes; ++pass) {
      const auto [normal, right] = normal_equations(p);
      Eigen::Matrix4d damped = normal;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += 1e-9;
      const Parameters next = held(p + damped.ldlt().solve(right));
      const double now = cost(next);
      if (now < least)
        p = next, least = now, damping /= 4;
      else
        damping *= 8;
    }
    return p;
  }

  Eigen::Matrix4d covariance(const Parameters& p) const {
    double squares = 0, count = 0;
    for (const SeenPlace& place : places_) {
      const double w = weight(place, p), off = place.height - height(place, p);
      squares += w * off * off, count += w;
    }
    const double variance =
        std::max(squares / std::max(1.0, count - 4), search_.noise * search_.noise / 4);
    Eigen::Matrix4d normal = normal_equations(p).first;
    normal.diagonal().array() += 1e-9;
    return variance * normal.inverse();
  }

 private:
  bool is_below(const SeenPlace& place) const {
    return place.height < -kFit.on_plane * search_.noise;
  }
  static Parameters held(const Parameters& p) {
    return {p[0], std::clamp(p[1], -kGaps.most_slope, kGaps.most_slope),
            std::max(p[2], kGaps.least_width),
            std::clamp(p[3], kGaps.least_rounding, kGaps.most_rounding)};
  }

  std::pair<Eigen::Matrix4d, Parameters> normal_equations(const Parameters& p) const {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Parameters right = Parameters::Zero();
    for (const SeenPlace& place : places_) {
      const double w = weight(place, p);
      if (w == 0) continue;
      const double x = x_of(place, p);
      const auto at = [&](double dx, double dw, double dr) {
        return rounded_sawtooth(x + dx, p[2] + dw, p[3] + dr, steepness_);
      };
      const double here = at(0, 0, 0),
                   by_x = (at(kGaps.difference, 0, 0) - here) / kGaps.difference;
      const double lever = (search_.sight > 0 ? -1 : 1) * (place.along - search_.middle);
      const Parameters row(-by_x, by_x * lever,
                           (at(0, kGaps.difference, 0) - here) / kGaps.difference,
                           (at(0, 0, kGaps.difference) - here) / kGaps.difference);
      normal += w * row * row.transpose();
      right += w * (place.height - here) * row;
    }
    return {normal, right};
  }

  ButtGapSearch search_;
  double steepness_;
  std::vector<SeenPlace> places_;
  double scale_ = 0, seen_ = 0;  // mm
};

}  // namespace

std::optional<std::array<LineFit, 2>> fit_butt_gap(const std::vector<SeenPlace>& places,
                                                   const ButtGapSearch& search) {
  const Fit fit(places, search);
  if (!fit.shows_a_gap()) return std::nullopt;
  Parameters best = Parameters::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const double slope : kGaps.slopes)
    for (const double width : kGaps.widths) {
      const Parameters p = fit.refined({fit.seen() + width * 2 / 3, slope, width, kGaps.rounding});
      if (const double cost = fit.cost(p); cost < least) least = cost, best = p;
    }
  const double without = fit.cost({fit.seen() + 1e6, 0, kGaps.least_width, kGaps.least_rounding});
  if (least > kGaps.most_left * without || best[2] > search.widest) return std::nullopt;

  const Eigen::Matrix4d covariance = fit.covariance(best);
  // In terms of the farther edge and the width; the nearer edge is their difference.
  const bool farther_last = search.sight > 0;
  std::array<LineFit, 2> borders;
  for (const bool farther : {false, true}) {
    const Eigen::Vector4d row(1, 0, farther ? 0 : -1, 0);
    LineFit& border = borders[farther == farther_last];
    const double x = best[0] - (farther ? 0 : best[2]);
    border.middle = search.middle;
    border.at_middle = search.across + (farther_last ? x : -x);
    border.slope = search.slope + best[1];
    border.variance = row.dot(covariance * row);
    border.slope_variance = covariance(1, 1);
    border.places = static_cast<int>(places.size());
  }
  return borders;
}

}  // namespace arcstart::seam_finding
