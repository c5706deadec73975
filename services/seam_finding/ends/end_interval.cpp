#include "services/seam_finding/ends/end_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/seam_finding/ends/constants.hpp"

namespace arcstart::seam_finding {

EndInterval interval_of(const Stations& stations, int plate, double end, double outward) {
  EndInterval interval{end, end, false};
  double inner = -1e9, outer = 1e9;
  bool shown = false;
  for (const Station& station : stations.list) {
    if (!station.known) continue;
    const double place = outward * (station.along - end);
    if (place <= 0 && stations.both(station)) inner = std::max(inner, place);
    if (place > 0 && place < outer) {
      outer = place;
      shown = station.nearest[plate] <= stations.near[plate];
    }
  }
  if (inner > -1e8) interval.inner = end + outward * inner;
  if (outer < 1e8) interval.outer = end + outward * outer;
  interval.runs_on = shown;
  return interval;
}

double unsure_of(const Stations& stations, int plate) {
  return kEnds.margin + kEnds.margin_slant * stations.near[plate];
}

void narrow(EndInterval& interval, const PlateExtent& extent, double unsure, double margin,
            double outward) {
  const double inner = std::isfinite(extent.on)
                           ? std::max(extent.on, outward * interval.inner - unsure)
                           : outward * interval.inner;
  double outer = outward * interval.outer + margin;
  if (extent.on > outer) {
    outer = extent.past;
    interval.runs_on = false;
  }
  interval.seen_past = extent.past <= outer;
  outer = std::min(outer, extent.past);
  if (!std::isfinite(outer))
    interval.runs_on = true;
  else if (inner < outer)
    interval.inner = outward * inner, interval.outer = outward * outer;
}

void limit_by_interval(SeamEnd& end, const EndInterval& interval, double outward) {
  const double inner = outward * interval.inner, outer = outward * interval.outer;
  const double edge = outward * end.along;
  if (edge <= inner || !(outer > inner)) return;
  const double high = std::min(edge, outer), per_mm = (1 - kEnds.flush_share) / kEnds.offsets;
  // A stripe beside the plate lights some of it where it lies nearer than that; of one that is seen
  // past it the half may be hidden.
  const double beside =
      interval.seen_past
          ? (outer - edge) / std::sqrt(end.variance + kEnds.half_stripe * kEnds.half_stripe)
          : (outer - kEnds.half_stripe - edge) / std::sqrt(end.variance);
  const double flush = kEnds.flush_share * 0.5 * std::erfc(-beside / std::sqrt(2.0));
  const double share = per_mm * (high - inner) / (per_mm * (outer - inner) + flush);
  const double middle = (inner + high) / 2;
  const double mean = share * middle + (1 - share) * edge;
  const double within =
      (high - inner) * (high - inner) / 12 + kEnds.half_stripe * kEnds.half_stripe;
  end.variance = share * (within + std::pow(middle - mean, 2)) +
                 (1 - share) * (end.variance + std::pow(edge - mean, 2));
  // Two deviations reach as far in as the end may lie, lopsided as that is.
  if (share > kEnds.never) {
    const double farthest = inner + kEnds.never / share * (high - inner);
    end.variance = std::max(end.variance, std::pow((mean - farthest) / 2, 2));
  }
  end.along = outward * mean;
}

void between_intervals(SeamEnd& end, const std::array<EndInterval, 2>& intervals, double outward) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double inner = kFar, outer = kFar;
  for (const EndInterval& interval : intervals) {
    if (interval.runs_on) continue;
    inner = std::min(inner, outward * interval.inner);
    outer = std::min(outer, outward * interval.outer);
  }
  if (!std::isfinite(outer) || outer < inner) return;
  end.along = outward * (inner + outer) / 2;
  end.variance = (outer - inner) * (outer - inner) / 12 + kEnds.half_stripe * kEnds.half_stripe;
}

}  // namespace arcstart::seam_finding
