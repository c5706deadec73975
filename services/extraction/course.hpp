// The course of a branch: its centres smoothed along the stripe where it runs smoothly, and what
// the kernels have cut off its corners put back.
#pragma once

#include <array>
#include <vector>

namespace arcstart {

struct CoursePoint {
  double along, across;  // px, along and across the image's main direction of the stripe
  double deviation;      // standard deviation of the centre as found; px
  bool at_border;        // so near that the mirrored image bends the line: not to be fitted to
};

// A Gaussian of sigma moves the crest of a curved stripe to the inner side by sigma^2/2 times its
// curvature (the heat flow of the curve), which rounds a corner: the fit's own curvature tells by
// how much, and it is moved back.
//
// The fits are polynomials over a window about the point, the widest of four that says nothing that
// the points do not bear: the residuals, in units of the points' deviations, are no more than
// usual in the branch. The widest ones take the grain of speckle out, the narrowest follows a
// corner. Nothing is put where no point is.
class BranchCourse {
 public:
  // points by their place along. Replaces across and deviation; deviation 0: the point lies at the
  // border, and where it truly is the others do not tell. A short branch's others are left alone.
  void smooth(std::vector<CoursePoint>& points, double sigma);

 private:
  struct Sums {  // of points 0 .. i-1
    std::array<double, 5> x;
    std::array<double, 3> xy;
    double yy, variance;
  };
  struct Fit {
    double value, deviation;  // corrected for the bend; px, of independent points of deviation 1
    double misfit;            // mean square of the residuals, in units of the points' variance
    bool valid;
  };
  void fit_all(const std::vector<CoursePoint>& points, double sigma);
  void add_up(const std::vector<CoursePoint>& points);
  struct Window {
    std::size_t begin = 0, end = 0;
  };
  // window: of the point before, if any.
  Fit fit_parabola(const std::vector<CoursePoint>& points, std::size_t at, double reach,
                   Window& window) const;
  Fit fit_quartic(const std::vector<CoursePoint>& points, std::size_t at, double reach) const;

  double sigma_ = 0, origin_along_ = 0, origin_across_ = 0;
  std::vector<Sums> sums_;
  std::vector<Fit> usual_;
  std::vector<double> misfits_;
  std::vector<CoursePoint> smoothed_;
};

}  // namespace arcstart
