// Section `extraction` of cell.yaml.
#pragma once

#include <string>

#include "common/configuration.hpp"

namespace arcstart::extraction {

struct ExtractionSettings {
  // Of the Gaussian kernels. 0: follows the stripe's measured width, found anew at the first image
  // of each scan.
  double sigma_px = 0;
  // Sigma for a stripe of width 1 (standard deviation of its profile), where it follows. White
  // noise alone wants sqrt(2), corners want less; with speckle 1.2 to 1.4 is best.
  double sigma_per_width = 1.3;
  // Sigma for a stripe of width 1 at which the chosen centres are measured once more, where sigma
  // follows and the course is fitted; taken where it leaves less noise. A smaller one is wrong by
  // less at corners and on a surface of coarse grain.
  double measuring_sigma_per_width = 0.85;

  // Ridge strength N (Eq. 3), in grey values at any sigma: a stripe of amplitude A and width w has
  // A / (2^1.5 sqrt(w)) at sigma = w. A segment holds centres of least_strength ...
  double least_strength = 4;
  // ... and goes on down to this share of it (hysteresis).
  double weakest_share = 0.45;
  // gamma of Eq. 3. It scales strength alone and never moves a centre.
  double strength_exponent = 1.5;

  int fewest_centres = 10;  // of a segment
  int longest_hole_px =
      5;  // columns without a centre that do not yet end a segment; nothing is put into them

  // Whether the centres are fitted along the stripe (centres/stripe_smoother.hpp): less speckle,
  // sharper corners, and centres up to the image's border. Else each is where its own pixel's
  // Hessian says.
  bool smooth_course = true;

  // That look for ridge points in strips of one image at once. The centres are the same, byte by
  // byte, for any number.
  int threads = 1;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("sigma_px", sigma_px, [](const double& value) -> std::string {
      return value == 0 || (value >= 0.8 && value <= 12) ? ""
                                                         : "must be 0 or lie between 0.8 and 12";
    });
    visitor("sigma_per_width", sigma_per_width, between(0.5, 3));
    visitor("measuring_sigma_per_width", measuring_sigma_per_width, between(0.5, 3));
    visitor("least_strength", least_strength, between(0.1, 200));
    visitor("weakest_share", weakest_share, between(0.1, 1));
    visitor("strength_exponent", strength_exponent, between(0, 3));
    visitor("fewest_centres", fewest_centres, between(3, 1000));
    visitor("longest_hole_px", longest_hole_px, between(1, 100));
    visitor("smooth_course", smooth_course);
    visitor("threads", threads, between(1, 64));
  }
};

}  // namespace arcstart::extraction
