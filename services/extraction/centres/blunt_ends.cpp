#include "services/extraction/centres/blunt_ends.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::extraction {
namespace {

constexpr double kSearchReach = 1.5;  // of sigma: points looked for anew, and as many beyond them
// Points at the end that its direction is not taken from, and those before them that it is; of
// sigma.
constexpr double kUnlikeEnd = 0.5, kDirectionFrom = 3;
constexpr int kFewestOfDirection = 15;
constexpr double kLeastShare = 0.5;   // of the bend there
constexpr double kFarthestOff = 0.5;  // of sigma, from the line on
// Bend along the stripe, of that across it: at a sharp end it is 0.46 at most, for a Gaussian
// stripe and a sigma of 1.3 times its width. Where a stripe just fades it is small.
constexpr double kSharpEnd = 0.4;
constexpr double kDirectionDeviation = 0.05;  // radians, of a line through some ten points

struct Derivatives {
  double u, v, uu, uv, vv;
};

Derivatives derivatives_at(const GreyImage& image, const GaussianKernels& kernels, int column,
                           int row) {
  Derivatives sum{};
  for (int j = -kernels.half_width; j <= kernels.half_width; ++j) {
    const std::uint8_t* greys = image.row(reflect_101(row + j, image.height));
    double smooth = kernels.smooth[0] * greys[column], first = 0,
           second = kernels.second[0] * greys[column];
    for (int k = 1; k <= kernels.half_width; ++k) {
      const double right = greys[reflect_101(column + k, image.width)],
                   left = greys[reflect_101(column - k, image.width)];
      smooth += kernels.smooth[k] * (right + left);
      first += kernels.first[k] * (right - left);
      second += kernels.second[k] * (right + left);
    }
    const int k = std::abs(j);
    const double odd = j < 0 ? -kernels.first[k] : j > 0 ? kernels.first[k] : 0;
    sum.u += kernels.smooth[k] * first;
    sum.v += odd * smooth;
    sum.uu += kernels.smooth[k] * second;
    sum.uv += odd * first;
    sum.vv += kernels.second[k] * smooth;
  }
  return sum;
}

// One end of a branch.
class BluntEnd {
 public:
  BluntEnd(const GreyImage& image, const GaussianKernels& kernels, const StripePath& selection,
           const std::vector<RidgePoint>& points, const Branch& branch, bool last)
      : image_(image),
        kernels_(kernels),
        selection_(selection),
        points_(points),
        branch_(branch),
        last_(last) {}

  // False where the branch is too short to have a direction.
  bool find_direction() {
    const int skipped = static_cast<int>(std::lround(kUnlikeEnd * kernels_.sigma));
    const int count = std::max(kFewestOfDirection,
                               static_cast<int>(std::lround(kDirectionFrom * kernels_.sigma)));
    if (std::ssize(branch_.points) < skipped + count) return false;
    double x = 0, y = 0, xx = 0, xy = 0;
    const double origin = line(point(skipped));
    for (int i = skipped; i < skipped + count; ++i) {
      const RidgePoint& p = point(i);
      const double along = (selection_.along_rows ? p.v : p.u) - origin, across = across_of(p);
      x += along, y += across, xx += along * along, xy += along * across;
      bend_ += p.curvature / static_cast<float>(count);
    }
    slope_ = (count * xy - x * y) / (count * xx - x * x);
    across_at_0_ = (y - slope_ * x) / count - slope_ * origin;
    const double length = std::hypot(1, slope_);
    const double normal_along = -slope_ / length, normal_across = 1 / length;
    normal_u_ = selection_.along_rows ? normal_across : normal_along;
    normal_v_ = selection_.along_rows ? normal_along : normal_across;
    return true;
  }

  bool ends_here() const { return ends_here_; }  // as far as it was followed

  // The centre k lines (columns or rows) on from the last point that has not turned off. False
  // where there is none.
  bool follow(int anew, int k, int border, RidgePoint& centre, float& deviation) {
    const int at = line(point(anew)) + (last_ ? k : -k);
    const double predicted = across_at_0_ + slope_ * at;
    int across = static_cast<int>(std::lround(predicted));
    for (int i = 0; i < 3; ++i) {
      const int column = selection_.along_rows ? across : at,
                row = selection_.along_rows ? at : across;
      if (std::min({column, row, image_.width - 1 - column, image_.height - 1 - row}) < border)
        return false;
      const Derivatives d = derivatives_at(image_, kernels_, column, row);
      const double bend = -(d.uu * normal_u_ * normal_u_ + 2 * d.uv * normal_u_ * normal_v_ +
                            d.vv * normal_v_ * normal_v_);
      if (bend < kLeastShare * bend_) return false;
      const double bend_along = -(d.uu + d.vv) - bend;
      ends_here_ |= bend_along >= kSharpEnd * bend && image_.at(column, row) == 255;
      const double t = (d.u * normal_u_ + d.v * normal_v_) / bend;
      centre = {static_cast<float>(column + t * normal_u_),
                static_cast<float>(row + t * normal_v_),
                static_cast<float>(normal_u_),
                static_cast<float>(normal_v_),
                static_cast<float>(bend),
                column,
                row};
      deviation = static_cast<float>(kDirectionDeviation *
                                     std::abs(d.v * normal_u_ - d.u * normal_v_) / bend);
      const int nearest = static_cast<int>(std::lround(across_of(centre)));
      if (nearest == across) break;
      across = nearest;
      if (std::abs(across - predicted) > kFarthestOff * kernels_.sigma + 1) return false;
    }
    return std::abs(across_of(centre) - predicted) <= kFarthestOff * kernels_.sigma &&
           !near_another(centre);
  }

 private:
  double across_of(const RidgePoint& p) const { return selection_.along_rows ? p.u : p.v; }
  int line(const RidgePoint& p) const { return selection_.along_rows ? p.row : p.column; }
  const RidgePoint& point(int i) const {  // from the end on
    const auto size = static_cast<int>(branch_.points.size());
    return points_[branch_.points[last_ ? size - 1 - i : i]];
  }
  bool near_another(const RidgePoint& centre) const {
    for (const Branch& other : selection_.branches) {
      if (!other.chosen || &other == &branch_) continue;
      for (const int i : other.points)
        if (line(points_[i]) == line(centre) &&
            std::abs(across_of(points_[i]) - across_of(centre)) < kernels_.sigma)
          return true;
    }
    return false;
  }

  const GreyImage& image_;
  const GaussianKernels& kernels_;
  const StripePath& selection_;
  const std::vector<RidgePoint>& points_;
  const Branch& branch_;
  bool last_;
  double slope_ = 0, across_at_0_ = 0, normal_u_ = 0, normal_v_ = 0, bend_ = 0;
  bool ends_here_ = false;
};

}  // namespace

void follow_blunt_ends(const GreyImage& image, const GaussianKernels& kernels, int border,
                       StripePath& selection, std::vector<RidgePoint>& points,
                       std::vector<float>& deviations) {
  const int anew = static_cast<int>(kSearchReach * kernels.sigma);
  for (Branch& branch : selection.branches) {
    if (!branch.chosen) continue;
    for (const bool last : {false, true}) {
      BluntEnd end(image, kernels, selection, points, branch, last);
      if (!end.find_direction()) continue;
      const std::size_t before = points.size();
      RidgePoint centre{};
      float deviation = 0;
      for (int k = 1; k <= 2 * anew && end.follow(anew, k, border, centre, deviation); ++k) {
        points.push_back(centre);
        deviations.push_back(deviation);
      }
      const auto followed = static_cast<int>(points.size() - before);
      if (followed < anew || !end.ends_here()) {
        points.resize(before);
        deviations.resize(deviations.size() - static_cast<std::size_t>(followed));
        continue;
      }
      auto& indices = branch.points;
      if (last)
        indices.resize(indices.size() - static_cast<std::size_t>(anew));
      else
        indices.erase(indices.begin(), indices.begin() + anew);
      for (int k = 0; k < followed; ++k)
        indices.insert(last ? indices.end() : indices.begin(), static_cast<int>(before) + k);
    }
  }
}

}  // namespace arcstart::extraction
