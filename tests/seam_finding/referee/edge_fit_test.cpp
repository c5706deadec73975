#include "services/seam_finding/referee/edge_fit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace arcstart::seam_finding;

namespace {

constexpr double kPlay = 0.2, kSteepest = 0.6;

// A stripe that crosses an edge, or not: its places inside and outside of it.
EdgeEvidence stripe_over(double foot, double slope, double crossing, double lean, double noise,
                         std::mt19937& random) {
  EdgeEvidence evidence;
  std::normal_distribution<double> off(0, noise);
  for (double away = 1; away < 40; away += 1.5) {
    const EdgeMark mark{crossing + lean * away + off(random), away};
    (mark.out < foot + slope * away ? evidence.on : evidence.off).push_back(mark);
  }
  return evidence;
}

std::vector<EdgeEvidence> stripes_over(double foot, double slope, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<EdgeEvidence> all;
  for (double crossing = -25; crossing < 15; crossing += 3.6)
    all.push_back(stripe_over(foot, slope, crossing, 0.38, 0.02, random));
  return all;
}

bool satisfies(const std::vector<EdgeEvidence>& all, double foot, double slope) {
  for (const EdgeEvidence& evidence : all) {
    for (const EdgeMark& mark : evidence.on)
      if (mark.out - slope * mark.away - kPlay > foot) return false;
    for (const EdgeMark& mark : evidence.off)
      if (mark.out - slope * mark.away + kPlay < foot) return false;
  }
  return true;
}

// Foot and slope tried one by one.
EdgeFoot by_trial(const std::vector<EdgeEvidence>& all) {
  EdgeFoot foot{1e9, -1e9};
  for (double slope = -kSteepest; slope <= kSteepest + 1e-9; slope += 0.005)
    for (double at = -12; at < 12; at += 0.01)
      if (satisfies(all, at, slope)) {
        foot.least = std::min(foot.least, at);
        foot.most = std::max(foot.most, at);
      }
  return foot;
}

}  // namespace

TEST_CASE("an edge's foot lies between the same places as by trying all edges") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const double foot = 0.4 * seed - 2, slope = 0.13 * seed - 0.55;
    const auto all = stripes_over(foot, slope, seed);
    const EdgeFit fit = fit_edge(all, kPlay);
    const EdgeFoot tried = by_trial(all);
    INFO("foot " << foot << " slope " << slope);
    CHECK(fit.contradicting == 0);
    CHECK(fit.foot.least == Approx(tried.least).margin(0.02));
    CHECK(fit.foot.most == Approx(tried.most).margin(0.02));
    CHECK(fit.foot.least <= foot);
    CHECK(fit.foot.most >= foot);
    CHECK(fit.foot.most - fit.foot.least < 4.5);  // no stripe need cross it: their pitch
  }
}

TEST_CASE(
    "how far an edge may lie without the stripe that bounds it is as with that one left out") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const auto all = stripes_over(0.4 * seed - 2, 0, seed);
    // The one whose absence sets the edge free, tried one by one.
    double farthest = fit_edge(all, kPlay).foot.most;
    for (std::size_t left_out = 0; left_out < all.size(); ++left_out) {
      auto others = all;
      others[left_out].off.clear();
      farthest = std::max(farthest, fit_edge(others, kPlay).foot.most);
    }
    const EdgeFoot foot = fit_edge(all, kPlay).foot;
    CHECK(foot.most_but_one > foot.most);
    CHECK(foot.most_but_one == Approx(farthest).margin(0.5));  // slopes that only it forbids
  }
}

TEST_CASE("stripes that no edge satisfies are counted, and the others tell") {
  auto all = stripes_over(1, 0.2, 11);
  all[8].on = {{9, 10}};  // stray light far outside
  const EdgeFit fit = fit_edge(all, kPlay);
  CHECK(fit.contradicting == 1);
  CHECK(fit.foot.least <= 1);
  CHECK(fit.foot.most >= 1);
  CHECK(fit.foot.most < 3);
}

TEST_CASE("a dark stretch weighs less than what is seen behind it") {
  auto all = stripes_over(1, 0, 12);
  EdgeEvidence dark;
  dark.dark = {{-9, 1}, {-9, 30}};
  all.push_back(dark);
  const EdgeFit fit = fit_edge(all, kPlay);
  CHECK(fit.contradicting == Approx(0.4));
  CHECK(fit.foot.most >= 1);
}

TEST_CASE("a wavy edge is bounded by as much as it waves") {
  constexpr double foot = 0.5, wave = 1.0;  // mm
  std::vector<EdgeEvidence> all;
  for (int k = 0; k < 12; ++k) {
    EdgeEvidence evidence;
    const double crossing = -25 + 3.6 * k;
    for (double away = 1; away < 40; away += 1) {
      const EdgeMark mark{crossing + 0.38 * away, away};
      const double edge = foot + 0.1 * away + wave * std::sin(away * 2 * M_PI / 8 + 1);
      (mark.out < edge ? evidence.on : evidence.off).push_back(mark);
    }
    all.push_back(evidence);
  }
  const EdgeFit straight = fit_edge(all, kPlay), waved = fit_waved_edge(all);
  CHECK(straight.contradicting > 1);
  CHECK(waved.contradicting <= 1);
  CHECK(waved.foot.least < foot - 2 * kPlay);
  CHECK(waved.foot.most > foot + 2 * kPlay);
  CHECK(waved.foot.most - waved.foot.least < 8);
}
