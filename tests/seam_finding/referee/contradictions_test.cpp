#include "services/seam_finding/referee/contradictions.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "common/geometry.hpp"
#include "services/seam_finding/referee/plate_looks.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

using Code = Reason::Code;
using Height = std::function<double(double away)>;  // over the claimed plane; mm

constexpr double kLength = 100, kPitch = 3.6;
constexpr double kDeep = -8;  // what is seen where there is no plate

// On every stripe the same.
PlateView view_of(const Height& height, double inset = 0) {
  PlateView view;
  view.plate.away = Eigen::Vector3d::UnitY();
  view.plate.inset = view.begin = inset;
  for (double crossing = -10; crossing < 110; crossing += kPitch) {
    StripeOnPlate stripe;
    stripe.stripe = static_cast<int>(view.stripes.size());
    stripe.crossing = crossing, stripe.shadow = 0.4;
    for (double away = -4.7; away < 40; away += 0.5) {
      Place place;
      place.along = crossing, place.away = away, place.height = height(away);
      place.point = static_cast<int>(stripe.places.size());
      stripe.places.push_back(place);
    }
    view.stripes.push_back(stripe);
  }
  return view;
}

double flat(double away) { return away < 0 ? kDeep : 0; }

SeamResult claim(const std::string& joint) {
  SeamResult seam;
  seam.joint_type = joint;
  seam.end = kLength * Eigen::Vector3d::UnitX();
  return seam;
}

struct Judged {
  Reason reason;
  std::array<std::optional<SeamEdges>, 2> edges;
  std::array<PlateView, 2> views;
};
Judged judged(const std::string& joint, PlateView first, PlateView second) {
  Judged result;
  result.views = {std::move(first), std::move(second)};
  std::array<PlateShape, 2> shapes;
  for (int j = 0; j < 2; ++j) {
    shapes[j] = shape_of(result.views[j], kLength);
    set_looks(shapes[j], kLength, result.views[j]);
    if (!end_at_seam(claim(joint))[j]) continue;
    result.edges[j] = edges_of(result.views[j], kLength);
    leave_out_across(*result.edges[j], result.views[j]);
  }
  result.reason = contradiction_of(claim(joint), result.views, shapes, result.edges, kPitch);
  return result;
}

Code code_of(const Height& second) {
  return judged("tee", view_of(flat), view_of(second)).reason.code;
}

}  // namespace

TEST_CASE("two plates as they are claimed are not contradicted") {
  CHECK(code_of(flat) == Code::kNone);
  CHECK(code_of([](double away) { return away < 0 ? kDeep : 0.2; }) == Code::kNone);  // robot
}

TEST_CASE("a plate that is turned, round, narrow or not there contradicts the seam") {
  const auto plate = [](const Height& height) {
    return [=](double away) { return away < 0 ? kDeep : height(away); };
  };
  CHECK(code_of(plate([](double away) { return away * std::tan(kDegree); })) == Code::kPlateTurned);
  CHECK(code_of(plate([](double away) { return away * std::tan(0.3 * kDegree); })) == Code::kNone);
  // A round bar of 12 mm radius whose flank touches the plane 8 mm from the seam.
  CHECK(code_of([](double away) {
          const double off = away - 8;
          return std::abs(off) < 12 ? std::sqrt(144 - off * off) - 12 : kDeep;
        }) == Code::kPlateRound);
  CHECK(code_of(plate([](double away) { return away < 4.5 ? 0 : kDeep; })) ==
        Code::kPlateTooNarrow);
  CHECK(code_of([](double) { return kDeep; }) == Code::kPlateNotShown);
}

TEST_CASE("between plates side by side the stripes must leave them") {
  const Height gap = [](double away) { return std::abs(away) < 1 ? kDeep : 0; };
  const Judged butt = judged("butt", view_of(gap, 1), view_of(gap, 1));
  CHECK(butt.reason.code == Code::kNone);
  REQUIRE(butt.edges[0]);
  CHECK(butt.edges[0]->leaving == butt.edges[0]->stripes);
  CHECK(butt.edges[0]->known);
  CHECK(butt.edges[0]->at_start == Approx(0).margin(0.5));  // the places' step

  const Height whole = [](double) { return 0.0; };
  CHECK(judged("butt", view_of(whole, 1), view_of(whole, 1)).reason.code == Code::kNoEdgeAtSeam);
  CHECK(judged("tee", view_of(whole), view_of(whole)).reason.code == Code::kNone);
}

TEST_CASE("a stripe that runs on across is of no seam where all others leave the plates there") {
  const Height gap = [](double away) { return std::abs(away) < 1 ? kDeep : 0; };
  const Height whole = [](double) { return 0.0; };
  PlateView view = view_of(gap, 1);
  const PlateView tab = view_of(whole, 1);
  for (std::size_t k = 0; k < 3; ++k) view.stripes[k] = tab.stripes[k];
  const Judged butt = judged("butt", view, view);
  for (std::size_t k = 0; k < 6; ++k) {
    INFO("stripe " << k);
    CHECK(butt.views[0].stripes[k].at_seam == (k < 3 ? AtSeam::kOff : AtSeam::kOn));
  }
}

TEST_CASE("a stripe that a shadow cuts off beside the seam does not run on across it") {
  const Height gap = [](double away) { return std::abs(away) < 1 ? kDeep : 0; };
  PlateView view = view_of(gap, 1);
  for (std::size_t k = 0; k < 3; ++k)
    std::erase_if(view.stripes[k].places, [](const Place& place) { return place.away < 1.6; });
  const Judged butt = judged("butt", view, view);
  for (std::size_t k = 0; k < 3; ++k) CHECK(butt.views[0].stripes[k].at_seam == AtSeam::kOn);
}

TEST_CASE("a seam along which one of the plates is missing is contradicted") {
  PlateView second = view_of(flat);
  const PlateView none = view_of([](double) { return kDeep; });
  for (std::size_t k = 0; k < second.stripes.size(); ++k)
    if (k % 2 == 0) second.stripes[k] = none.stripes[k];
  const Reason reason = judged("tee", view_of(flat), second).reason;
  CHECK(reason.code == Code::kSeamNotShown);
  CHECK(reason.number < 0.6 * reason.of);
}

TEST_CASE("an outside corner's plate that is a cut, its far leg seen as well, contradicts it") {
  const Height cut = [](double away) { return away < 0 || away > 9.5 ? kDeep : 0; };
  const Height with_leg = [](double away) {
    return away < 0 || (away > 9.5 && away < 25) || away > 34 ? kDeep : 0;
  };
  // The cuts of two plates, an angle: here and there a stripe runs on down the other leg.
  const auto angle = [&](const Height& whole) {
    PlateView view = view_of(with_leg);
    const PlateView narrow = view_of(cut), wide = view_of(whole);
    for (std::size_t k = 0; k < view.stripes.size(); ++k) {
      if (k % 3 == 0) view.stripes[k] = narrow.stripes[k];
      if (k % 4 == 1) view.stripes[k] = wide.stripes[k];
    }
    return view;
  };
  CHECK(judged("outside_corner", view_of(flat), view_of(flat)).reason.code == Code::kNone);
  const Reason reason = judged("outside_corner", view_of(flat), angle(flat)).reason;
  CHECK(reason.code == Code::kPlateTooNarrow);
  CHECK(reason.number == Approx(9.5).margin(1));
  // A tee's upright may be a flat bar.
  CHECK(judged("tee", view_of(flat), angle(flat)).reason.code == Code::kNone);
}

TEST_CASE("what stands before an outside corner's plate does not make it narrow") {
  const Height barred = [](double away) {
    return away < 0 ? kDeep : away > 9 && away < 17 ? 12 : 0;
  };
  CHECK(judged("outside_corner", view_of(flat), view_of(barred)).reason.code == Code::kNone);
}

TEST_CASE("the far side of a plate, cut or round, does not turn it") {
  // A sheet's cut, 1 mm lower; a flange that ends in a radius of 10 mm.
  const Height cut = [](double away) {
    return away < 0 || away > 28 ? kDeep : away > 25 ? -0.3 * (away - 25) : 0;
  };
  const Height flange = [](double away) {
    const double beyond = std::max(0.0, away - 21);
    return away < 0 ? kDeep : beyond > 9 ? kDeep : std::sqrt(100 - beyond * beyond) - 10;
  };
  for (const Height& far : {cut, flange})
    CHECK(judged("tee", view_of(flat), view_of(far)).reason.code == Code::kNone);
  const Height turned = [&](double away) { return flange(away) + 0.02 * away; };
  CHECK(judged("tee", view_of(flat), view_of(turned)).reason.code == Code::kPlateTurned);
}

TEST_CASE("what stands on a plate and is lower than any plate is none, unless something hides it") {
  const Height low = [](double away) { return away < 0 || away > 12.5 ? kDeep : 0; };
  const Height barred = [](double away) { return away < 0 ? kDeep : away > 12.5 ? 12 : 0; };
  const Reason reason = judged("tee", view_of(flat), view_of(low)).reason;
  CHECK(reason.code == Code::kPlateTooNarrow);
  CHECK(reason.number == Approx(12.5).margin(1));
  CHECK(judged("tee", view_of(flat), view_of(barred)).reason.code == Code::kNone);
}
