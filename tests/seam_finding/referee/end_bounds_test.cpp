#include "services/seam_finding/referee/end_bounds.hpp"

#include <catch2/catch.hpp>

#include "tests/seam_finding/referee/drawn_view.hpp"

using namespace arcstart::seam_finding;
using drawn::Cover;

namespace {

constexpr double kPitch = 3.6;

EndBounds at_start(const drawn::Plate& plate, const drawn::Scan& scan, double claimed = 0) {
  return bounds_of(drawn::view_of(plate, scan), SeamSide::kBegin, claimed, kPitch);
}

EndBounds at_end(const drawn::Plate& plate, const drawn::Scan& scan, double claimed = 100) {
  return bounds_of(drawn::view_of(plate, scan), SeamSide::kEnd, claimed, kPitch);
}

}  // namespace

TEST_CASE("the bounds hold a plate's ends, however they are cut and wherever stripes fall") {
  for (const double slope : {-0.36, 0.0, 0.36})
    for (const double phase : {0.1, 1.3, 2.9}) {
      drawn::Plate plate;
      plate.from_slope = plate.to_slope = slope;
      drawn::Scan scan;
      scan.phase = phase;
      INFO("slope " << slope << " phase " << phase);
      for (const EndBounds& bounds : {at_start(plate, scan), at_end(plate, scan)}) {
        CHECK(bounds.anchored);
        CHECK(bounds.straight);
        CHECK(bounds.least <= 0);
        CHECK(bounds.most >= 0);
        CHECK(bounds.most - bounds.least < 6);
      }
    }
}

TEST_CASE("ends that stripes cross are known better than their pitch, outward from any claim") {
  for (const double claimed : {-4.0, 0.0, 5.0}) {
    const EndBounds bounds = at_start({}, {}, claimed);
    INFO("claimed at " << claimed);
    CHECK(bounds.crossings > 1);
    CHECK(bounds.least <= claimed);
    CHECK(bounds.most >= claimed);
    CHECK(bounds.most - bounds.least < 2.5);
  }
}

TEST_CASE("a plate beside a gap ends where its edge meets its border, not the seam's line") {
  constexpr double inset = 10;
  for (const double slope : {-0.2, 0.2}) {
    drawn::Plate plate;
    plate.to_slope = slope;
    PlateView view = drawn::view_of(plate, {});
    view.plate.inset = view.begin = inset;
    const EndBounds bounds = bounds_of(view, SeamSide::kEnd, 100, kPitch);
    INFO("slope " << slope);
    CHECK(bounds.least <= slope * inset);
    CHECK(bounds.most >= slope * inset);
    CHECK(bounds.most - bounds.least < 2);
  }
}

TEST_CASE("a plate that begins behind a radius is bounded at the seam") {
  for (const double slope : {-0.36, 0.36}) {
    drawn::Plate plate;
    plate.from_slope = slope;
    PlateView view = drawn::view_of(plate, {});
    view.begin = 8;
    const EndBounds bounds = bounds_of(view, SeamSide::kBegin, 0, kPitch);
    INFO("slope " << slope);
    CHECK(bounds.least <= 0);
    CHECK(bounds.most >= 0);
  }
}

TEST_CASE("a plate goes on behind what lies across it") {
  drawn::Scan scan;
  scan.cover = [](double crossing) {
    return crossing > 40 && crossing < 60 ? Cover::kBefore : Cover::kNothing;
  };
  const EndBounds bounds = at_start({}, scan, 60);
  CHECK(bounds.least > 56);
  CHECK(bounds.least <= 60);
  CHECK(bounds.most >= 60);
  CHECK(bounds.most < 65);
}

TEST_CASE("a neighbour behind a gap is another plate") {
  drawn::Plate plate;
  PlateView view = drawn::view_of(plate, {});
  for (StripeOnPlate& stripe : view.stripes)
    if (stripe.crossing < -15) {
      for (Place& place : stripe.places) place.look = Look::kOn;
      stripe.at_seam = AtSeam::kOn;
    }
  const EndBounds bounds = bounds_of(view, SeamSide::kBegin, 0, kPitch);
  CHECK(bounds.most >= 0);
  CHECK(bounds.most < 2);
}

TEST_CASE("dark beyond a plate is its own shadow, where that reaches so far") {
  // What lies 10 mm behind is dark for 4 mm: one stripe.
  drawn::Scan shadow;
  shadow.cover = [](double crossing) {
    return crossing < 0 && crossing > -4 ? Cover::kDark : Cover::kNothing;
  };
  const EndBounds own = at_start({}, shadow);
  CHECK(own.least <= 0);
  CHECK(own.most >= 0);
  CHECK(own.most < 4.5);
  // Four stripes are hidden by something else: the plate may reach through all of them.
  drawn::Scan hidden;
  hidden.cover = [](double crossing) {
    return crossing < 0 && crossing > -15 ? Cover::kDark : Cover::kNothing;
  };
  CHECK(at_start({}, hidden).most > 12);
}

TEST_CASE("a shadow beside which something stands before the plates may be that thing's") {
  const auto covered_at = [](double from, double to) {
    drawn::Scan shadow;
    shadow.lean = 0;  // no stripe crosses the edge: the dark one alone bounds it
    shadow.cover = [](double crossing) {
      return crossing < 0 && crossing > -4 ? Cover::kDark : Cover::kNothing;
    };
    PlateView view = drawn::view_of({}, shadow);
    for (StripeOnPlate& stripe : view.stripes)
      stripe.covered = stripe.crossing > from && stripe.crossing < to;
    return bounds_of(view, SeamSide::kBegin, 0, kPitch);
  };
  // At -2.9 it is dark, at -6.5 what lies behind the plate is seen.
  // The edge may be cut at a slant, to 31 degrees.
  CHECK(covered_at(60, 80).most > 2.9);
  CHECK(covered_at(60, 80).most < 4.5);
  CHECK(covered_at(-4, 0).most > 6.5);
  CHECK(covered_at(-4, 0).most < 8.1);
}

TEST_CASE("a lone stripe through a hole beside what hides the plate does not end it") {
  // At -2.9 a hole beside the seam, then 40 mm under a tool.
  drawn::Scan scan;
  scan.cover = [](double crossing) {
    return crossing < -4 && crossing > -38 ? Cover::kBefore : Cover::kNothing;
  };
  drawn::Plate plate;
  plate.from = -30;
  PlateView view = drawn::view_of(plate, scan);
  for (StripeOnPlate& stripe : view.stripes) {
    if (stripe.crossing < -4 || stripe.crossing > 0) continue;
    for (Place& place : stripe.places) place.look = Look::kThrough;
    stripe.at_seam = AtSeam::kOff;
  }
  const EndBounds bounds = bounds_of(view, SeamSide::kBegin, 0, kPitch);
  CHECK(bounds.anchored);
  CHECK(bounds.most > 30);
}

TEST_CASE("where a plate is seen on no two stripes nothing is known of its end") {
  drawn::Scan scan;
  scan.cover = [](double crossing) { return crossing < 60 ? Cover::kBefore : Cover::kNothing; };
  drawn::Plate plate;
  plate.to = 62;
  CHECK_FALSE(at_start(plate, scan).anchored);
}

TEST_CASE("the seam ends where the first of its plates does") {
  EndBounds a, b;
  a.anchored = b.anchored = true;
  a.least = -1, a.most = 2, b.least = 3;  // b may end anywhere beyond
  const EndBounds both = first_of(a, b);
  CHECK(both.least == -1);
  CHECK(both.most == 2);
  b.anchored = false;
  CHECK_FALSE(first_of(a, b).anchored);
}
