#include "services/seam_finding/referee/seam_edges.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

struct EdgePlace {
  double along, off;  // mm
};

// Least squares, then once more without what lies off; false with too few.
bool fit_course(std::vector<EdgePlace> places, double length, SeamEdges& edges) {
  for (int pass = 0; pass < 2; ++pass) {
    if (static_cast<int>(places.size()) < kFit.line_places) return false;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const EdgePlace& place : places) {
      n += 1, x += place.along, y += place.off;
      xx += place.along * place.along, xy += place.along * place.off;
    }
    const double spread = n * xx - x * x;
    if (!(spread > 1)) return false;
    const double slope = (n * xy - x * y) / spread;
    edges.at_start = (y - slope * x) / n;
    edges.at_end = edges.at_start + slope * length;
    std::vector<EdgePlace> kept;
    for (const EdgePlace& place : places)
      if (std::abs(place.off - edges.at_start - slope * place.along) < kReferee.step / 2)
        kept.push_back(place);
    places = std::move(kept);
  }
  return true;
}

// On the plate from beside the seam to the other plate's side: a stripe that begins beside the seam
// may have its edge in a shadow.
bool runs_across(const PlateView& view, const StripeOnPlate& stripe) {
  const double beyond = view.plate.inset - kReferee.step;
  return stripe.at_seam == AtSeam::kOn && !edge_in(view, stripe) &&
         std::any_of(stripe.places.begin(), stripe.places.end(), [beyond](const Place& place) {
           return place.look == Look::kOn && place.away < beyond;
         });
}

}  // namespace

std::array<bool, 2> end_at_seam(const SeamResult& seam) {
  if (seam.joint_type == "butt" || seam.joint_type == "v") return {true, true};
  if (seam.joint_type != "lap") return {false, false};
  const auto over = [&](int plate) {
    return seam.faces[plate].plane.signed_distance(seam.start) < -kReferee.allowed / 2;
  };
  return {over(0), over(1)};
}

std::optional<double> edge_in(const PlateView& view, const StripeOnPlate& stripe) {
  const double from = view.begin + kReferee.beside_seam;
  std::optional<double> last;
  bool ends = false;
  for (auto place = stripe.places.rbegin(); place != stripe.places.rend(); ++place) {
    if (!last && place->away > from + kReferee.near_seam) continue;
    if (place->look != Look::kOn || (last && *last - place->away > kModel.piece_gap)) {
      if (last) return last;
      continue;
    }
    if (ends && place->ends) return last;  // from one segment to the next
    last = place->away, ends = place->ends && place->away < from;
  }
  return ends ? last : std::nullopt;
}

SeamEdges edges_of(const PlateView& view, double length) {
  SeamEdges edges;
  std::vector<EdgePlace> places;
  for (const StripeOnPlate& stripe : view.stripes) {
    if (stripe.crossing < 0 || stripe.crossing > length) continue;
    if (stripe.at_seam != AtSeam::kOn) continue;
    ++edges.stripes;
    const auto edge = edge_in(view, stripe);
    if (!edge) continue;
    const double off = *edge - view.plate.inset;
    edges.leaving += std::abs(off) < kReferee.step;
    if (std::abs(off) < 2 * kReferee.step) places.push_back({stripe.crossing, off});
  }
  edges.known = fit_course(std::move(places), length, edges);
  return edges;
}

void leave_out_across(const SeamEdges& edges, PlateView& view) {
  if (edges.stripes < kModel.stripes_in_a_row ||
      edges.leaving < kReferee.nearly_all * edges.stripes)
    return;
  for (StripeOnPlate& stripe : view.stripes)
    if (runs_across(view, stripe)) {
      for (Place& place : stripe.places) place.look = Look::kThrough;
      stripe.at_seam = AtSeam::kOff;
    }
}

}  // namespace arcstart::seam_finding
