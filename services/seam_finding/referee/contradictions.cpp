#include "services/seam_finding/referee/contradictions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/order_statistics.hpp"
#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

// A plate that is no plane, or lies otherwise than is claimed. narrowest: no plate reaches less far
// from the seam; mm.
Reason of_shape(const PlateShape& shape, const PlateView& view, double narrowest) {
  if (!shape.known || std::abs(shape.height_at_seam(shape.middle)) > kReferee.bend)
    return {Code::kPlateNotShown};
  const double sure = kFit.outlier;
  const bool round =
      -shape.curvature > 1 / kReferee.round && -shape.curvature > sure * shape.curvature_deviation;
  if (round && shape.width < kReferee.narrow) return {Code::kPlateRound, -1 / shape.curvature};
  // After that: a plane through a part of something round is tilted as well.
  if (std::abs(shape.tilt) > std::max(kReferee.turned, sure * shape.tilt_deviation))
    return {Code::kPlateTurned, shape.tilt};
  const double width = view.widest - view.begin;
  if (width < kReferee.narrowest || (view.widest < narrowest && !view.cut_short))
    return {Code::kPlateTooNarrow, width};
  return {};
}

bool within(const StripeOnPlate& stripe, double from, double to) {
  return stripe.crossing > from && stripe.crossing < to;
}

// Plates side by side end at the seam: else there is none.
Reason at_edge(const SeamEdges& edges) {
  if (edges.stripes >= kModel.stripes_in_a_row &&
      edges.leaving < kReferee.by_accident * edges.stripes)
    return {Code::kNoEdgeAtSeam, static_cast<double>(edges.leaving),
            static_cast<double>(edges.stripes)};
  return {};
}

// Away from the seam, how far a stripe shows the plate without a break; -1 where not at all.
// Nothing where something before the plate breaks it.
std::optional<double> unbroken(const PlateView& view, const StripeOnPlate& stripe) {
  double last = view.begin + kReferee.beside_seam, reached = -1;
  int others = 0;  // in a row
  for (const Place& place : stripe.places) {
    if (place.away < view.begin + kReferee.beside_seam) continue;
    if (place.look == Look::kBefore && place.away - last < kModel.piece_gap) return std::nullopt;
    if (place.look == Look::kBefore || place.away - last > kModel.piece_gap) break;
    others = place.look == Look::kOn ? 0 : others + 1;
    if (others == kModel.sure_off_plate) break;
    if (place.look == Look::kOn) reached = last = place.away;
  }
  return reached;
}

// An outside corner's plates are wide. The cuts of two plates that end together lie in one plane,
// too, and reach far on an angle's other leg: but at the seam they are as narrow as a plate is
// thick.
Reason of_cut(const PlateView& view, double length) {
  std::vector<double> reaches;
  int shown = 0, narrow = 0;
  for (const StripeOnPlate& stripe : view.stripes) {
    if (!within(stripe, 0, length) || stripe.at_seam == AtSeam::kOff) continue;
    const auto reach = unbroken(view, stripe);
    if (reach && *reach < 0) continue;
    ++shown;
    narrow += reach && *reach < kModel.widest_cut;
    if (reach) reaches.push_back(*reach);
  }
  if (shown >= kModel.stripes_in_a_row && narrow > kReferee.shown_share * shown)
    return {Code::kPlateTooNarrow, median(reaches)};
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
  if (known >= kModel.stripes_in_a_row && both < kReferee.shown_share * known)
    return {Code::kSeamNotShown, static_cast<double>(both), static_cast<double>(known)};
  return {};
}

}  // namespace

bool is_outside_corner(const SeamResult& seam) { return seam.joint_type == "outside_corner"; }

Reason contradiction_of(const SeamResult& seam, const std::array<PlateView, 2>& views,
                        const std::array<PlateShape, 2>& shapes,
                        const std::array<std::optional<SeamEdges>, 2>& edges, double spacing) {
  const double length = (seam.end - seam.start).norm();
  if (views[0].stripes.size() < 2 || views[1].stripes.size() < 2) return {Code::kSeamNotCrossed};
  // Side by side a plate may be seen through a gap alone; crossing the other one it stands there,
  // and what is as low as a bar or a small block is none.
  const double narrowest = edges[0] || edges[1] ? 0 : kReferee.narrow;
  for (int j = 0; j < 2; ++j) {
    // A plate reaches away from the seam within its plane.
    const SeamPlate& plate = views[j].plate;
    if (std::abs(plate.away.dot(plate.plane.normal)) > kReferee.turned)
      return {Code::kPlateNotShown};
    if (const Reason reason = of_shape(shapes[j], views[j], narrowest)) return reason;
  }
  for (int j = 0; j < 2; ++j)
    if (edges[j])
      if (const Reason reason = at_edge(*edges[j])) return reason;
  if (is_outside_corner(seam))
    for (const PlateView& view : views)
      if (const Reason reason = of_cut(view, length)) return reason;
  return along(views, length, spacing);
}

}  // namespace arcstart::seam_finding
