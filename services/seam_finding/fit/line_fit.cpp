#include "services/seam_finding/fit/line_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/fit/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// at_middle, slope, lean
using Parameters = Eigen::Vector3d;

class RobustLine {
 public:
  RobustLine(const std::vector<LinePlace>& places, double lean_deviation)
      : places_(places), lean_deviation_(lean_deviation), weights_(places.size(), 1) {
    for (const LinePlace& place : places)
      middle_ += place.along / static_cast<double>(places.size());
  }

  // Nothing where fewer than four places agree.
  std::optional<LineFit> fit() {
    if (std::ssize(places_) < kFit.line_places || !solve()) return std::nullopt;
    const Parameters least_squares = solution_;
    weigh(start());
    if (agreeing_ < kFit.line_majority * static_cast<double>(places_.size())) weigh(least_squares);
    for (int pass = 0; pass < kFit.line_passes; ++pass) {
      if (agreeing_ < kFit.line_places || !solve()) return std::nullopt;
      weigh(solution_);
    }
    if (agreeing_ < kFit.line_places) return std::nullopt;
    LineFit fit{middle_, solution_[0], solution_[1], solution_[2]};
    fit.variance = scale_ * scale_ * inverse_(0, 0);
    fit.slope_variance = scale_ * scale_ * inverse_(1, 1);
    fit.places = agreeing_;
    return fit;
  }

 private:
  // What lies off together, as a tack's flank, draws least squares so far aside that nothing is
  // off. Where half of the places lie far closer to another line, that is the one to begin with.
  Parameters start() const {
    const double drawn_aside = median_off(solution_);
    double least = drawn_aside;
    Parameters best = solution_;
    const std::size_t count = places_.size(), step = 1 + count / kFit.line_starts;
    for (std::size_t a = 0; a < count; a += step)
      for (const std::size_t apart : {count / 2, count / 3}) {
        const auto line = through(places_[a], places_[(a + apart) % count]);
        const double off = line ? median_off(*line) : least;
        if (off < least) least = off, best = *line;
      }
    return kFit.outlier * least < drawn_aside ? best : solution_;
  }

  Parameters row(const LinePlace& place) const { return {1, place.along - middle_, place.height}; }
  double off(const LinePlace& place, const Parameters& line) const {
    return (place.across - row(place).dot(line)) / place.deviation;
  }
  double median_off(const Parameters& line) const {
    std::vector<double> sizes;
    sizes.reserve(places_.size());
    for (const LinePlace& place : places_) sizes.push_back(std::abs(off(place, line)));
    return median(sizes);
  }
  std::optional<Parameters> through(const LinePlace& a, const LinePlace& b) const {
    if (!(std::abs(b.along - a.along) > 1e-6)) return std::nullopt;
    const double slope = (b.across - a.across) / (b.along - a.along);
    return Parameters(a.across + slope * (middle_ - a.along), slope, 0);
  }

  // Weighted least squares.
  bool solve() {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Parameters right = Parameters::Zero();
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double weight = weights_[i] / (places_[i].deviation * places_[i].deviation);
      normal += weight * row(places_[i]) * row(places_[i]).transpose();
      right += weight * places_[i].across * row(places_[i]);
    }
    normal(2, 2) += 1 / (lean_deviation_ * lean_deviation_);
    if (!(std::abs(normal.determinant()) > 1e-12)) return false;
    inverse_ = normal.inverse();
    solution_ = inverse_ * right;
    return true;
  }

  // Each place by how far it is off.
  void weigh(const Parameters& line) {
    scale_ = std::max(1.0, kFit.median_to_deviation * median_off(line));
    agreeing_ = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double z = off(places_[i], line) / (kFit.tukey_limit * scale_);
      weights_[i] = std::abs(z) < 1 ? (1 - z * z) * (1 - z * z) : 0;
      agreeing_ += weights_[i] > 0.1;
    }
  }

  const std::vector<LinePlace>& places_;
  double lean_deviation_, middle_ = 0;
  std::vector<double> weights_;
  double scale_ = 1;  // of what is off over its deviation, standard
  int agreeing_ = 0;
  Eigen::Matrix3d inverse_ = Eigen::Matrix3d::Zero();
  Parameters solution_ = Parameters::Zero();
};

}  // namespace

std::optional<LineFit> fit_line(const std::vector<LinePlace>& places, double lean_deviation) {
  return RobustLine(places, lean_deviation).fit();
}

}  // namespace arcstart::seam_finding
