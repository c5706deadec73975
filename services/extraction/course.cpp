#include "services/extraction/course.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcstart {
namespace {

// Half-widths of the windows in sigma, widest first. All but the last are parabolas.
constexpr std::array<double, 4> kReach{15, 8, 4.5, 3};
constexpr std::size_t kUsual = 1;  // whose median misfit is the usual one
constexpr std::size_t kNarrow = 2;
// Of noise alone: the median misfit of the usual windows to the lower quartile of the narrow ones'.
constexpr double kNarrowToUsual = 3.3;
constexpr double kMisfit = 1.7 * 1.7;  // times the usual one is still borne
constexpr std::size_t kFewestPoints = 12;

// A symmetric positive definite matrix taken apart (Cholesky).
template <int kSize>
struct Factors {
  std::array<std::array<double, kSize>, kSize> lower{};
  std::array<double, kSize> inverse{};  // of the diagonal

  bool take_apart(const std::array<std::array<double, kSize>, kSize>& a) {
    for (int i = 0; i < kSize; ++i)
      for (int j = 0; j <= i; ++j) {
        double sum = a[i][j];
        for (int k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
        if (i > j) {
          lower[i][j] = sum * inverse[j];
        } else {
          if (!(sum > 1e-12)) return false;
          lower[i][i] = std::sqrt(sum);
          inverse[i] = 1 / lower[i][i];
        }
      }
    return true;
  }
  void solve(std::array<double, kSize>& b) const {
    for (int i = 0; i < kSize; ++i) {
      for (int k = 0; k < i; ++k) b[i] -= lower[i][k] * b[k];
      b[i] *= inverse[i];
    }
    for (int i = kSize - 1; i >= 0; --i) {
      for (int k = i + 1; k < kSize; ++k) b[i] -= lower[k][i] * b[k];
      b[i] *= inverse[i];
    }
  }
};

// A polynomial in x / reach about the point, and what it says there: its value moved back by the
// bend, and that value's variance for independent points of variance 1.
template <int kSize>
struct Polynomial {
  std::array<std::array<double, kSize>, kSize> normal{};
  std::array<double, kSize> moments{}, coefficients{};
  double value = 0, variance = 0;

  bool fit(double reach, double sigma) {
    Factors<kSize> factors;
    if (!factors.take_apart(normal)) return false;
    coefficients = moments;
    factors.solve(coefficients);
    const double slope = coefficients[1] / reach;
    std::array<double, kSize> weights{};  // of the coefficients in the value
    weights[0] = 1;
    weights[2] = -sigma * sigma / (reach * reach) / (1 + slope * slope);
    value = coefficients[0] + weights[2] * coefficients[2];
    std::array<double, kSize> solved = weights;
    factors.solve(solved);
    variance = 0;
    for (int i = 0; i < kSize; ++i) variance += weights[i] * solved[i];
    return true;
  }
};

}  // namespace

void BranchCourse::add_up(const std::vector<CoursePoint>& points) {
  // About the branch's middle, so that differences of sums keep their digits.
  origin_along_ = 0.5 * (points.front().along + points.back().along);
  origin_across_ = 0.5 * (points.front().across + points.back().across);
  sums_.resize(points.size() + 1);
  sums_[0] = {};
  for (std::size_t i = 0; i < points.size(); ++i) {
    Sums& sums = sums_[i + 1];
    sums = sums_[i];
    if (points[i].at_border) continue;
    const double x = points[i].along - origin_along_, y = points[i].across - origin_across_;
    double power = 1;
    for (std::size_t k = 0; k < sums.x.size(); ++k, power *= x) {
      sums.x[k] += power;
      if (k < sums.xy.size()) sums.xy[k] += power * y;
    }
    sums.yy += y * y;
    sums.variance += points[i].deviation * points[i].deviation;
  }
}

BranchCourse::Fit BranchCourse::fit_parabola(const std::vector<CoursePoint>& points, std::size_t at,
                                             double reach, Window& window) const {
  const double here = points[at].along;
  while (points[window.begin].along < here - reach) ++window.begin;
  while (window.end < points.size() && points[window.end].along < here + reach) ++window.end;
  const Sums &low = sums_[window.begin], &high = sums_[window.end];
  const double count = high.x[0] - low.x[0];
  if (count < 8) return {};
  // Sums of powers of (x - shift) / reach, from those of x.
  const double shift = here - origin_along_;
  std::array<double, 5> x{};
  std::array<double, 3> xy{};
  constexpr int kBinomial[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
  double scale = 1;
  for (int k = 0; k < 5; ++k, scale /= reach) {
    double power = 1;
    for (int j = k; j >= 0; --j, power *= -shift) {
      x[k] += kBinomial[k][j] * power * (high.x[j] - low.x[j]) * scale;
      if (k < 3) xy[k] += kBinomial[k][j] * power * (high.xy[j] - low.xy[j]) * scale;
    }
  }
  Polynomial<3> parabola;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) parabola.normal[i][j] = x[i + j];
    parabola.moments[i] = xy[i];
  }
  if (!parabola.fit(reach, sigma_)) return {};
  double squares = high.yy - low.yy;
  for (int i = 0; i < 3; ++i) squares -= parabola.coefficients[i] * xy[i];
  const double variance = (high.variance - low.variance) / count;
  return {origin_across_ + parabola.value, std::sqrt(parabola.variance),
          std::max(0.0, squares) / (count - 3) / variance, true};
}

BranchCourse::Fit BranchCourse::fit_quartic(const std::vector<CoursePoint>& points, std::size_t at,
                                            double reach) const {
  Polynomial<5> quartic;
  std::array<double, 9> x{};
  std::size_t begin = at, end = at;
  while (begin > 0 && points[at].along - points[begin - 1].along <= reach) --begin;
  while (end < points.size() && points[end].along - points[at].along <= reach) ++end;
  for (std::size_t i = begin; i < end; ++i) {
    if (points[i].at_border) continue;
    const double t = (points[i].along - points[at].along) / reach,
                 y = points[i].across - origin_across_;
    double power = 1;
    for (std::size_t k = 0; k < x.size(); ++k, power *= t) {
      x[k] += power;
      if (k < 5) quartic.moments[k] += power * y;
    }
  }
  if (x[0] < 8) return {};
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) quartic.normal[i][j] = x[i + j];
  if (!quartic.fit(reach, sigma_)) return {};
  return {origin_across_ + quartic.value, std::sqrt(quartic.variance), 0, true};
}

void BranchCourse::smooth(std::vector<CoursePoint>& points, double sigma) {
  smoothed_ = points;
  for (CoursePoint& point : smoothed_)
    if (point.at_border) point.deviation = 0;
  if (points.size() >= kFewestPoints) fit_all(points, sigma);
  std::swap(points, smoothed_);
}

void BranchCourse::fit_all(const std::vector<CoursePoint>& points, double sigma) {
  sigma_ = sigma;
  add_up(points);
  misfits_.clear();
  usual_.clear();
  std::array<Window, kReach.size()> windows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    usual_.push_back(fit_parabola(points, i, kReach[kUsual] * sigma, windows[kUsual]));
    if (usual_.back().valid) misfits_.push_back(usual_.back().misfit);
  }
  if (misfits_.empty()) return;
  const auto middle = misfits_.begin() + static_cast<std::ptrdiff_t>(misfits_.size() / 2);
  std::nth_element(misfits_.begin(), middle, misfits_.end());
  double usual = *middle;
  // Where most of the stripe is rough, the roughness is no measure of the noise: what the smoother
  // places leave of narrower windows is.
  misfits_.clear();
  Window narrow;
  for (std::size_t i = 0; i < points.size(); i += 4)
    if (const Fit fit = fit_parabola(points, i, kReach[kNarrow] * sigma, narrow); fit.valid)
      misfits_.push_back(fit.misfit);
  const auto quartile = misfits_.begin() + static_cast<std::ptrdiff_t>(misfits_.size() / 4);
  std::nth_element(misfits_.begin(), quartile, misfits_.end());
  if (quartile != misfits_.end()) usual = std::min(usual, kNarrowToUsual * *quartile);
  const double most = kMisfit * usual;

  // Errors of neighbours hang together over what the kernels span, exp(-d^2 / 4 sigma^2): so many
  // points count for one.
  const double points_for_one = 2 * std::sqrt(std::numbers::pi) * sigma;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Beyond the last point fitted to, a quartic goes anywhere.
    const std::size_t levels = points[i].at_border ? kReach.size() - 1 : kReach.size();
    Fit fit{};
    for (std::size_t level = 0; level < levels; ++level) {
      const bool last = level + 1 == levels;
      const Fit wide = fit;
      fit = level == kUsual ? usual_[i]
            : level + 1 == kReach.size()
                ? fit_quartic(points, i, kReach[level] * sigma)
                : fit_parabola(points, i, kReach[level] * sigma, windows[level]);
      if (!fit.valid && points[i].at_border) fit = wide;
      if (fit.valid && (last || fit.misfit <= most)) break;
    }
    if (!fit.valid) continue;
    smoothed_[i].across = fit.value;
    smoothed_[i].deviation =
        points[i].deviation *
        std::min(points[i].at_border ? 3.0 : 1.0, fit.deviation * std::sqrt(points_for_one));
  }
}

}  // namespace arcstart
