#include "services/seam_finding/visibility/plate_extent.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::seam_finding {
namespace {

constexpr double kSquareCut = 0.01;  // an edge's slope, mm along for each mm away: so much at most
constexpr double kBeam = 0.5;     // of a point's noise across its surface what it is along the seam
constexpr double kNearSeam = 3;   // where it may be the joint's other plate that is seen; mm
constexpr double kFarEdge = 3;    // and where the plate's far edge is passed; mm
constexpr double kFarthest = 55;  // from the seam another thing may touch the plate, as high; mm
// A plate that is seen so far beyond the seam's end may be another thing as high; mm.
constexpr double kGoesOn = 5;
constexpr double kLeastFall = 12;   // so wide is light that falls past a plate, and no spatter; mm
constexpr double kLoneStripe = 12;  // so far before others something past it is seen; mm
constexpr double kClose = 30;       // from the seam that other thing does not lie; mm
constexpr int kLeastRun = 3;   // points in a row that chance does not put on a plate or behind it
constexpr double kAskew = 5;   // light and sight meet the plane so far from each other, at most; mm
constexpr double kStep = 1.5;  // along the seam between neighbours in a row; mm
constexpr double kAround = 40;  // stripes so near the end tell of it; mm

// The most of a value over runs of neighbours in one segment; of each the others bear it out.
class MostOfRuns {
 public:
  explicit MostOfRuns(const ScanCloud& cloud) : cloud_(cloud) {}
  void add(int point, double value) {
    const bool joined = run_ > 0 && point == last_ + 1 &&
                        cloud_.origins[point].stripe == cloud_.origins[last_].stripe &&
                        cloud_.origins[point].segment == cloud_.origins[last_].segment &&
                        std::abs(value - value_) < kStep;
    run_ = joined ? run_ + 1 : 1;
    of_run_ = joined ? std::max(of_run_, value) : value;
    last_ = point, value_ = value;
    if (run_ >= kLeastRun) most_ = std::max(most_, of_run_);
  }
  double most() const { return most_; }

 private:
  const ScanCloud& cloud_;
  int run_ = 0, last_ = -1;
  double value_ = 0, of_run_ = 0, most_ = -std::numeric_limits<double>::infinity();
};

double usable_reach(const PlateStripes& stripes) { return std::min(kFarthest, stripes.reach); }

// The outermost place on the plate before `limit`, no farther than `reach` from the seam; mm
// outward.
double outermost(const ScanCloud& cloud, const PlateStripes& stripes, double outward, double noise,
                 double limit, double reach) {
  const double slack = kBeam * noise;
  MostOfRuns on(cloud);
  for (const auto& run : stripes.runs)
    for (const int i : run) {
      const double r = stripes.away.dot(cloud.points[i] - stripes.line.point);
      const double place = outward * stripes.line.along(cloud.points[i]) - kSquareCut * r - slack;
      if (r <= reach && place < limit) on.add(i, place);
    }
  return on.most();
}

// Whether a stripe shows the plate so far from the seam.
bool on_plate_at(const ScanCloud& cloud, const PlateStripes& stripes, std::size_t stripe,
                 double away) {
  const auto& run = stripes.runs[stripe];
  return std::any_of(run.begin(), run.end(), [&](int i) {
    return std::abs(stripes.away.dot(cloud.points[i] - stripes.line.point) - away) < kAskew;
  });
}

// The first place beyond `from` where something is seen past the plate, or light falls past it, no
// farther than `far` from the seam, of each of the stripes about `near`; mm outward, infinite where
// nothing is.
std::vector<double> first_past(const ScanCloud& cloud, const PlateStripes& stripes, double outward,
                               double near, double from, double far, const Scales& scales,
                               const StripeCrossings& crossings) {
  const Line& line = stripes.line;
  const double slack = kBeam * scales.noise;
  std::vector<double> places(cloud.stripes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < cloud.stripes.size(); ++k) {
    const ScanStripe& stripe = cloud.stripes[k];
    const int last = stripe.first + stripe.count - 1;
    if (stripe.count < kLeastRun ||
        std::min(std::abs(line.along(cloud.points[stripe.first]) - near),
                 std::abs(line.along(cloud.points[last]) - near)) > kAround)
      continue;
    MostOfRuns past(cloud), beside(cloud);
    double fall_from = far, fall_to = 0;  // of the light that falls past, from the seam
    for (int i = stripe.first; i <= last; ++i) {
      const auto through = seen_through(cloud, stripes.plate.plane, i, scales.tolerance);
      if (!through) continue;
      const double r = stripes.away.dot(*through - line.point);
      const double place = outward * line.along(*through) + kSquareCut * r + slack;
      if (r <= kNearSeam || r >= far) continue;
      if (place > from) past.add(i, -place);
      if (k >= crossings.along.size() || !crossings.along[k]) continue;
      const double slant = outward * crossings.slant;
      const double crossing = outward * *crossings.along[k] +
                              slant * std::max(0.0, slant > 0 ? r + kAskew : r - kAskew) +
                              kSquareCut * r + slack;
      if (crossing <= from || on_plate_at(cloud, stripes, k, r)) continue;
      beside.add(i, -crossing);
      fall_from = std::min(fall_from, r), fall_to = std::max(fall_to, r);
    }
    const bool falls = fall_to - fall_from > kLeastFall;
    places[k] = -(falls ? std::max(past.most(), beside.most()) : past.most());
  }
  return places;
}

}  // namespace

double seen_on_plate(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                     double near, const Scales& scales, const StripeCrossings& crossings,
                     double reach) {
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  reach = std::min(reach, usable_reach(stripes));
  const double most = outermost(cloud, stripes, outward, scales.noise,
                                std::numeric_limits<double>::infinity(), reach);
  if (most < outward * near + kGoesOn) return most;
  std::vector<double> places = first_past(cloud, stripes, outward, near, outward * near,
                                          std::min(kClose, reach - kFarEdge), scales, crossings);
  std::sort(places.begin(), places.end());
  double past = places[0];
  // Behind a plate's end stripe after stripe is past it: one alone shows a reflection.
  if (places.size() > 1 && places[1] > past + kLoneStripe) past = places[1];
  if (past > most) return most;
  // Another thing lies in the plate's plane, and may do so from before the plate's end.
  return outermost(cloud, stripes, outward, scales.noise, past, std::min(kClose, reach));
}

PlateExtent plate_extent(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                         double near, const Scales& scales, const StripeCrossings& crossings) {
  PlateExtent extent;
  if (!cloud.organised()) return extent;
  extent.on = seen_on_plate(cloud, stripes, side, near, scales, crossings);
  const std::vector<double> past =
      first_past(cloud, stripes, side == SeamSide::kEnd ? 1 : -1, near, extent.on,
                 usable_reach(stripes) - kFarEdge, scales, crossings);
  extent.past = *std::min_element(past.begin(), past.end());
  return extent;
}

}  // namespace arcstart::seam_finding
