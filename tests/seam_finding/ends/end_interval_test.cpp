#include "services/seam_finding/ends/end_interval.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

SeamEnd edge_at(double along, double deviation) {
  SeamEnd end;
  end.along = along, end.variance = deviation * deviation;
  return end;
}

}  // namespace

TEST_CASE("a plate that may be set flush ends about the other's edge, and no farther out") {
  // Far from both bounds: flush in 0.3 of all joints, else anywhere in 40 mm about the edge, of
  // which 2 mm lie inside it and 2 outside: by counting, 0.035 of 0.37 lie inside, in the middle
  // 1 mm before the edge, and all others leave the edge as the end.
  SeamEnd end = edge_at(12, 0.05);
  limit_by_interval(end, {10, 14}, 1);
  CHECK(end.along == Approx(12 - 0.035 / 0.37).margin(1e-6));
  CHECK(end.variance > 0.05 * 0.05);
  SeamEnd mirrored = edge_at(-12, 0.05);
  limit_by_interval(mirrored, {-10, -14}, -1);
  CHECK(mirrored.along == Approx(-end.along).margin(1e-9));
  CHECK(mirrored.variance == Approx(end.variance).margin(1e-12));
}

TEST_CASE("a stripe that shows nothing of a plate says that it is not flush with an edge there") {
  SeamEnd end = edge_at(12.95, 0.02);
  limit_by_interval(end, {10, 13}, 1);
  // Anywhere before the edge alike, but for the 0.05 mm behind it.
  CHECK(end.along == Approx((10 + 12.95) / 2).margin(0.05));
  CHECK(std::sqrt(end.variance) == Approx(2.95 / std::sqrt(12)).margin(0.05));
}

TEST_CASE("what is seen past a plate at the other's edge leaves it as likely flush as not") {
  SeamEnd end = edge_at(13, 0.02);
  EndInterval interval{10, 13};
  interval.seen_past = true;
  limit_by_interval(end, interval, 1);
  // Half of 0.3 for flush, against 3 of 40 mm of 0.7.
  const double inside = 0.7 * 3 / 40;
  CHECK(end.along == Approx(13 - 1.5 * inside / (inside + 0.15)).margin(1e-6));
}

TEST_CASE("an edge inside what is seen of the other plate is the end") {
  SeamEnd end = edge_at(9, 0.1);
  limit_by_interval(end, {10, 14}, 1);
  CHECK(end.along == 9);
  CHECK(end.variance == Approx(0.01));
}

TEST_CASE("what is seen on a plate and past it narrows where it ends, on either side") {
  for (const double outward : {1.0, -1.0}) {
    EndInterval interval{outward * 10, outward * 14};
    narrow(interval, {11, 12.5}, 1, 0, outward);
    CHECK(interval.inner == outward * 11);
    CHECK(interval.outer == outward * 12.5);
    // A stripe that shows the plate at the seam tells of it up to how early it may leave it.
    interval = {outward * 10, outward * 14};
    narrow(interval, {2, 12.5}, 1, 0, outward);
    CHECK(interval.inner == outward * 9);
    // Seen beyond the stripe that did not show it, and past nowhere: it runs on.
    CHECK(interval.seen_past);
    interval = {outward * 10, outward * 14};
    narrow(interval, {20}, 1, 0, outward);
    CHECK(interval.runs_on);
    interval = {outward * 10, outward * 14};
    narrow(interval, {20, 22}, 1, 0, outward);
    CHECK_FALSE(interval.runs_on);
    CHECK(interval.inner == outward * 20);
    CHECK(interval.outer == outward * 22);
  }
}

TEST_CASE("no end is known better than half the width of the light that tells it") {
  SeamEnd between;
  between_intervals(between, {EndInterval{10, 10}, EndInterval{10, 40, true}}, 1);
  CHECK(between.along == 10);
  CHECK(std::sqrt(between.variance) == Approx(0.15));
  SeamEnd limited = edge_at(30, 0.05);
  limit_by_interval(limited, {10, 10.001}, 1);
  CHECK(limited.along == Approx(10).margin(0.01));
  CHECK(std::sqrt(limited.variance) == Approx(0.15).margin(0.01));
}

TEST_CASE("between brackets that bound nothing an end stays where it is") {
  const double far = std::numeric_limits<double>::infinity();
  for (const double outward : {1.0, -1.0})
    for (const EndInterval& interval :
         {EndInterval{10, 20, true}, EndInterval{outward * 10, outward * far, false}}) {
      SeamEnd end = edge_at(12, 0.5);
      between_intervals(end, {interval, interval}, outward);
      CHECK(end.along == 12);
      CHECK(end.variance == 0.25);
    }
}
