#include "services/seam_finding/referee/examination.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/seam_finding/referee/constants.hpp"
#include "services/seam_finding/referee/plate_view.hpp"
#include "services/seam_finding/referee/stripe_light.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

double spacing_of(const PlateView& view) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < view.stripes.size(); ++k)
    steps.push_back(view.stripes[k].crossing - view.stripes[k - 1].crossing);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

// Of the places where the plates are claimed, those that show them; -1 where there are none.
double explained_by(const std::array<PlateView, 2>& views, double length) {
  double on = 0, all = 0;
  for (const PlateView& view : views)
    for (const StripeOnPlate& stripe : view.stripes)
      for (const Place& place : stripe.places) {
        if (place.along < 0 || place.along > length || place.look == Look::kBefore) continue;
        if (place.away < view.plate.inset + kReferee.beside_seam || place.away > view.width)
          continue;
        ++all, on += place.look == Look::kOn;
      }
  return all > 0 ? on / all : -1;
}

// A plate that is no plane, or lies otherwise than is claimed.
Reason contradiction_of(const PlateShape& shape) {
  if (!shape.known) return {Code::kPlateNotShown};
  const double sure = kReferee.deviations;
  if (std::abs(shape.tilt) > std::max(kReferee.turned, sure * shape.tilt_deviation))
    return {Code::kPlateTurned, shape.tilt};
  const bool round =
      -shape.curvature > 1 / kReferee.round && -shape.curvature > sure * shape.curvature_deviation;
  if (round && shape.width < kReferee.narrow) return {Code::kPlateRound, -1 / shape.curvature};
  return {};
}

// Stripes at the seam, between its claimed ends: both plates there, one of them not.
Reason contradiction_along(const std::array<PlateView, 2>& views, double length, double spacing) {
  int both = 0, not_both = 0;
  for (const StripeOnPlate& first : views[0].stripes) {
    if (first.crossing < spacing || first.crossing > length - spacing) continue;
    const auto second =
        std::find_if(views[1].stripes.begin(), views[1].stripes.end(),
                     [&](const StripeOnPlate& stripe) { return stripe.stripe == first.stripe; });
    if (second == views[1].stripes.end()) continue;
    const AtSeam a = at_seam(views[0], first), b = at_seam(views[1], *second);
    if (a == AtSeam::kOn && b == AtSeam::kOn) ++both;
    if (a == AtSeam::kOff || b == AtSeam::kOff) ++not_both;
  }
  const int known = both + not_both;
  if (known >= kReferee.shown_stripes && both < kReferee.shown_share * known)
    return {Code::kSeamNotShown, static_cast<double>(both), static_cast<double>(known)};
  return {};
}

}  // namespace

Examination examine(const ScanCloud& cloud, const SeamResult& seam) {
  Examination examination;
  if (seam.verdict != SeamResult::Verdict::kFound || !cloud.organised()) return examination;
  const auto lights = light_of(cloud);
  const double length = (seam.end - seam.start).norm();
  std::array<PlateView, 2> views;
  for (int j = 0; j < 2; ++j) {
    views[j] = view_of(cloud, lights, seam, j);
    examination.shapes[j] = shape_of(views[j], length);
    set_looks(examination.shapes[j], length, views[j]);
  }
  examination.stripes =
      static_cast<int>(std::max(views[0].stripes.size(), views[1].stripes.size()));
  if (examination.stripes == 0) return examination;
  examination.spacing = spacing_of(views[0].stripes.size() > 1 ? views[0] : views[1]);
  examination.explained = explained_by(views, length);
  for (const SeamSide side : {SeamSide::kBegin, SeamSide::kEnd}) {
    const bool start = side == SeamSide::kBegin;
    const double end = start ? 0 : length;
    examination.ends[start ? 0 : 1] = first_of(bounds_of(views[0], side, end, examination.spacing),
                                               bounds_of(views[1], side, end, examination.spacing));
  }
  for (const Reason& reason :
       {contradiction_of(examination.shapes[0]), contradiction_of(examination.shapes[1]),
        contradiction_along(views, length, examination.spacing)})
    if (reason && !examination.contradiction) examination.contradiction = reason;
  return examination;
}

}  // namespace arcstart::seam_finding
