#include "services/seam_finding/fit/line_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/fit/constants.hpp"

namespace arcstart::seam_finding {

std::optional<LineFit> fit_line(const std::vector<LinePlace>& places, double lean_deviation) {
  if (static_cast<int>(places.size()) < kFit.line_places) return std::nullopt;
  LineFit fit;
  for (const LinePlace& place : places)
    fit.middle += place.along / static_cast<double>(places.size());
  std::vector<double> weights(places.size(), 1);
  double scale = 1;  // of the residuals over their deviations, standard
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  for (int pass = 0; pass < kFit.line_passes; ++pass) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector3d row(1, places[i].along - fit.middle, places[i].height);
      const double weight = weights[i] / (places[i].deviation * places[i].deviation);
      normal += weight * row * row.transpose();
      right += weight * places[i].across * row;
    }
    normal(2, 2) += 1 / (lean_deviation * lean_deviation);
    if (!(std::abs(normal.determinant()) > 1e-12)) return std::nullopt;
    inverse = normal.inverse();
    const Eigen::Vector3d solution = inverse * right;
    fit.at_middle = solution[0], fit.slope = solution[1], fit.lean = solution[2];

    std::vector<double> residuals;
    for (const LinePlace& place : places)
      residuals.push_back((place.across - fit.across_at(place.along) - fit.lean * place.height) /
                          place.deviation);
    std::vector<double> sizes = residuals;
    for (double& size : sizes) size = std::abs(size);
    scale = std::max(1.0, kFit.median_to_deviation * median(sizes));
    fit.places = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double off = residuals[i] / (kFit.tukey_limit * scale);
      weights[i] = std::abs(off) < 1 ? (1 - off * off) * (1 - off * off) : 0;
      fit.places += weights[i] > 0.1;
    }
    if (fit.places < kFit.line_places) return std::nullopt;
  }
  fit.variance = scale * scale * inverse(0, 0);
  fit.slope_variance = scale * scale * inverse(1, 1);
  return fit;
}

}  // namespace arcstart::seam_finding
