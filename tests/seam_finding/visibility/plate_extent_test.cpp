#include "services/seam_finding/visibility/plate_extent.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// A base plate from x = 0 on, 50 mm wide from the seam (the x axis) on, over a table 10 mm lower.
// Stripes every 4 mm from `first` on, at a slope of `slant` mm along the seam for each mm away from
// it, all the way or nothing on the plate as x says at each point; seen from straight above.
ScanCloud scan_of(double first, double slant, double table_shift) {
  ScanCloud cloud;
  for (int k = 0; k < 20; ++k) {
    const double at = first + 4 * k;
    for (int i = 1; i <= 30; ++i) {
      const double r = 2 * i, x = at + slant * r;
      const bool plate = x >= 0 && r <= 50;
      // The sheet is tilted: on the table, the stripe lies so much farther on; what lies under the
      // plate is not seen.
      if (!plate && r <= 50 && x + table_shift >= 0) continue;
      cloud.points.push_back(plate ? Eigen::Vector3d(x, r, 0)
                                   : Eigen::Vector3d(x + table_shift, r, -10));
      cloud.origins.push_back({k, 0, false, 0.05f, 0.1f});
    }
    const bool any = cloud.origins.back().stripe == k;
    end_stripe(cloud, any ? ScanStripe::Seen::kSeen : ScanStripe::Seen::kEmpty, {at, 25, 1e6},
               {at, 0, 300});
  }
  return cloud;
}

std::array<JointPlate, 2> plates_of(const ScanCloud& cloud) {
  std::array<JointPlate, 2> plates;
  plates[0].plane = {Eigen::Vector3d::UnitZ(), 0};
  plates[1].plane = {Eigen::Vector3d::UnitY(), 0};
  for (int i = 0; i < cloud.size(); ++i)
    if (std::abs(cloud.points[i].z()) < 0.5) plates[0].points.push_back(i);
  return plates;
}

const Line kSeam{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
const Scales kScales = scales_of_test(2, 0.5, 0);

PlateExtent extent_of(const ScanCloud& cloud) {
  const auto plates = plates_of(cloud);
  return plate_extent(cloud, plate_stripes(cloud, plates[0], plates[1], kSeam, kScales),
                      SeamSide::kBegin, 0, 0, kScales);
}

}  // namespace

TEST_CASE("a stripe shows how far a plate reaches at its farthest place") {
  const ScanCloud cloud = scan_of(-18.5, -0.03, 0);
  const PlateExtent extent = extent_of(cloud);
  // Of the stripe that crosses at 1.5: x = 0 at its end 50 mm away, less for how square it is cut.
  CHECK(extent.on <= 0);
  CHECK(extent.on > -0.8);
  CHECK(extent.past >= 0);
}

TEST_CASE("the table is seen past a plate") {
  for (const double first : {-19.5, -18.5, -17.5, -16.5}) {
    const PlateExtent extent = extent_of(scan_of(first, 0.0, 2.5));
    // Square to the seam: the first stripe on the plate, and the last that falls beside it.
    double on = 1e9, past = -1e9;
    for (int k = 0; k < 20; ++k) {
      const double x = first + 4 * k;
      if (x >= 0) on = std::min(on, x);
      if (x + 2.5 < 0) past = std::max(past, x + 2.5);
    }
    CHECK(-extent.on == Approx(on).margin(0.5));
    CHECK(-extent.past == Approx(past).margin(0.5));
    CHECK(extent.on <= 0);
    CHECK(extent.past >= 0);
  }
}

TEST_CASE("a lone point behind a plate, and a lone one in its plane, tell nothing") {
  ScanCloud cloud = scan_of(-18.5, 0, 2.5);
  const PlateExtent clean = extent_of(cloud);
  const auto in_stripe = [&](int stripe, double r) {
    for (int i = 0; i < cloud.size(); ++i)
      if (cloud.origins[i].stripe == stripe && std::abs(cloud.points[i].y() - r) < 0.1) return i;
    return -1;
  };
  cloud.points[in_stripe(8, 24)].z() = -15;  // of the plate
  cloud.points[in_stripe(1, 24)].z() = 0;    // of the table
  const PlateExtent spoilt = extent_of(cloud);
  CHECK(spoilt.on == clean.on);
  CHECK(spoilt.past == clean.past);
}

TEST_CASE("what lies as high as a plate beyond its far edge is no part of it") {
  ScanCloud cloud = scan_of(-18.5, 0, 2.5);
  const PlateExtent clean = extent_of(cloud);
  // From 54 mm on, the table of two stripes before the plate's begin is a thing as high as it.
  for (int i = 0; i < cloud.size(); ++i)
    if (cloud.points[i].y() > 53 && cloud.origins[i].stripe < 6) cloud.points[i].z() = 0;
  const PlateExtent beside = extent_of(cloud);
  CHECK(beside.past == clean.past);
}

TEST_CASE("a line that runs through a plate's plane beyond it is no part of the plate") {
  ScanCloud cloud = scan_of(-17.5, 0, 2.5);
  const PlateExtent clean = extent_of(cloud);
  // Of a stripe before the plate's begin: a reflection that rises by 0.1 mm for each mm.
  for (int i = 0; i < cloud.size(); ++i)
    if (cloud.origins[i].stripe == 3) cloud.points[i].z() = 0.12 * (cloud.points[i].y() - 30);
  const PlateExtent crossed = extent_of(cloud);
  CHECK(crossed.on == clean.on);
}

TEST_CASE("light that falls past a plate bounds it, whatever else lies in its plane") {
  // Stripes square to the seam over a plate from 0 to 50 mm away; a thing as high touches its begin
  // from 36 mm away on, 7 mm long. The light runs on under the plane and away from the plate, so
  // that what is seen past it is seen 8 mm from where the light falls past.
  ScanCloud cloud = scan_of(-18.5, 0, -8);
  StripeCrossings crossings;
  for (int k = 0; k < 20; ++k) crossings.along.push_back(-18.5 + 4 * k);
  for (int i = 0; i < cloud.size(); ++i)
    if (cloud.points[i].y() > 35 && cloud.points[i].z() < 0 && cloud.points[i].x() > -15)
      cloud.points[i] = {cloud.points[i].x() + 8, cloud.points[i].y(), 0};
  const auto plates = plates_of(cloud);
  const auto stripes = plate_stripes(cloud, plates[0], plates[1], kSeam, kScales);
  const double on = seen_on_plate(cloud, stripes, SeamSide::kBegin, 0, 0, kScales, crossings);
  // The stripe at 1.5 is the first on the plate, the one at -2.5 the last that falls past it.
  CHECK(on < 2.5);
  CHECK(on > -2.5);
  CHECK(seen_on_plate(cloud, stripes, SeamSide::kBegin, 0, 0, kScales) > 6);
}

TEST_CASE("without stripes nothing is known") {
  const PlateExtent extent = extent_of(unorganised_cloud({{1, 2, 0}, {2, 3, 0}}));
  CHECK(extent.on < -1e9);
  CHECK(extent.past > 1e9);
}
