#include "services/seam_finding/plate_extent.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart {
namespace {

constexpr double kSquareCut = 0.01;  // an edge's slope, mm along for each mm away: so much at most
constexpr double kBeam = 0.5;     // of a point's noise across its surface what it is along the seam
constexpr double kNearSeam = 3;   // where it may be the joint's other plate that is seen; mm
constexpr double kFarEdge = 3;    // and where the plate's far edge is passed; mm
constexpr double kFarthest = 55;  // from the seam another thing may touch the plate, as high; mm
// A plate that is seen so far beyond the seam's end may be another thing as high; mm.
constexpr double kGoesOn = 5;
constexpr double kClose = 30;  // from the seam that other thing does not lie; mm
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

// The outermost place on the plate before `limit`; mm outward.
double outermost(const ScanCloud& cloud, const PlateStripes& stripes, double outward, double noise,
                 double limit) {
  const double slack = kBeam * noise, reach = usable_reach(stripes);
  MostOfRuns on(cloud);
  for (const auto& run : stripes.runs)
    for (const int i : run) {
      const double r = stripes.away.dot(cloud.points[i] - stripes.line.point);
      const double place = outward * stripes.line.along(cloud.points[i]) - kSquareCut * r - slack;
      if (r <= reach && place < limit) on.add(i, place);
    }
  return on.most();
}

// The first place beyond `near` where something is seen past the plate, close to the seam; mm
// outward.
double first_past(const ScanCloud& cloud, const PlateStripes& stripes, double outward, double near,
                  const EndSearch& search) {
  const double far = std::min(kClose, usable_reach(stripes) - kFarEdge);
  MostOfRuns past(cloud);
  for (int i = 0; i < cloud.size(); ++i) {
    const auto through = seen_through(cloud, stripes.plate.plane, i, search.tolerance);
    if (!through) continue;
    const double r = stripes.away.dot(*through - stripes.line.point);
    const double place =
        outward * stripes.line.along(*through) + kSquareCut * r + kBeam * search.noise;
    if (r > kNearSeam && r < far && place > outward * near) past.add(i, -place);
  }
  return -past.most();
}

}  // namespace

double seen_on_plate(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                     double near, const EndSearch& search) {
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  const double most =
      outermost(cloud, stripes, outward, search.noise, std::numeric_limits<double>::infinity());
  if (most < outward * near + kGoesOn) return most;
  const double past = first_past(cloud, stripes, outward, near, search);
  return past > most ? most : outermost(cloud, stripes, outward, search.noise, past);
}

PlateExtent plate_extent(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                         double near, const EndSearch& search, const StripeCrossings& crossings) {
  PlateExtent extent;
  if (!cloud.organised()) return extent;
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  const Line& line = stripes.line;
  const Eigen::Vector3d& away = stripes.away;
  const double slack = kBeam * search.noise, far = usable_reach(stripes) - kFarEdge;
  extent.on = seen_on_plate(cloud, stripes, side, near, search);

  MostOfRuns past(cloud), beside(cloud);
  for (std::size_t k = 0; k < cloud.stripes.size(); ++k) {
    const ScanStripe& stripe = cloud.stripes[k];
    const int last = stripe.first + stripe.count - 1;
    if (stripe.count < kLeastRun ||
        std::min(std::abs(line.along(cloud.points[stripe.first]) - near),
                 std::abs(line.along(cloud.points[last]) - near)) > kAround)
      continue;
    for (int i = stripe.first; i <= last; ++i) {
      const auto through = seen_through(cloud, stripes.plate.plane, i, search.tolerance);
      if (!through) continue;
      const double r = away.dot(*through - line.point);
      const double place = outward * line.along(*through) + kSquareCut * r + slack;
      if (r <= kNearSeam || r >= far) continue;
      if (place > extent.on) past.add(i, -place);
      if (k >= crossings.along.size() || !crossings.along[k] || !stripes.runs[k].empty()) continue;
      const double crossing =
          outward * (*crossings.along[k] + crossings.slant * std::max(0.0, r - kAskew)) +
          kSquareCut * r + slack;
      if (crossing > extent.on) beside.add(i, -crossing);
    }
  }
  extent.past = -std::max(past.most(), beside.most());
  return extent;
}

}  // namespace arcstart
