#include "services/seam_finding/referee/plate_looks.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/referee/end_bounds.hpp"
#include "services/seam_finding/referee/examination.hpp"
#include "services/seam_finding/referee/stripe_light.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kSeam = 100;  // mm

// One stripe every 3.6 mm, a place at each distance from the seam.
PlateView view_of(const std::vector<double>& aways, double (*height)(double along, double away)) {
  PlateView view;
  for (double crossing = -30; crossing < 130; crossing += 3.6) {
    StripeOnPlate stripe;
    stripe.crossing = crossing;
    for (const double away : aways) {
      Place place;
      place.along = crossing, place.away = away, place.height = height(crossing, away);
      place.point = static_cast<int>(stripe.places.size());
      stripe.places.push_back(place);
    }
    view.stripes.push_back(stripe);
  }
  return view;
}

std::vector<double> every(double step) {
  std::vector<double> aways;
  for (double away = 0.3; away < 30; away += step) aways.push_back(away);
  return aways;
}

PlateView looked_at(PlateView view) {
  set_looks(shape_of(view, kSeam), kSeam, view);
  return view;
}

}  // namespace

TEST_CASE("a plate that is bent by 1 mm in 100 is followed beyond the claimed ends") {
  const auto bent = [](double along, double) {
    const double x = along - 50;
    return x * x / 2500;  // 1 mm at the ends, 2.6 mm at the last stripe
  };
  const PlateView view = looked_at(view_of(every(1), bent));
  for (const StripeOnPlate& stripe : view.stripes) {
    INFO("at " << stripe.crossing);
    CHECK(stripe.at_seam == AtSeam::kOn);
  }
}

TEST_CASE("places that stand far apart tell as much as near ones") {
  const auto flat = [](double, double) { return 0.0; };
  for (const double step : {0.5, 2.0, 6.0}) {
    const PlateView view = looked_at(view_of(every(step), flat));
    INFO("a place every " << step << " mm");
    CHECK(view.width > 20);
    for (const StripeOnPlate& stripe : view.stripes) CHECK(stripe.at_seam == AtSeam::kOn);
    for (std::size_t i = 1; i < view.stripes[3].places.size(); ++i)
      CHECK(view.stripes[3].places[i].away - view.stripes[3].places[i - 1].away < 2.01);
  }
}

TEST_CASE("the flank of what stands on a plate is not the plate, though it passes its height") {
  const auto tool = [](double, double away) {
    return away < 10 ? 0.0 : away < 14 ? 12.0 : away < 15 ? 0.1 : -20.0;
  };
  const PlateView view = looked_at(view_of(every(1), tool));
  for (const StripeOnPlate& stripe : view.stripes)
    for (const Place& place : stripe.places)
      if (place.away > 10) CHECK(place.look != Look::kOn);
}

namespace {

SeamResult claim_of(const synthetic::Scene& scene) {
  SeamResult seam;
  seam.verdict = SeamResult::Verdict::kFound;
  seam.start = scene.start, seam.end = scene.end;
  seam.direction = (scene.end - scene.start).normalized();
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector3d &own = scene.normals[j], &other = scene.normals[1 - j];
    seam.faces[j].plane = {own, -own.dot(scene.start)};
    seam.faces[j].away = (other - other.dot(own) * own).normalized();
  }
  return seam;
}

// Without what lies on the plate up to so far from the seam; mm.
ScanCloud without_foot(const ScanCloud& cloud, const SeamResult& seam, int plate, double reach) {
  const SeamPlate& face = seam.faces[plate];
  ScanCloud left;
  for (const ScanStripe& stripe : cloud.stripes) {
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
      const double away = face.away.dot(cloud.points[i] - seam.start);
      const double off = std::abs(face.plane.signed_distance(cloud.points[i]));
      if (off < 0.5 && away > 0.5 && away < reach) continue;
      left.points.push_back(cloud.points[i]), left.origins.push_back(cloud.origins[i]);
    }
    end_stripe(left, stripe.seen, stripe.camera_centre, stripe.tool_position, stripe.tool_turn);
  }
  return left;
}

}  // namespace

TEST_CASE("a plate begins behind its gap") {
  for (const double gap : {0.0, 2.5}) {
    const synthetic::Scene scene = synthetic::make_scene({.root_gap = gap}, 351);
    const ScanCloud cloud = synthetic::make_scan(scene, {}, 351).cloud;
    const double begin = examine(cloud, claim_of(scene)).views[1].begin;
    INFO("gap of " << gap);
    CHECK(begin >= gap);
    CHECK(begin < gap + 3.5);  // the places' step on an upright
    CHECK((begin == 0) == (gap == 0));
  }
}

TEST_CASE("the other plate beside the seam is no begin of one that shows farther off") {
  const synthetic::Scene scene = synthetic::make_scene({}, 351);
  const SeamResult seam = claim_of(scene);
  const ScanCloud cloud = synthetic::make_scan(scene, {.downsample = 3}, 351).cloud;
  for (const double radius : {0.0, 6.0, 12.0}) {
    const double begin = examine(without_foot(cloud, seam, 1, radius), seam).views[1].begin;
    INFO("radius of " << radius);
    CHECK(begin >= radius);
    CHECK(begin < radius + 2);
  }
}

TEST_CASE("the sheet of light turns with the tool") {
  // A sheet that stands across the tool's way, leaning, whatever way the tool is turned.
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 0.1, 0.4).normalized();
  ScanCloud cloud;
  for (int k = 0; k < 20; ++k) {
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(0.03 * k, Eigen::Vector3d(0.2, 1, 0.5).normalized()));
    const Eigen::Vector3d tool(3.6 * k, 2, 300);
    for (int i = 0; i < 40; ++i) {
      Eigen::Vector3d in_tool(0, i - 20, -280 + 7 * (i % 3));
      in_tool -= normal.dot(in_tool) / normal.x() * Eigen::Vector3d::UnitX();
      cloud.points.push_back(turn * in_tool + tool);
      cloud.origins.push_back({k, 0, false, 0, 0});
    }
    end_stripe(cloud, ScanStripe::Seen::kSeen, turn * Eigen::Vector3d(-90, 0, -20) + tool, tool,
               turn);
  }
  const auto lights = light_of(cloud);
  REQUIRE(lights.size() == cloud.stripes.size());
  for (std::size_t k = 0; k < lights.size(); ++k) {
    REQUIRE(lights[k]);
    const ScanStripe& stripe = cloud.stripes[k];
    CHECK(std::abs((stripe.tool_turn * normal).dot(lights[k]->plane.normal)) ==
          Approx(1).margin(1e-9));
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i)
      CHECK(std::abs(lights[k]->plane.signed_distance(cloud.points[i])) < 1e-6);
    CHECK(std::abs(lights[k]->plane.signed_distance(lights[k]->source)) < 1e-9);
  }
}
