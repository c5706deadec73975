#include "services/seam_finding/planes/stripe_planes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

const Plane kBase{Eigen::Vector3d::UnitZ(), 0}, kUpright{Eigen::Vector3d::UnitY(), 0};

// Stripes every 4 mm, at a slant, down an upright 20 mm high in y = 0 and over a base plate 40 mm
// wide in z = 0; points a millimetre apart, one at the corner.
ScanCloud tee(int stripes) {
  ScanCloud cloud;
  for (int k = 0; k < stripes; ++k) {
    const auto add = [&](double y, double z, bool end) {
      cloud.points.emplace_back(4 * k + 0.3 * y - 0.2 * z, y, z);
      cloud.origins.push_back({k, 0, end, 0, 0});
    };
    for (int z = 20; z > 0; --z) add(0, z, z == 20);
    for (int y = 0; y <= 40; ++y) add(y, 0, y == 40);
    end_stripe(cloud, ScanStripe::Seen::kSeen);
  }
  return cloud;
}

std::vector<int> all_of(const ScanCloud& cloud) {
  std::vector<int> all(cloud.points.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void check_same(const Plane& found, const Plane& truth) {
  const double side = found.normal.dot(truth.normal) < 0 ? -1 : 1;
  CHECK((side * found.normal - truth.normal).norm() < 1e-9);
  CHECK(side * found.offset == Approx(truth.offset).margin(1e-9));
}

}  // namespace

TEST_CASE("stripes suggest the planes that they lie on, the one with the most points first") {
  const ScanCloud cloud = tee(12);
  const auto planes = planes_of_stripes(cloud, all_of(cloud), {});
  REQUIRE(planes.size() == 2);
  check_same(planes[0], kBase);
  check_same(planes[1], kUpright);

  PlaneSearch one;
  one.hypotheses = 1;
  REQUIRE(planes_of_stripes(cloud, all_of(cloud), one).size() == 1);
  PlaneSearch upright;
  upright.accept = [](const Plane& plane) { return std::abs(plane.normal.y()) > 0.9; };
  const auto accepted = planes_of_stripes(cloud, all_of(cloud), upright);
  REQUIRE(accepted.size() == 1);
  check_same(accepted[0], kUpright);
}

TEST_CASE("single points that are left out, and single stripes, part no suggested plane") {
  const ScanCloud cloud = tee(12);
  std::vector<int> some;
  for (int i = 0; i < cloud.size(); ++i)
    if (i % 7 != 3 && cloud.origins[i].stripe != 5 && cloud.origins[i].stripe != 8)
      some.push_back(i);
  const auto planes = planes_of_stripes(cloud, some, {});
  REQUIRE(planes.size() == 2);
  check_same(planes[0], kBase);
  check_same(planes[1], kUpright);
}

TEST_CASE("plates beside each other at two heights are two planes") {
  ScanCloud cloud = tee(6);
  for (Eigen::Vector3d& point : cloud.points)
    if (point.z() == 0 && point.y() >= 25) point.z() = 6;
  const auto planes = planes_of_stripes(cloud, all_of(cloud), {});
  REQUIRE(planes.size() == 3);
  check_same(planes[0], kBase);              // 25 points a stripe
  check_same(planes[1], kUpright);           // 21
  check_same(planes[2], {{0, 0, 1}, -6.0});  // 16
}

TEST_CASE("two stripes suggest nothing, nor do stripes far apart, nor a cloud without stripes") {
  const ScanCloud two = tee(2), many = tee(16);
  CHECK(planes_of_stripes(two, all_of(two), {}).empty());
  CHECK(planes_of_stripes(two, {}, {}).empty());
  std::vector<int> every_fifth;
  for (int i = 0; i < many.size(); ++i)
    if (many.origins[i].stripe % 5 == 0) every_fifth.push_back(i);
  CHECK(planes_of_stripes(many, every_fifth, {}).empty());
  const ScanCloud loose = unorganised_cloud(many.points);
  CHECK(planes_of_stripes(loose, all_of(loose), {}).empty());
}
