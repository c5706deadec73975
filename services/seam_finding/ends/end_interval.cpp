#include "services/seam_finding/ends/end_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcstart::seam_finding {
namespace {

constexpr double kFlush = 0.3;   // share of joints whose plates end together
constexpr double kLight = 0.15;  // half a stripe's width: seen where it falls; mm
constexpr double kNever = 0.01;  // share of possibilities that do not count
constexpr double kOffsets = 40;  // the others end so far about each other; mm
// A stripe shows a plate at the seam also where it leaves it a little before; mm along the seam.
constexpr double kMargin = 0.5;
constexpr double kMostSlant = 0.5;  // of that for each mm before it

}  // namespace

EndBracket bracket_of(const Stations& stations, int plate, double end, double outward) {
  EndBracket bracket{end, end, false};
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
  if (inner > -1e8) bracket.inner = end + outward * inner;
  if (outer < 1e8) bracket.outer = end + outward * outer;
  bracket.runs_on = shown;
  return bracket;
}

double unsure_of(const Stations& stations, int plate) {
  return kMargin + kMostSlant * stations.near[plate];
}

void narrow(EndBracket& bracket, const PlateExtent& extent, double unsure, double margin,
            double outward) {
  const double inner = std::isfinite(extent.on)
                           ? std::max(extent.on, outward * bracket.inner - unsure)
                           : outward * bracket.inner;
  double outer = outward * bracket.outer + margin;
  if (extent.on > outer) {
    outer = extent.past;
    bracket.runs_on = false;
  }
  bracket.seen_past = extent.past <= outer;
  outer = std::min(outer, extent.past);
  if (!std::isfinite(outer))
    bracket.runs_on = true;
  else if (inner < outer)
    bracket.inner = outward * inner, bracket.outer = outward * outer;
}

void limit_by_bracket(SeamEnd& end, const EndBracket& bracket, double outward) {
  const double inner = outward * bracket.inner, outer = outward * bracket.outer;
  const double edge = outward * end.along;
  if (edge <= inner || !(outer > inner)) return;
  const double high = std::min(edge, outer), per_mm = (1 - kFlush) / kOffsets;
  // A stripe beside the plate lights some of it where it lies nearer than that; of one that is seen
  // past it the half may be hidden.
  const double beside = bracket.seen_past
                            ? (outer - edge) / std::sqrt(end.variance + kLight * kLight)
                            : (outer - kLight - edge) / std::sqrt(end.variance);
  const double flush = kFlush * 0.5 * std::erfc(-beside / std::sqrt(2.0));
  const double share = per_mm * (high - inner) / (per_mm * (outer - inner) + flush);
  const double middle = (inner + high) / 2;
  const double mean = share * middle + (1 - share) * edge;
  const double within = (high - inner) * (high - inner) / 12 + kLight * kLight;
  end.variance = share * (within + std::pow(middle - mean, 2)) +
                 (1 - share) * (end.variance + std::pow(edge - mean, 2));
  // Two deviations reach as far in as the end may lie, lopsided as that is.
  if (share > kNever) {
    const double farthest = inner + kNever / share * (high - inner);
    end.variance = std::max(end.variance, std::pow((mean - farthest) / 2, 2));
  }
  end.along = outward * mean;
}

void between_brackets(SeamEnd& end, const std::array<EndBracket, 2>& brackets, double outward) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double inner = kFar, outer = kFar;
  for (const EndBracket& bracket : brackets) {
    if (bracket.runs_on) continue;
    inner = std::min(inner, outward * bracket.inner);
    outer = std::min(outer, outward * bracket.outer);
  }
  if (!std::isfinite(outer) || outer < inner) return;
  end.along = outward * (inner + outer) / 2;
  end.variance = (outer - inner) * (outer - inner) / 12 + kLight * kLight;
}

}  // namespace arcstart::seam_finding
