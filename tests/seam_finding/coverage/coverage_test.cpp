#include "services/seam_finding/coverage/coverage.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/paper/find_seam_as_in_the_paper.hpp"
#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kPitch = 3.6;

// Two exact plates on the x axis: one in z = 0 toward +y, one in y = 0 upward, seen in stripes that
// cross the axis at 0, 3.6, 7.2 ... and run aslant, x = crossing + slant * distance.
struct Bench {
  double slant = 0.3;
  double point_step = 1.9;
  std::array<double, 2> from = {20, 20}, to = {120, 120};  // of each plate along x
  std::vector<int> missing, empty;
  int stripes = 40;
  double phase = 0;

  ScanCloud cloud;
  std::array<JointPlate, 2> plates;
  Line line{{0, 0, 0}, {1, 0, 0}};

  Coverage run() {
    cloud = {};
    plates = {};
    plates[0].plane = {{0, 0, 1}, 0};
    plates[1].plane = {{0, 1, 0}, 0};
    for (int k = 0; k < stripes; ++k) {
      const double crossing = phase + k * kPitch;
      const Eigen::Vector3d tool(crossing, 0, 300);
      const auto is_in = [&](const std::vector<int>& list) {
        return std::find(list.begin(), list.end(), k) != list.end();
      };
      if (is_in(missing) || is_in(empty)) {
        end_stripe(cloud, is_in(missing) ? ScanStripe::Seen::kMissing : ScanStripe::Seen::kEmpty);
        continue;
      }
      for (int plate = 0; plate < 2; ++plate)
        for (double r = 0.3 + 0.7 * point_step * ((k * 7) % 10) / 10.0; r < 40; r += point_step) {
          const double x = crossing + slant * r;
          if (x < from[plate] || x > to[plate]) continue;
          cloud.points.push_back(plate == 0 ? Eigen::Vector3d(x, r, 0) : Eigen::Vector3d(x, 0, r));
          cloud.origins.push_back({k, plate, false, 0});
          plates[plate].points.push_back(cloud.size() - 1);
        }
      end_stripe(cloud, ScanStripe::Seen::kSeen, tool + Eigen::Vector3d(0, 200, 0), tool);
    }
    return find_coverage(cloud, plates, line, scales_of_test(kPitch, 0.5));
  }
};

// Half-way between the last stripe before the plate's edge and the first behind it.
double half_way(double edge, double phase = 0) {
  return phase + (std::ceil((edge - phase) / kPitch) - 0.5) * kPitch;
}

}  // namespace

TEST_CASE("the seam begins and ends where both plates do, to half a spacing") {
  Bench bench;
  const auto [slant, phase] = GENERATE(table<double, double>(
      {{0.0, 0.0}, {0.3, 0.7}, {-0.3, 1.9}, {0.6, 2.2}, {0.3, 3.1}, {-0.2, 0.4}}));
  bench.slant = slant;
  bench.phase = phase;
  const Coverage course = bench.run();
  INFO("slant " << slant << ", phase " << phase);
  // Points up to a step from the line stand for the crossing: the slant shifts them by so much.
  const double shift = std::abs(slant) * 3.5;
  CHECK(std::abs(course.begin - half_way(20, phase)) <= (shift > 0 ? kPitch : 1e-9) + 1e-9);
  CHECK(std::abs(course.begin - 20) <= kPitch / 2 + shift + 1e-9);
  CHECK(std::abs(course.end - 120) <= kPitch / 2 + shift + 1e-9);
  CHECK(course.covered == Approx(100).margin(kPitch + 2 * shift));
  CHECK(course.stripes >= 27);
  CHECK_FALSE(course.begins_outside);
  CHECK_FALSE(course.ends_outside);
  CHECK(course.missing_before == 0);
}

TEST_CASE("a plate that begins earlier or ends later is no seam") {
  Bench bench;
  bench.from = {20, 47};
  bench.to = {101, 130};
  Coverage course = bench.run();
  CHECK(std::abs(course.begin - 47) < 3);
  CHECK(std::abs(course.end - 101) < 3);
  bench.from = {47, 20};
  bench.to = {130, 101};
  course = bench.run();
  CHECK(std::abs(course.begin - 47) < 3);
  CHECK(std::abs(course.end - 101) < 3);
}

TEST_CASE("missing stripes before the start are told and widen the bracket") {
  Bench bench;
  bench.slant = 0;
  bench.missing = {5};  // crosses at 18.0; the plates begin at 20, stripe 6 crosses at 21.6
  Coverage course = bench.run();
  CHECK(course.missing_before == 1);
  CHECK(course.begin == Approx((4 * kPitch + 6 * kPitch) / 2));
  bench.missing = {3, 4, 5};
  course = bench.run();
  CHECK(course.missing_before == 3);
  bench.missing = {0, 1, 2, 3, 4, 5};
  course = bench.run();
  CHECK(course.begins_outside);
}

TEST_CASE("a stripe that was lost within the seam interrupts nothing") {
  Bench bench;
  bench.missing = {12, 13, 20};
  const Coverage course = bench.run();
  CHECK(std::abs(course.begin - 20) < 3);
  CHECK(std::abs(course.end - 120) < 3);
  CHECK(course.missing_before == 0);
}

TEST_CASE("images that showed nothing count as seen where there are three in a row") {
  Bench bench;
  bench.slant = 0;
  bench.empty = {0, 1, 2, 3, 4, 5};  // nothing lies before the plates
  Coverage course = bench.run();
  CHECK_FALSE(course.begins_outside);
  CHECK(course.missing_before == 0);
  CHECK(course.begin == Approx(5.5 * kPitch));
  bench.empty = {4, 5};
  course = bench.run();
  CHECK(course.missing_before == 2);
}

TEST_CASE("a seam that runs on where the scan begins or ends says so") {
  Bench bench;
  bench.from = {-50, -50};
  CHECK(bench.run().begins_outside);
  bench.from = {20, 20};
  bench.to = {500, 500};
  const Coverage course = bench.run();
  CHECK_FALSE(course.begins_outside);
  CHECK(course.ends_outside);
}

TEST_CASE("an interruption is bridged when short, and ends the seam when long") {
  Bench bench;
  bench.run();
  const auto without = [&](double low, double high) {
    auto plates = bench.plates;
    std::erase_if(plates[1].points, [&](int i) {
      return bench.cloud.points[i].x() > low && bench.cloud.points[i].x() < high;
    });
    return find_coverage(bench.cloud, plates, bench.line, scales_of_test(kPitch, 0.5));
  };
  Coverage course = without(60, 72);
  CHECK(std::abs(course.begin - 20) < 3);
  CHECK(std::abs(course.end - 120) < 3);
  CHECK(course.covered < 95);
  course = without(30, 70);
  CHECK(std::abs(course.begin - 70) < 4);
  CHECK(std::abs(course.end - 120) < 3);
}

TEST_CASE("points of a plate behind the other plate are no part of the seam") {
  Bench bench;
  bench.from = {60, 20};
  bench.run();
  // The base goes on behind the upright from 20 on.
  for (int k = 0; k < bench.stripes; ++k)
    for (double r = 2; r < 12; r += 1.9) {
      bench.cloud.points.push_back({k * kPitch - 0.3 * r, -r, 0});
      bench.cloud.origins.push_back({k, 2, false, 0});
      bench.plates[0].points.push_back(bench.cloud.size() - 1);
    }
  const Coverage course =
      find_coverage(bench.cloud, bench.plates, bench.line, scales_of_test(kPitch, 0.5));
  CHECK(std::abs(course.begin - 60) < 3);
}

TEST_CASE("points that may be either plate's do not make the other one") {
  Bench bench;
  bench.from = {20, 20};
  bench.run();
  std::array<JointPlate, 2> plates = bench.plates;
  // The upright begins at 20, the base at 60; before it the upright's lowest points lie in its
  // plane.
  std::erase_if(plates[0].points, [&](int i) { return bench.cloud.points[i].x() < 60; });
  for (const int i : bench.plates[1].points)
    if (bench.cloud.points[i].z() < 0.5) plates[0].points.push_back(i);
  std::sort(plates[0].points.begin(), plates[0].points.end());
  const Coverage course =
      find_coverage(bench.cloud, plates, bench.line, scales_of_test(kPitch, 0.5));
  CHECK(std::abs(course.begin - 60) < 3);
}

TEST_CASE("without stripes the course is where both plates leave no wide gap") {
  ScanCloud cloud;
  std::array<JointPlate, 2> plates;
  plates[0].plane = {{0, 0, 1}, 0};
  plates[1].plane = {{0, 1, 0}, 0};
  const auto add = [&](int plate, double low, double high) {
    for (double x = low; x < high; x += 1.5)
      for (double r = 0.8; r < 20; r += 1.5) {
        cloud.points.push_back(plate == 0 ? Eigen::Vector3d(x, r, 0) : Eigen::Vector3d(x, 0, r));
        cloud.origins.push_back({});
        plates[plate].points.push_back(cloud.size() - 1);
      }
  };
  add(0, 0, 100);
  add(1, 30, 85);
  const Coverage course =
      find_coverage(cloud, plates, {{0, 0, 0}, {1, 0, 0}}, scales_of_test(1.5, 0.5));
  CHECK(std::abs(course.begin - 30) < 2);
  CHECK(std::abs(course.end - 85) < 3);
  CHECK_FALSE(course.begins_outside);
}

TEST_CASE("centroid of the first points: of exact plates a known place") {
  Bench bench;
  bench.slant = 0;
  const Coverage course = bench.run();
  // Of the first stripe both plates have points within 6 mm: all of them lie at its crossing.
  const double first = std::ceil(20 / kPitch) * kPitch;
  CHECK(centroid_of_first(bench.cloud, bench.plates, bench.line, course, 4) == Approx(first));
  const double of_many = centroid_of_first(bench.cloud, bench.plates, bench.line, course, 12);
  CHECK(of_many > first);
  CHECK(of_many < first + 2 * kPitch);
}
