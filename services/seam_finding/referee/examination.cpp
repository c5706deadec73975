#include "services/seam_finding/referee/examination.hpp"

#include <algorithm>
#include <vector>

#include "common/order_statistics.hpp"
#include "services/seam_finding/referee/constants.hpp"
#include "services/seam_finding/referee/contradictions.hpp"
#include "services/seam_finding/referee/corner/corner_radius.hpp"
#include "services/seam_finding/referee/plate_looks.hpp"
#include "services/seam_finding/referee/stripe_light.hpp"

namespace arcstart::seam_finding {
namespace {

double spacing_of(const PlateView& view) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < view.stripes.size(); ++k)
    steps.push_back(view.stripes[k].crossing - view.stripes[k - 1].crossing);
  if (steps.empty()) return 0;
  return median(steps);
}

// Of the places where the plates are claimed, those that show them; -1 where there are none.
double explained_by(const std::array<PlateView, 2>& views, double length) {
  double on = 0, all = 0;
  for (const PlateView& view : views)
    for (const StripeOnPlate& stripe : view.stripes)
      for (const Place& place : stripe.places) {
        if (place.along < 0 || place.along > length || place.look == Look::kBefore) continue;
        if (place.away < view.begin + kReferee.beside_seam || place.away > view.width) continue;
        ++all, on += place.look == Look::kOn;
      }
  return all > 0 ? on / all : -1;
}

bool stands_before(const PlateView& view, const StripeOnPlate& stripe) {
  const double from = view.begin + kReferee.beside_seam;
  return std::any_of(stripe.places.begin(), stripe.places.end(), [from](const Place& place) {
    return place.look == Look::kBefore && place.away > from &&
           place.away < from + kReferee.near_seam;
  });
}

std::vector<int> indices_of(const ThinnedScan& thinned) {
  std::vector<int> indices;
  indices.reserve(thinned.points.size());
  for (const ThinnedPoint& point : thinned.points) indices.push_back(point.index);
  return indices;
}

// What stands before one plate casts its shadow on both.
void set_covered(std::array<PlateView, 2>& views) {
  std::vector<int> covered;  // stripes
  for (const PlateView& view : views)
    for (const StripeOnPlate& stripe : view.stripes)
      if (stands_before(view, stripe)) covered.push_back(stripe.stripe);
  std::sort(covered.begin(), covered.end());
  for (PlateView& view : views)
    for (StripeOnPlate& stripe : view.stripes)
      stripe.covered = std::binary_search(covered.begin(), covered.end(), stripe.stripe);
}

}  // namespace

Examination examine(const ScanCloud& cloud, const SeamResult& seam) {
  ThinnedScan thinned;
  thin_out(cloud, thinned);
  return examine(cloud, thinned, seam);
}

Examination examine(const ScanCloud& cloud, const ThinnedScan& thinned, const SeamResult& seam) {
  Examination examination;
  if (seam.verdict != SeamResult::Verdict::kFound || !cloud.organised()) return examination;
  const auto lights = light_of(cloud);
  if (lights.empty()) return examination;
  const double length = (seam.end - seam.start).norm();
  std::array<PlateView, 2>& views = examination.views;
  for (int j = 0; j < 2; ++j) {
    views[j] = view_of(cloud, thinned, lights, seam, j);
    examination.shapes[j] = shape_of(views[j], length);
    set_looks(examination.shapes[j], length, views[j]);
    if (end_at_seam(seam)[j]) {
      examination.edges[j] = edges_of(views[j], length);
      leave_out_across(*examination.edges[j], views[j]);
    }
  }
  set_covered(views);
  examination.stripes =
      static_cast<int>(std::max(views[0].stripes.size(), views[1].stripes.size()));
  examination.spacing = spacing_of(views[0].stripes.size() > 1 ? views[0] : views[1]);
  examination.explained = explained_by(views, length);
  examination.contradiction =
      contradiction_of(seam, views, examination.shapes, examination.edges, examination.spacing);
  if (!examination.contradiction && !examination.edges[0] && !examination.edges[1])
    if (const auto radius = corner_radius(
            cloud, indices_of(thinned), seam,
            std::max(examination.shapes[0].tolerance, examination.shapes[1].tolerance)))
      examination.contradiction = {Reason::Code::kCornerRound, *radius};
  for (const SeamSide side : {SeamSide::kBegin, SeamSide::kEnd}) {
    const bool start = side == SeamSide::kBegin;
    const double end = start ? 0 : length;
    examination.ends[start ? 0 : 1] = first_of(bounds_of(views[0], side, end, examination.spacing),
                                               bounds_of(views[1], side, end, examination.spacing));
  }
  return examination;
}

}  // namespace arcstart::seam_finding
