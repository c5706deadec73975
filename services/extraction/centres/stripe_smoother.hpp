// The course of a branch: the most likely line through its centres, with what the kernels have cut
// off its corners put back.
#pragma once

#include <vector>

namespace arcstart::extraction {

struct SmoothedPoint {
  double along, across;  // px, along and across the image's main direction of the stripe
  double deviation;      // standard deviation of the centre as found; px
  double sigma;          // of the kernels that found it; px
  bool at_border;        // so near that the mirrored image bends the line: not to be fitted to
};

// y(x), known at whole px x, is the line for which
//     sum_i (c_i - (y + b y'')(x_i))^2 / v_i  +  2 sum_x log(s^2 + m(y''^2)(x))
// is least. c_i are the centres as found and v_i their variances, times the points for one: errors
// of neighbours hang together over what the kernels span. b y'' is what a Gaussian of sigma moves
// the crest of a curved stripe to the inner side, sigma^2/2 times its curvature (the heat flow of
// the curve), so that y is the line before that. The second sum is the logarithm of a Cauchy
// density of the bend: surfaces are flat or gently bent (s), but for edges, which may be anything;
// m is the mean over +- sigma, since no kernel shows an edge sharper than that. So faint and rough
// stripes are smoothed over long ways, strong ones hardly, and corners stay. Nothing is put where
// no point is.
//
// It is found by reweighting: each round solves a system of five diagonals.
class StripeSmoother {
 public:
  // points by their place along, at most one a column (row). Replaces across and deviation;
  // deviation 0: the point lies at the border, and where it truly is the others do not tell. A
  // short branch's others are left alone.
  void smooth(std::vector<SmoothedPoint>& points);

 private:
  struct Station {
    double value = 0, weight = 0;  // of the centre there, px and 1 / px^2; weight 0: none
    double bow = 0;                // b; px^2
    double line = 0;               // y; px
    double stiffness = 0;          // weight of y''^2; px^2
    double deviation = 0;          // of y; px
    // The system's three upper diagonals, then its factors: 1 / D and L of L D L^T.
    double diagonal = 0, next = 0, after_next = 0;
  };
  std::size_t station_of(const SmoothedPoint& point) const;
  double slope_at(std::size_t at) const;
  void observe(const std::vector<SmoothedPoint>& points);
  void set_up();
  bool solve();
  void stiffen(int reach);
  void find_deviations();

  double origin_along_ = 0, origin_across_ = 0;
  std::vector<Station> stations_;  // one a px along
  std::vector<double> squares_;    // sums of y''^2 up to each station
};

}  // namespace arcstart::extraction
