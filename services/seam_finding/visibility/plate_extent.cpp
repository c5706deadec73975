#include "services/seam_finding/visibility/plate_extent.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/visibility/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// The most of a value over runs of neighbours in one segment; of each the others bear it out.
class MostOfRuns {
 public:
  explicit MostOfRuns(const ScanCloud& cloud) : cloud_(cloud) {}
  void add(int point, double value) {
    const bool joined = run_ > 0 && point == last_ + 1 &&
                        cloud_.origins[point].stripe == cloud_.origins[last_].stripe &&
                        cloud_.origins[point].segment == cloud_.origins[last_].segment &&
                        std::abs(value - value_) < kVisibility.row_step;
    run_ = joined ? run_ + 1 : 1;
    of_run_ = joined ? std::max(of_run_, value) : value;
    last_ = point, value_ = value;
    if (run_ >= kModel.sure_points) most_ = std::max(most_, of_run_);
  }
  double most() const { return most_; }

 private:
  const ScanCloud& cloud_;
  int run_ = 0, last_ = -1;
  double value_ = 0, of_run_ = 0, most_ = -std::numeric_limits<double>::infinity();
};

double usable_reach(const PlateStripes& stripes) {
  return std::min(kVisibility.farthest, stripes.reach);
}

// The outermost place on the plate before `limit`, no farther than `reach` from the seam; mm
// outward.
double outermost(const ScanCloud& cloud, const PlateStripes& stripes, double outward, double slope,
                 double noise, double limit, double reach) {
  const double slack = kVisibility.beam * noise;
  MostOfRuns on(cloud);
  for (const auto& run : stripes.runs)
    for (const int i : run) {
      const double r = stripes.away.dot(cloud.points[i] - stripes.line.point);
      const double place = outward * (stripes.line.along(cloud.points[i]) - slope * r) -
                           kVisibility.end_slope * r - slack;
      if (r <= reach && place < limit) on.add(i, place);
    }
  return on.most();
}

// Whether a stripe shows the plate so far from the seam.
bool on_plate_at(const ScanCloud& cloud, const PlateStripes& stripes, std::size_t stripe,
                 double away) {
  const auto& run = stripes.runs[stripe];
  return std::any_of(run.begin(), run.end(), [&](int i) {
    return std::abs(stripes.away.dot(cloud.points[i] - stripes.line.point) - away) <
           kVisibility.askew;
  });
}

// The first place beyond `from` where something is seen past the plate, or light falls past it, no
// farther than `far` from the seam, of each of the stripes about `near`; mm outward, infinite where
// nothing is.
std::vector<double> first_past(const ScanCloud& cloud, const PlateStripes& stripes, double outward,
                               double near, double slope, double from, double far,
                               const Scales& scales, const StripeCrossings& crossings) {
  const Line& line = stripes.line;
  const double slack = kVisibility.beam * scales.noise;
  std::vector<double> places(cloud.stripes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < cloud.stripes.size(); ++k) {
    const ScanStripe& stripe = cloud.stripes[k];
    const int last = stripe.first + stripe.count - 1;
    if (stripe.count < kModel.sure_points ||
        std::min(std::abs(line.along(cloud.points[stripe.first]) - near),
                 std::abs(line.along(cloud.points[last]) - near)) > kVisibility.around_end)
      continue;
    MostOfRuns past(cloud), beside(cloud);
    double fall_from = far, fall_to = 0;  // of the light that falls past, from the seam
    for (int i = stripe.first; i <= last; ++i) {
      const auto through = seen_through(cloud, stripes.plate.plane, i, scales.tolerance);
      if (!through) continue;
      const double r = stripes.away.dot(*through - line.point);
      const double place =
          outward * (line.along(*through) - slope * r) + kVisibility.end_slope * r + slack;
      if (r <= kVisibility.near_seam || r >= far) continue;
      if (place > from) past.add(i, -place);
      if (k >= crossings.along.size() || !crossings.along[k]) continue;
      const double slant = outward * crossings.slant;
      const double crossing =
          outward * *crossings.along[k] +
          slant * std::max(0.0, slant > 0 ? r + kVisibility.askew : r - kVisibility.askew) +
          (kVisibility.end_slope - outward * slope) * r + slack;
      if (crossing <= from || on_plate_at(cloud, stripes, k, r)) continue;
      beside.add(i, -crossing);
      fall_from = std::min(fall_from, r), fall_to = std::max(fall_to, r);
    }
    const bool falls = fall_to - fall_from > kVisibility.least_fall;
    places[k] = -(falls ? std::max(past.most(), beside.most()) : past.most());
  }
  return places;
}

}  // namespace

double seen_on_plate(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                     double near, double slope, const Scales& scales,
                     const StripeCrossings& crossings, double reach) {
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  reach = std::min(reach, usable_reach(stripes));
  const double most = outermost(cloud, stripes, outward, slope, scales.noise,
                                std::numeric_limits<double>::infinity(), reach);
  if (most < outward * near + kVisibility.goes_on) return most;
  std::vector<double> places =
      first_past(cloud, stripes, outward, near, slope, outward * near,
                 std::min(kVisibility.close, reach - kVisibility.far_edge), scales, crossings);
  std::sort(places.begin(), places.end());
  double past = places[0];
  // Behind a plate's end stripe after stripe is past it: one alone shows a reflection.
  if (places.size() > 1 && places[1] > past + kVisibility.lone_stripe) past = places[1];
  if (past > most) return most;
  // Another thing lies in the plate's plane, and may do so from before the plate's end.
  return outermost(cloud, stripes, outward, slope, scales.noise, past,
                   std::min(kVisibility.close, reach));
}

PlateExtent plate_extent(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                         double near, double slope, const Scales& scales,
                         const StripeCrossings& crossings) {
  PlateExtent extent;
  if (!cloud.organised()) return extent;
  extent.on = seen_on_plate(cloud, stripes, side, near, slope, scales, crossings);
  const std::vector<double> past =
      first_past(cloud, stripes, side == SeamSide::kEnd ? 1 : -1, near, slope, extent.on,
                 usable_reach(stripes) - kVisibility.far_edge, scales, crossings);
  extent.past = *std::min_element(past.begin(), past.end());
  return extent;
}

}  // namespace arcstart::seam_finding
