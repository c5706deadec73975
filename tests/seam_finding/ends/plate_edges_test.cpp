// Where stripes leave a plate.
#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/ends/plate_evidence.hpp"
#include "tests/seam_finding/ends/crossed_plate.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::crossed_plate;

TEST_CASE("the edge of a plate is found to a fraction of the stripes' distance") {
  for (const double slant : {0.3, -0.3, 0.2}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const double begin = 0.17 * seed;
      const Made made = make(begin, slant, -10, seed);
      INFO("slant " << slant << ", seed " << seed);
      const Edge edge = edge_of(made, SeamSide::kBegin, begin, 0.15);
      CHECK(edge.along == Approx(begin).margin(0.2));
      CHECK_FALSE(edge.likelihood.occluded);
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
      CHECK(edge_of(made, SeamSide::kEnd, 100, 0.15).along == Approx(100).margin(0.15));
    }
    CHECK(within >= 18);
  }
}

TEST_CASE("stripes square to the seam cross no edge; what lies before a plate hides its edge") {
  for (const auto& side : evidence_of(make(0, 0, 0, 1), 0.5))
    for (const StripeEvidence& stripe : side)
      for (const EdgeCrossing& edge : stripe.edges) CHECK(leaving(edge, 0) < kEnds.least_slant);
  int occluded = 0;
  for (const StripeEvidence& stripe : toward_begin(make(2, 0.3, 9, 3), 0.5))
    for (const EdgeCrossing& edge : stripe.edges) {
      if (leaving(edge, 0) < 0) continue;  // over the plate's other end
      CHECK(edge.occluded);
      CHECK(stripe.covered);
      ++occluded;
    }
  CHECK(occluded >= 3);
}

TEST_CASE("a stripe whose light ends too early draws no edge to it") {
  Made made = make(2, 0.4, -10, 6);
  const double as_made = edge_of(made, SeamSide::kBegin, 2, 0.03).along;
  for (const int i : made.plate.points)
    if (made.cloud.origins[i].segment_end && std::abs(made.cloud.points[i].x() - 2) < 0.1) {
      made.cloud.points[i] += Eigen::Vector3d(0.6, -0.6 / 0.4, 0);
      break;
    }
  CHECK(edge_of(made, SeamSide::kBegin, 2, 0.03).along == Approx(as_made).margin(0.05));
}

TEST_CASE("a place where a stripe crosses an edge flatly counts for little") {
  const auto deviation = [](double slant) {
    for (const StripeEvidence& stripe : toward_begin(make(2, slant, 0, 7), 0.03))
      if (!stripe.edges.empty()) return std::sqrt(variance_of(stripe.edges[0], 0, 0));
    return 0.0;
  };
  REQUIRE(deviation(0.4) > 0);
  CHECK(deviation(0.1) > 2 * deviation(0.4));
}

TEST_CASE("an edge cut at a slant is found by what falls over it") {
  for (const double slope : {-0.45, -0.2, 0.1, 0.2}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const double begin = 1 + 0.13 * seed;
      Made made = make(begin, 0.4, -10, seed);
      for (Eigen::Vector3d& point : made.cloud.points) point.x() += slope * point.y();
      const Edge edge = edge_of(made, SeamSide::kBegin, begin, 0.15);
      INFO("slope " << slope << ", seed " << seed);
      CHECK(edge.along == Approx(begin).margin(0.3));
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
    }
    CHECK(within >= 17);
  }
}

TEST_CASE("over an edge steeper than itself a stripe comes onto the plate") {
  for (const double turn : {-0.45, -0.55}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const double begin = 1 + 0.13 * seed;
      const Edge edge = edge_of(make(begin, 0.2, -10, seed, turn), SeamSide::kBegin, begin, 0.15);
      INFO("turn " << turn << ", seed " << seed);
      CHECK(edge.along == Approx(begin).margin(0.6));
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
    }
    CHECK(within >= 8);
  }
}

TEST_CASE("a stripe that turns over an edge onto a cut tells the edge, square or slanted") {
  for (const double cut : {0.0, 0.3, 0.45}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const double begin = 1 + 0.13 * seed;
      const Edge edge = edge_of(make(begin, 0.3, 0, seed, 0, cut), SeamSide::kBegin, begin, 0.15);
      INFO("cut " << cut << ", seed " << seed);
      CHECK(edge.along == Approx(begin).margin(0.15));
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
    }
    CHECK(within >= 8);
  }
}
