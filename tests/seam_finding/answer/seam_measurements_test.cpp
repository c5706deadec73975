#include "services/seam_finding/answer/seam_measurements.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// Two square plates, stripes every 2 mm of 100 mm; the corner is moved aside by bend(x), and a bead
// of 3 mm lies in it from 40 to 52 mm where wanted.
struct Made {
  ScanCloud cloud;
  std::array<JointPlate, 2> plates;
  Line line{{0, 0, 0}, {1, 0, 0}};
};
Made make(const std::function<double(double)>& bend, bool bead) {
  Made made;
  made.plates[0].plane = {Eigen::Vector3d::UnitZ(), 0};
  made.plates[1].plane = {Eigen::Vector3d::UnitY(), 0};
  for (double x = 1; x < 100; x += 2) {
    const int stripe = static_cast<int>(made.cloud.stripes.size());
    const auto add = [&](const Eigen::Vector3d& point, int plate) {
      if (plate >= 0) made.plates[plate].points.push_back(made.cloud.size());
      made.cloud.points.push_back(point);
      made.cloud.origins.push_back({stripe, 0, false, 0, 0.1f});
    };
    for (double r = 30; r > 1; r -= 1) add({x, r + bend(x), 0}, 0);
    if (bead && x > 40 && x < 52)
      for (double r = 0; r <= 3; r += 0.5) add({x, 3 - r + 1.2, r + 1.2}, -1);
    for (double r = 1; r < 30; r += 1) add({x, bend(x), r}, 1);
    end_stripe(made.cloud, ScanStripe::Seen::kSeen, {x, 200, 200}, {x, 0, 0});
  }
  return made;
}

Joint joint_of(const Made& made) {
  Joint joint;
  joint.plates = made.plates;
  joint.line = made.line;
  return joint;
}

}  // namespace

TEST_CASE("a straight seam is a line, and a tack weld on it is seen where it lies") {
  const Made made = make([](double) { return 0.0; }, true);
  const auto places = measure_seam(made.cloud, joint_of(made), 0, 100, 2);
  REQUIRE(places.size() == 50);
  for (const SeamMeasurement& place : places) {
    CHECK(place.tack == (place.along > 40 && place.along < 52));
    CHECK(place.residual == Approx(0).margin(1e-9));
  }
  const Polyline line = polyline_through(places, {0, 0, 0}, {100, 0, 0}, 0.5);
  CHECK(line.points.size() == 2);
  CHECK(line.deviation == Approx(0).margin(1e-9));
}

TEST_CASE("stripes of a work that shakes do not draw the seam aside") {
  // By half a millimetre, each otherwise; and the same beside a bow that is plainly there.
  const auto shake = [](double x) { return 0.5 * std::sin(7.3 * x * x); };
  const Made shaken = make(shake, false);
  const auto places = measure_seam(shaken.cloud, joint_of(shaken), 0, 100, 2);
  REQUIRE(places.size() == 50);
  for (const SeamMeasurement& place : places) {
    CHECK(std::abs(place.position.y()) < 1e-9);
    CHECK(place.residual == Approx(std::abs(shake(place.along))).margin(1e-6));
  }
  const auto bow = [&](double x) { return 2 * std::sin(M_PI * x / 100) + shake(x) / 5; };
  const Made bowed = make(bow, false);
  for (const SeamMeasurement& place : measure_seam(bowed.cloud, joint_of(bowed), 0, 100, 2))
    CHECK(place.position.y() == Approx(bow(place.along)).margin(1e-6));
}

TEST_CASE("a seam that bows is a polyline that follows it") {
  const auto bow = [](double x) { return 2 * std::sin(M_PI * x / 100); };
  const Made made = make(bow, false);
  const auto places = measure_seam(made.cloud, joint_of(made), 0, 100, 2);
  const Polyline line = polyline_through(places, {0, 0, 0}, {100, 0, 0}, 0.5);
  REQUIRE(line.points.size() == 50);
  for (std::size_t i = 1; i + 1 < line.points.size(); ++i)
    CHECK(line.points[i].y() == Approx(bow(line.points[i].x())).margin(0.01));
  CHECK(line.deviation < 0.02);
}
