// What each stripe shows where a plate is claimed: the plate, something behind it, or before it.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/referee/stripe_light.hpp"

namespace arcstart::seam_finding {

enum class Look : char {
  kOn,       // the light ends on the plate
  kThrough,  // it goes on to something behind: no opaque plate is there
  kBefore    // something before it keeps the light
};

// Where a ray of light meets a plate's plane.
struct Place {
  double along = 0;   // the seam from its claimed start; mm
  double away = 0;    // from the seam, in the plate; mm
  double height = 0;  // of what was seen over the plate's plane, out of the metal; mm
  Look look = Look::kOn;
  bool ends = false;             // a segment of the stripe ends with it
  int point = -1, segment = -1;  // of the cloud, and of the stripe
};

// Rising by one of their numbers. Along a stripe places mostly come in order already, or the other
// way round: looking is cheaper than sorting.
template <class Number>
void sort_by(Number Place::*number, std::vector<Place>& places) {
  const auto before = [number](const Place& a, const Place& b) { return a.*number < b.*number; };
  if (places.size() > 1 && before(places.back(), places.front()))
    std::reverse(places.begin(), places.end());
  if (!std::is_sorted(places.begin(), places.end(), before))
    std::sort(places.begin(), places.end(), before);
}

// What a stripe shows of a plate right beside the seam.
enum class AtSeam : char {
  kUnknown,  // nothing
  kOn,
  kOff,     // what lies behind is seen
  kPart,    // the plate's edge crosses there
  kHidden,  // something stands before it
};

struct StripeOnPlate {
  int stripe = 0;       // index
  double crossing = 0;  // along, where the stripe's light crosses the seam; mm
  double lean = 0;      // along for each away, of the light's trace on the plate
  double shadow = 0;  // along, that an edge hides of what lies 1 mm behind the plate; from light or
                      // camera, the longer
  std::vector<Place> places;  // by rising away
  AtSeam at_seam = AtSeam::kUnknown;
  bool covered = false;  // something stands before this plate or the other one beside the seam
};

// Of one plate: the stripes within reach of the seam, in order of their crossings.
struct PlateView {
  SeamPlate plate;
  double begin = 0;  // away from the seam, where the plate is found to begin: behind a gap, a
                     // radius or a bead; mm
  // Away from the seam, as far as the plate was seen between the ends: by three stripes of four,
  // and by one of four; mm.
  double width = 0, widest = 0;
  bool cut_short = false;  // by what stands before the plate, in nearly all stripes
  std::vector<StripeOnPlate> stripes;
};

// A point of the cloud that is looked at, with what is asked of it side by side in memory.
struct ThinnedPoint {
  Eigen::Vector3d at;  // in base; mm
  int index, segment;  // in the cloud, and in its stripe
  bool ends;           // first or last of its segment
};

// Of each stripe those points that stand about a millimetre apart, and the ends of its segments. In
// their order.
struct ThinnedScan {
  std::vector<ThinnedPoint> points;
  std::vector<std::size_t> behind;  // each stripe's last, in `points`

  std::span<const ThinnedPoint> of_stripe(std::size_t stripe) const {
    const std::size_t first = stripe == 0 ? 0 : behind[stripe - 1];
    return {points.data() + first, behind[stripe] - first};
  }
};

// Goes on behind the last stripe that is thinned out already: a scan can be thinned out stripe by
// stripe while it runs.
void thin_out(const ScanCloud& cloud, ThinnedScan& thinned);

// heights as they are, everything kOn: what they mean is told by set_looks(). begin: by the heights
// over the claimed plane, along the middle of the seam.
PlateView view_of(const ScanCloud& cloud, const ThinnedScan& thinned,
                  const std::vector<std::optional<StripeLight>>& lights, const SeamResult& seam,
                  int plate);

}  // namespace arcstart::seam_finding
