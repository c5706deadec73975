#include "services/seam_finding/referee/contradictions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

// A plate that is no plane, or lies otherwise than is claimed.
Reason of_shape(const PlateShape& shape, const PlateView& view) {
  if (!shape.known || std::abs(shape.height_at_seam(shape.middle)) > kReferee.bend)
    return {Code::kPlateNotShown};
  const double sure = kReferee.deviations;
  const bool round =
      -shape.curvature > 1 / kReferee.round && -shape.curvature > sure * shape.curvature_deviation;
  if (round && shape.width < kReferee.narrow) return {Code::kPlateRound, -1 / shape.curvature};
  // After that: a plane through a part of something round is tilted as well.
  if (std::abs(shape.tilt) > std::max(kReferee.turned, sure * shape.tilt_deviation))
    return {Code::kPlateTurned, shape.tilt};
  const double width = view.widest - view.begin;
  if (width < kReferee.narrowest) return {Code::kPlateTooNarrow, width};
  return {};
}

bool within(const StripeOnPlate& stripe, double from, double to) {
  return stripe.crossing > from && stripe.crossing < to;
}

// Plates side by side end at the seam: else there is none.
Reason at_edge(const SeamEdges& edges) {
  if (edges.stripes >= kReferee.shown_stripes &&
      edges.leaving < kReferee.edges_shown * edges.stripes)
    return {Code::kNoEdgeAtSeam, static_cast<double>(edges.leaving),
            static_cast<double>(edges.stripes)};
  return {};
}

// Stripes at the seam, between its claimed ends: both plates there, one of them not.
Reason along(const std::array<PlateView, 2>& views, double length, double spacing) {
  int both = 0, not_both = 0;
  for (const StripeOnPlate& first : views[0].stripes) {
    if (!within(first, spacing, length - spacing)) continue;
    const auto second =
        std::find_if(views[1].stripes.begin(), views[1].stripes.end(),
                     [&](const StripeOnPlate& stripe) { return stripe.stripe == first.stripe; });
    if (second == views[1].stripes.end()) continue;
    const AtSeam a = first.at_seam, b = second->at_seam;
    if (a == AtSeam::kOn && b == AtSeam::kOn) ++both;
    if (a == AtSeam::kOff || b == AtSeam::kOff) ++not_both;
  }
  const int known = both + not_both;
  if (known >= kReferee.shown_stripes && both < kReferee.shown_share * known)
    return {Code::kSeamNotShown, static_cast<double>(both), static_cast<double>(known)};
  return {};
}

}  // namespace

Reason contradiction_of(const SeamResult& seam, const std::array<PlateView, 2>& views,
                        const std::array<PlateShape, 2>& shapes,
                        const std::array<std::optional<SeamEdges>, 2>& edges, double spacing) {
  const double length = (seam.end - seam.start).norm();
  if (views[0].stripes.size() < 2 || views[1].stripes.size() < 2) return {Code::kSeamNotCrossed};
  for (int j = 0; j < 2; ++j) {
    // A plate reaches away from the seam within its plane.
    const SeamPlate& plate = views[j].plate;
    if (std::abs(plate.away.dot(plate.plane.normal)) > kReferee.out_of_plane)
      return {Code::kPlateNotShown};
    if (const Reason reason = of_shape(shapes[j], views[j])) return reason;
  }
  for (int j = 0; j < 2; ++j)
    if (edges[j])
      if (const Reason reason = at_edge(*edges[j])) return reason;
  return along(views, length, spacing);
}

}  // namespace arcstart::seam_finding
