// Views of a plate drawn by hand: what stripes show of a plate with known ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "services/seam_finding/referee/plate_looks.hpp"

namespace arcstart::seam_finding::drawn {

struct Plate {
  double from = 0, to = 100;            // at the seam, where it ends; mm
  double from_slope = 0, to_slope = 0;  // of its ends: along for each away
  double width = 40;                    // away from the seam; mm
  double depth = 10;                    // of what lies behind it; mm
  std::function<double(double)> wave = [](double) { return 0.0; };  // of both ends, by away; mm
};

// What stands before the plate, or casts a shadow on it, on a whole stripe.
enum class Cover { kNothing, kBefore, kDark };

struct Scan {
  double pitch = 3.6, first = -40, last = 140;  // of the stripes along the seam; mm
  double lean = 0.38, shadow = 0.4;
  double phase = 0.7;  // of the stripes, mm
  std::function<Cover(double)> cover = [](double) { return Cover::kNothing; };  // by crossing
};

inline PlateView view_of(const Plate& plate, const Scan& scan) {
  PlateView view;
  view.plate.away = Eigen::Vector3d::UnitY();
  for (double crossing = scan.first + scan.phase; crossing < scan.last; crossing += scan.pitch) {
    StripeOnPlate stripe;
    stripe.stripe = static_cast<int>(view.stripes.size());
    stripe.crossing = crossing, stripe.lean = scan.lean, stripe.shadow = scan.shadow;
    const Cover cover = scan.cover(crossing);
    for (int i = 0; cover != Cover::kDark && i * 1.0 < plate.width + 10; ++i) {
      Place place;
      place.away = 0.3 + i, place.along = crossing + scan.lean * place.away;
      const double wave = plate.wave(place.away);
      const bool on = place.along > plate.from + plate.from_slope * place.away + wave &&
                      place.along < plate.to + plate.to_slope * place.away + wave &&
                      place.away < plate.width;
      place.height = cover == Cover::kBefore ? 15 : on ? 0 : -plate.depth;
      place.point = 1000 * stripe.stripe + i;
      stripe.places.push_back(place);
    }
    view.stripes.push_back(stripe);
  }
  PlateShape shape;
  shape.known = true, shape.tolerance = 0.3;
  shape.middle = (plate.from + plate.to) / 2, shape.half = (plate.to - plate.from) / 2;
  set_looks(shape, plate.to, view);
  return view;
}

}  // namespace arcstart::seam_finding::drawn
