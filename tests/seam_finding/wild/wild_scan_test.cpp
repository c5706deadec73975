#include "tests/seam_finding/support/wild_scan.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "tests/seam_finding/wild/plain_scene.hpp"

namespace arcstart::seam_finding::synthetic {
namespace {

using namespace cell_simulator;
using Eigen::Vector3d;

// Of a scan without noise: bends stay sharp.
WildScanChoice exact() {
  WildScanChoice choice;
  choice.downsample = 1;
  choice.end_noise_px = choice.noise_factor = 0;
  choice.bend_blur_px = 1e-3;
  return choice;
}

template <class Visit>
void for_each_point(const WildScan& scan, Visit&& visit) {
  for (std::size_t k = 0; k < scan.profiles.size(); ++k)
    for (int i = 0; i < scan.profiles[k].count; ++i) {
      const profile_t& p = scan.profiles[k];
      visit(Vector3d(p.x[i], p.y[i], p.z[i]), scan.objects[k][i], p, i);
    }
}

// Off the plates of plain_tee(): the base plate's top and sides, the upright's faces.
double off_plate(const Vector3d& p, int object) {
  if (object == 1)
    return std::min({std::abs(p.z() - 10), std::abs(p.y() + 50), std::abs(p.y() - 40),
                     std::abs(p.x() - 880), std::abs(p.x() - 1020)});
  return std::min({std::abs(p.y()), std::abs(p.y() - 8), std::abs(p.z() - 50),
                   std::abs(p.x() - 900), std::abs(p.x() - 1000)});
}

}  // namespace

TEST_CASE("Without noise every point of a scan lies on the plate that it is said to lie on") {
  const WildScan scan = wild_scan(plain_tee(), SceneKind::workpiece, exact());
  int on_plates[3] = {0, 0, 0};
  for_each_point(scan, [&](const Vector3d& p, int object, const profile_t&, int) {
    REQUIRE(object >= 0);
    REQUIRE(object <= 2);
    ++on_plates[object];
    // Single precision and the distortion's inverse.
    const double off = object == 0 ? std::abs(p.z()) : off_plate(p, object);
    if (off > 0.01) CHECK(off < 0.01);
  });
  CHECK(on_plates[0] > 10000);
  CHECK(on_plates[1] > 5000);
  CHECK(on_plates[2] > 5000);
  REQUIRE(scan.profiles.size() == 50);  // 180 mm at 3.6 mm
  CHECK(scan.profiles[1].tool_position[0] - scan.profiles[0].tool_position[0] ==
        Approx(3.6).epsilon(1e-9));
}

TEST_CASE("Points scatter about their plate as their deviation says") {
  WildScanChoice choice;
  choice.downsample = 1;
  choice.end_noise_px = 0;
  const WildScan scan = wild_scan(plain_tee(), SceneKind::workpiece, choice);
  double squares = 0, expected = 0, sum = 0;
  int count = 0, far = 0;
  for_each_point(scan, [&](const Vector3d& p, int object, const profile_t& profile, int i) {
    // The base plate's top, off its edges and its corner with the upright.
    if (object != 1 || p.y() > -3 || p.y() < -47 || p.x() < 883 || p.x() > 1017) return;
    const double deviation = profile.deviation[i], off = p.z() - 10;
    far += std::abs(off) > 3 * deviation;
    squares += off * off;
    expected += deviation * deviation;
    sum += off;
    ++count;
  });
  REQUIRE(count > 5000);
  CHECK(std::abs(sum / count) < 4 * std::sqrt(squares) / count);
  CHECK(far <= 0.003 * count);
  // Across the stripe a point moves along the camera's ray within the sheet: its way out of the
  // plate is a part of it that the geometry gives, the same all over the plate.
  CHECK(squares < expected);
  CHECK(squares > 0.2 * expected);
}

TEST_CASE("The first and last points of a segment say where its light ends") {
  const WildScan scan = wild_scan(plain_tee(), SceneKind::workpiece, exact());
  // In the middle of the search the stripe crosses table, base plate's side and top, upright, and
  // the table behind.
  const profile_t& stripe = scan.profiles[25];
  int ends = 0;
  for (int i = 0; i < stripe.count; ++i) {
    const bool first = i == 0 || stripe.segment[i] != stripe.segment[i - 1];
    const bool last = i + 1 == stripe.count || stripe.segment[i] != stripe.segment[i + 1];
    CHECK((stripe.segment_end[i] != profile_t::CONTINUES) == (first || last));
    ends += first || last;
  }
  CHECK(ends >= 4);
  CHECK(stripe.segment_end[0] == profile_t::BORDER);
  // The upright's top edge over the open side bends, its far edge ends a segment.
  double highest = 0;
  for (int i = 0; i < stripe.count; ++i)
    if (stripe.segment_end[i] == profile_t::EDGE)
      highest = std::max(highest, static_cast<double>(stripe.z[i]));
  CHECK(highest == Approx(50).margin(0.01));
}

TEST_CASE("Down-sampling keeps every fifteenth, the last and the bends") {
  WildScanChoice every = exact(), some = exact();
  some.downsample = 15;
  const WildScan whole = wild_scan(plain_tee(), SceneKind::workpiece, every);
  const WildScan thin = wild_scan(plain_tee(), SceneKind::workpiece, some);
  for (std::size_t k = 0; k < whole.profiles.size(); ++k) {
    const profile_t &all = whole.profiles[k], &kept = thin.profiles[k];
    CHECK(kept.count < all.count / 10);
    CHECK(kept.count >= all.count / 15);
    // Each kept point is one of all, and between two kept ones of a segment lie at most 14.
    int at = 0, before = -1;
    for (int i = 0; i < kept.count; ++i) {
      while (at < all.count && (all.u[at] != kept.u[i] || all.v[at] != kept.v[i])) ++at;
      REQUIRE(at < all.count);
      if (i > 0 && kept.segment[i] == kept.segment[i - 1]) CHECK(at - before <= 15);
      before = at;
    }
  }
}

TEST_CASE("What stands before a plate hides it from the laser and the camera") {
  WildScene scene = plain_tee();
  const auto on_upright = [&](double from, double to) {
    int count = 0;
    for_each_point(wild_scan(scene, SceneKind::workpiece, exact()),
                   [&](const Vector3d& p, int object, const profile_t&, int) {
                     count += object == 2 && p.x() > from && p.x() < to && p.y() < 1 && p.z() < 30;
                   });
    return count;
  };
  CHECK(on_upright(930, 970) > 500);
  WildSolid wall;
  wall.size_mm = {100, 5, 100};
  wall.position_mm = {950, -20, 60};
  scene.solids = {wall};
  CHECK(on_upright(930, 970) == 0);
}

TEST_CASE("Calibration and positions that err move the points, not what is seen") {
  WildScene scene = plain_tee();
  const WildScan right = wild_scan(scene, SceneKind::workpiece, exact());
  scene.scan.robot_wave_mm = 0.3;
  const WildScan waved = wild_scan(scene, SceneKind::workpiece, exact());
  scene.scan.robot_wave_mm = 0;
  scene.scan.calibration_error = 1;
  const WildScan told = wild_scan(scene, SceneKind::workpiece, exact());
  REQUIRE(right.profiles.size() == waved.profiles.size());
  double waved_most = 0, told_most = 0;
  for (std::size_t k = 0; k < right.profiles.size(); ++k) {
    const profile_t &a = right.profiles[k], &b = waved.profiles[k], &c = told.profiles[k];
    CHECK(a.u == b.u);
    CHECK(a.v == c.v);
    for (int i = 0; i < a.count; ++i) {
      const Vector3d p(a.x[i], a.y[i], a.z[i]);
      waved_most = std::max(waved_most, (Vector3d(b.x[i], b.y[i], b.z[i]) - p).norm());
      told_most = std::max(told_most, (Vector3d(c.x[i], c.y[i], c.z[i]) - p).norm());
    }
  }
  CHECK(waved_most > 0.2);
  CHECK(waved_most < 0.3 * std::sqrt(3.0) + 1e-3);
  CHECK(told_most > 0.01);
  CHECK(told_most < 1);
}

TEST_CASE("A background scan shows the table alone, a spoilt scan has empty stripes") {
  WildScene scene = plain_tee();
  const WildScan background = wild_scan(scene, SceneKind::background, exact());
  CHECK(background.sights.empty());
  for_each_point(background, [&](const Vector3d& p, int object, const profile_t&, int) {
    if (object != 0 || std::abs(p.z()) > 0.01) CHECK(object == -2);
  });
  scene.events.spoilt_share = 1;
  int empty = 0;
  for (const profile_t& profile : wild_scan(scene, SceneKind::workpiece).profiles) {
    CHECK((profile.count == 0) == (profile.why == profile_t::NO_STRIPE));
    empty += profile.count == 0;
  }
  CHECK(empty > 10);
  CHECK(empty < 40);
}

TEST_CASE("The same scene gives the same scan") {
  const WildScene scene = draw_wild_scene("lap", 3);
  const WildScan one = wild_scan(scene, SceneKind::workpiece),
                 other = wild_scan(scene, SceneKind::workpiece);
  REQUIRE(one.profiles.size() == other.profiles.size());
  for (std::size_t k = 0; k < one.profiles.size(); ++k)
    CHECK(one.profiles[k].x == other.profiles[k].x);
}

}  // namespace arcstart::seam_finding::synthetic
