// Where a plate ends toward a seam: the straight line through what was seen there.
#pragma once

#include <optional>
#include <vector>

namespace arcstart::seam_finding {

// In the plate's frame: where along and across the border was seen, and how far above the level at
// which it is wanted; mm. Points on a cut lie at any height, places where a stripe ends at 0.
struct LinePlace {
  double along = 0, across = 0, height = 0;
  double deviation = 0.1;  // of across, standard; mm
};

// across = at_middle + slope (along - middle) + lean * height.
struct LineFit {
  double middle = 0;  // mean place along; mm
  double at_middle = 0, slope = 0, lean = 0;
  double variance = 0, slope_variance = 0;  // of at_middle and slope
  int places = 0;                           // that agree

  double across_at(double along) const { return at_middle + slope * (along - middle); }
  double variance_at(double along) const {
    return variance + slope_variance * (along - middle) * (along - middle);
  }
};

// Weighted least squares in which places far off count less and at last nothing (Tukey). Where
// seven in ten places lie far closer to another line than to that of least squares, it begins from
// the one that half of them lie closest to (least median of squares, Rousseeuw 1984): the others,
// as on a tack's flank, do not draw it aside. The lean is held about 0 with the given standard
// deviation. Nothing where fewer than four places agree.
std::optional<LineFit> fit_line(const std::vector<LinePlace>& places, double lean_deviation);

}  // namespace arcstart::seam_finding
