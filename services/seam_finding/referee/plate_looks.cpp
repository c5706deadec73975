#include "services/seam_finding/referee/plate_looks.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// risen: over the shape, of the plate in the stripe before; then in this one. heights: keeps its
// memory from stripe to stripe.
void set_looks(const PlateShape& shape, double begin, StripeOnPlate& stripe, double& risen,
               std::vector<double>& heights) {
  heights.clear();
  int others = 0;
  for (Place& place : stripe.places) {
    const double height = place.height - shape.height_at(place.along, place.away) - risen;
    place.look = height > shape.tolerance    ? Look::kBefore
                 : height < -shape.tolerance ? Look::kThrough
                                             : Look::kOn;
    if (place.away < begin + kReferee.beside_seam) continue;
    if (place.look == Look::kOn)
      heights.push_back(height);
    else
      ++others;
  }
  if (static_cast<int>(heights.size()) < kModel.sure_points ||
      static_cast<int>(heights.size()) < others)
    return;
  risen += median(heights);
}

// Between two neighbours of a segment that look alike, what lies there looks so, too: the scan was
// thinned out, or its image has few pixels. a is the earlier point; appended from a to b.
void append_between(const Place& a, const Place& b, std::vector<Place>& places) {
  if (a.segment != b.segment || a.look != b.look || a.look == Look::kBefore) return;
  const int steps = static_cast<int>(std::abs(b.away - a.away) / kReferee.step);
  for (int step = 1; step < steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    Place between = a;
    between.along += share * (b.along - a.along);
    between.away += share * (b.away - a.away);
    between.height += share * (b.height - a.height);
    between.ends = false;
    places.push_back(between);
  }
}

// along: keeps its memory from stripe to stripe.
void fill_in(StripeOnPlate& stripe, std::vector<Place>& along) {
  std::vector<Place>& places = stripe.places;
  along = places;
  sort_by(&Place::point, along);
  for (std::size_t i = 1; i < along.size(); ++i) append_between(along[i - 1], along[i], places);
  if (places.size() > along.size()) sort_by(&Place::away, places);
}

// A single place at the plate's height beside what stands on the plate is on that thing's flank.
void leave_out_flanks(StripeOnPlate& stripe) {
  std::vector<Place>& places = stripe.places;
  const auto on = [&](std::size_t i) { return places[i].look == Look::kOn; };
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    if (!on(i) || on(i - 1) || on(i + 1)) continue;
    if (places[i - 1].look == Look::kBefore || places[i + 1].look == Look::kBefore)
      places[i].look = Look::kBefore;
  }
}

// What the places beside the seam show.
AtSeam seen_at_seam(const PlateView& view, const StripeOnPlate& stripe) {
  const double from = view.begin + kReferee.beside_seam;
  int on = 0, off = 0, before = 0;
  for (const Place& place : stripe.places) {
    if (place.away < from || place.away > from + kReferee.near_seam) continue;
    ++(place.look == Look::kOn ? on : place.look == Look::kThrough ? off : before);
  }
  const int known = on + off;
  if (known == 0) return before > 0 ? AtSeam::kHidden : AtSeam::kUnknown;
  if (on >= kReferee.nearly_all * known) return AtSeam::kOn;
  if (off >= kReferee.nearly_all * known) return AtSeam::kOff;
  return AtSeam::kPart;
}

// By stripes between the ends that nothing before the plate cuts short.
void set_width(double length, double tolerance, PlateView& view) {
  std::vector<double> widths, cut;
  for (const StripeOnPlate& stripe : view.stripes) {
    double reached = -1;
    int others = 0;  // in a row
    bool cut_short = false;
    for (const Place& place : stripe.places) {
      if (place.away < view.begin + kReferee.beside_seam) continue;
      if (place.along < 0 || place.along > length) continue;
      others = place.look == Look::kOn ? 0 : others + 1;
      cut_short = place.look == Look::kBefore;
      if (others == kModel.sure_off_plate && reached >= 0) break;
      if (place.look == Look::kOn) reached = place.away;
    }
    if (reached > 0) (cut_short ? cut : widths).push_back(reached);
  }
  // Where nearly all are cut short, they must do.
  view.cut_short = 3 * widths.size() < cut.size();
  if (view.cut_short) widths.insert(widths.end(), cut.begin(), cut.end());
  if (widths.empty()) return;
  view.width = std::max(0.0, upper_quantile(widths, 0.25) - 2 * tolerance);
  view.widest = std::max(0.0, upper_quantile(widths, 0.75) - 2 * tolerance);
}

}  // namespace

void set_looks(const PlateShape& shape, double length, PlateView& view) {
  // From the seam's middle outward a bent plate is followed stripe by stripe: what shows it says
  // where the next must show it.
  std::vector<StripeOnPlate>& stripes = view.stripes;
  const auto middle = std::partition_point(
      stripes.begin(), stripes.end(),
      [&](const StripeOnPlate& stripe) { return stripe.crossing < length / 2; });
  std::vector<double> heights;
  std::vector<Place> along;
  double risen = 0;
  for (auto stripe = middle; stripe != stripes.end(); ++stripe)
    set_looks(shape, view.begin, *stripe, risen, heights);
  risen = 0;
  for (auto stripe = middle; stripe != stripes.begin();)
    set_looks(shape, view.begin, *--stripe, risen, heights);
  for (StripeOnPlate& stripe : stripes) {
    fill_in(stripe, along);
    leave_out_flanks(stripe);
    stripe.at_seam = seen_at_seam(view, stripe);
  }
  set_width(length, shape.tolerance, view);
}

}  // namespace arcstart::seam_finding
