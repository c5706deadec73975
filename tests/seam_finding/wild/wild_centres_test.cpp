#include "tests/seam_finding/support/wild_centres.hpp"

#include <arcstart/profile_t.hpp>
#include <catch2/catch.hpp>
#include <cmath>

namespace arcstart::seam_finding::synthetic {
namespace {

using cell_simulator::RandomStream, cell_simulator::WildSurface;
using Eigen::Vector2d, Eigen::Vector3d;

WildPiece piece(const Vector2d& from, const Vector2d& to) {
  return {Vector3d::Zero(), Vector3d::Zero(), from, to, 0, Vector3d::UnitZ(), false};
}

constexpr WildExtraction exact{1600, 1200, 0, 1e-3, 0};

WildSurface noisy(double noise, double dropouts) {
  WildSurface surface;
  surface.noise_px = noise;
  surface.dropout_share = dropouts;
  return surface;
}

}  // namespace

TEST_CASE("One centre a column, and one a row where the stripe runs steeply") {
  RandomStream random(1);
  const auto centres = centres_of({piece({100.3, 50}, {200.7, 60}), piece({200.7, 60}, {210, 160})},
                                  {noisy(0, 0)}, exact, random);
  // The begin, columns 101 to 200, rows 60 to 159, the end.
  CHECK(centres.size() == 1 + 100 + 100 + 1);
  CHECK(centres.front().pixel == Vector2d(100.3, 50));
  CHECK(centres[1].pixel.x() == Approx(101));
  CHECK(centres[150].pixel.y() == Approx(std::round(centres[150].pixel.y())));
  CHECK((centres.back().pixel - Vector2d(210, 160)).norm() < 1e-9);
  for (const WildCentre& centre : centres) CHECK(centre.segment == 0);
}

TEST_CASE("Pieces that part in the image are segments of their own, short ones are left out") {
  RandomStream random(1);
  const auto centres = centres_of(
      {piece({0.5, 50}, {100, 50}), piece({100, 80}, {180, 80}), piece({190, 90}, {195, 90})},
      {noisy(0, 0)}, exact, random);
  REQUIRE(centres.back().segment == 1);
  CHECK(centres.front().segment_end == profile_t::BORDER);
  CHECK(centres.back().segment_end == profile_t::EDGE);
}

TEST_CASE("In a band of its object a stripe has the band's noise") {
  RandomStream random(1);
  WildExtraction extraction = exact;
  extraction.noise_factor = 1;
  WildPiece ground = piece({800, 50}, {1500, 50});
  ground.in_band = true;
  const auto centres = centres_of({piece({100, 50}, {800, 50}), ground},
                                  {noisy(0.2, 0), noisy(0.05, 0)}, extraction, random);
  CHECK(centres.back().segment == 0);
  for (const WildCentre& centre : centres) {
    if (std::abs(centre.pixel.x() - 800) < 1) continue;
    CHECK(centre.deviation == (centre.pixel.x() < 800 ? 0.2 : 0.05));
  }
}

TEST_CASE("Noise lies across the stripe, and bends are rounded as a Gaussian does") {
  RandomStream random(1);
  WildExtraction extraction = exact;
  extraction.noise_factor = 1;
  double squares = 0;
  const auto noise =
      centres_of({piece({100, 50}, {1500, 50})}, {noisy(0.2, 0)}, extraction, random);
  for (const WildCentre& centre : noise) squares += std::pow(centre.pixel.y() - 50, 2);
  CHECK(std::sqrt(squares / static_cast<double>(noise.size())) == Approx(0.2).epsilon(0.1));

  extraction = exact;
  extraction.bend_blur_px = 2;
  const auto bend = centres_of({piece({100, 50}, {200, 50}), piece({200, 50}, {300, 90})},
                               {noisy(0, 0)}, extraction, random);
  // At the bend itself a Gaussian of sigma 2 takes sigma / sqrt(2 pi) of the change of direction.
  const Vector2d change = Vector2d(100, 40).normalized() - Vector2d(1, 0);
  const WildCentre& corner = bend[100];
  CHECK((corner.pixel - Vector2d(200, 50) - 2 / std::sqrt(2 * M_PI) * change).norm() < 1e-6);
}

TEST_CASE("Dropouts lose about their share") {
  RandomStream random(3);
  std::size_t left = 0;
  for (int i = 0; i < 50; ++i)
    left += centres_of({piece({100, 50}, {1500, 50})}, {noisy(0, 0.1)}, exact, random).size();
  CHECK(static_cast<double>(left) / (50 * 1401) == Approx(0.9).margin(0.03));
}

}  // namespace arcstart::seam_finding::synthetic
