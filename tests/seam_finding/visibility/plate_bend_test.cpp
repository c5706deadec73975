#include "services/seam_finding/visibility/plate_bend.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "services/seam_finding/visibility/plate_stripes.hpp"
#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kLength = 160, kNoise = 0.03;  // mm
const Line kSeam{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
const Scales kScales = scales_of_test(4, 0.4, kNoise);

// A plate along the x axis, 40 mm wide, an arc of so much sagitta over its length; over a table 6
// mm lower that goes on beyond it. Its plane is fitted to what lies within the tolerance of z = 0.
struct Bent {
  ScanCloud cloud;
  std::array<JointPlate, 2> plates;
};

double height_at(double sagitta, double x) {
  return -4 * sagitta * std::pow((x - kLength / 2) / kLength, 2);
}

Bent bent(double sagitta) {
  std::mt19937 engine(5);
  std::normal_distribution<double> noise(0, kNoise);
  Bent made;
  made.plates[0].plane = {Eigen::Vector3d::UnitZ(), 0};
  made.plates[1].plane = {Eigen::Vector3d::UnitY(), 0};
  int stripe = 0;
  for (double x = -20; x < kLength + 20; x += 4, ++stripe) {
    for (double y = 1; y < 60; y += 1.5) {
      const bool plate = x >= 0 && x <= kLength && y < 40;
      const double z = plate ? height_at(sagitta, x) : -6;
      if (std::abs(z) < kScales.tolerance) made.plates[0].points.push_back(made.cloud.size());
      made.cloud.points.emplace_back(x, y, z + noise(engine));
      made.cloud.origins.push_back({stripe, 0, y == 1, 0, 0.1f});
    }
    end_stripe(made.cloud, ScanStripe::Seen::kSeen, {x, 20, 300}, {x, 0, 300});
  }
  return made;
}

}  // namespace

TEST_CASE("a plate's bend is followed to its ends, where it has left its plane") {
  for (const double sagitta : {1.0, 1.6, -1.2}) {
    const Bent made = bent(sagitta);
    const PlateBend bend = plate_bend(made.cloud, made.plates[0], kSeam, {0, 1, 0}, kScales);
    INFO(sagitta);
    REQUIRE(bend.bent());
    for (const double x : {0.0, 40.0, 80.0, 120.0, 160.0})
      CHECK(bend.at(x) == Approx(height_at(sagitta, x)).margin(0.1));
    for (const double x : {0.0, 80.0, 160.0}) {
      CHECK(bend.slope_at(x) == Approx((bend.at(x + 1) - bend.at(x - 1)) / 2).margin(1e-9));
      CHECK(bend.times(-2).slope_at(x) == Approx(-2 * bend.slope_at(x)));
    }
    const auto stripes = plate_stripes(made.cloud, made.plates[0], made.plates[1], kSeam, kScales);
    for (std::size_t k = 0; k < made.cloud.stripes.size(); ++k) {
      const double x = -20 + 4.0 * static_cast<double>(k);
      CHECK(stripes.runs[k].empty() == (x < 0 || x > kLength));
    }
  }
}

TEST_CASE("a flat plate has no bend") {
  const Bent made = bent(0);
  CHECK_FALSE(plate_bend(made.cloud, made.plates[0], kSeam, {0, 1, 0}, kScales).bent());
}

TEST_CASE("few points tell no bend") {
  Bent made = bent(1.5);
  made.cloud.points.resize(30);
  made.cloud.origins.resize(30);
  CHECK_FALSE(plate_bend(made.cloud, made.plates[0], kSeam, {0, 1, 0}, kScales).bent());
}
