#include "services/seam_finding/referee/edge_evidence.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace arcstart::seam_finding;

namespace {

constexpr double width = 40;
const ClaimedEnd end{100, 1};

// A stripe that crosses the seam at 95 mm and goes out by 0.4 for each mm away: on the plate up to
// `last`, and from `next` on over what lies 10 mm behind.
StripeOnPlate leaving(double last, double next, bool one_segment) {
  StripeOnPlate stripe;
  stripe.crossing = 95, stripe.lean = 0.4, stripe.shadow = 0.3;
  for (double away = 0; away < width; away += 0.5) {
    if (away > last && away < next) continue;
    Place place;
    place.away = away, place.along = stripe.crossing + stripe.lean * away;
    place.look = away <= last ? Look::kOn : Look::kThrough;
    place.height = away <= last ? 0 : -10;
    place.segment = one_segment || away <= last ? 0 : 1;
    place.point = static_cast<int>(stripe.places.size());
    stripe.places.push_back(place);
  }
  return stripe;
}

std::vector<EdgeMark> crossings(const StripeOnPlate& stripe, const ClaimedEnd& at = end) {
  return crossings_of(stripe, 0, 0, width, at);
}

}  // namespace

TEST_CASE("a segment that ends on the plate crosses its edge there") {
  const auto marks = crossings(leaving(20, 25, false));
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].away == Approx(20));
  CHECK(marks[0].out == Approx(3));
}

TEST_CASE("a segment that goes on down an edge face crosses where the face comes up to the plate") {
  StripeOnPlate stripe = leaving(20, 20.5, true);
  // The face: from the plate at 20.25 mm.
  for (Place& place : stripe.places)
    if (place.look == Look::kThrough) place.height = -2 * (place.away - 20.25);
  const auto marks = crossings(stripe);
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].away == Approx(20.25));
  CHECK(marks[0].out == Approx(95 + 0.4 * 20.25 - 100));
}

TEST_CASE("what ends a stripe otherwise is no edge") {
  // In a shadow longer than that of the edge, 10 mm over what lies behind.
  CHECK(crossings(leaving(10, 30, false)).empty());
  // Nothing is seen behind.
  CHECK(crossings(leaving(20, width, false)).empty());
  // Something stands before the plate.
  StripeOnPlate covered = leaving(20, 21, false);
  for (Place& place : covered.places)
    if (place.look == Look::kThrough) place.look = Look::kBefore, place.height = 10;
  CHECK(crossings(covered).empty());
  // It leaves the plate inward, seen from the other end.
  CHECK(crossings(leaving(20, 21, false), {0, -1}).empty());
  // The plate's other edge, along the seam.
  CHECK(crossings(leaving(38.5, 39, false)).empty());
}

TEST_CASE("crossings count from the plate's border") {
  const auto marks = crossings_of(leaving(20, 21, false), 6, 6, width - 6, end);
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].away == Approx(14));
}
