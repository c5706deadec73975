#include "services/seam_finding/ends/plate_end.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// A plate in z = 0 from x = begin to 100 and y = 0 to 40, its seam along the x axis; stripes every
// 3.6 mm cross it at a slant, thinned out to every fifteenth of their centres a tenth of a
// millimetre apart, and end a pixel's fraction before its edges. next: the height over the plate of
// what a stripe shows next; 0 for nothing.
struct Made {
  ScanCloud cloud;
  JointPlate plate, other;
  Line line{{0, 0, 0}, {1, 0, 0}};
};

Made make(double begin, double slant, double next, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> phase(0, 0.1);
  Made made;
  made.plate.plane = {Eigen::Vector3d::UnitZ(), 0};
  made.other.plane = {Eigen::Vector3d::UnitY(), 0};
  for (double x = -20; x < 120; x += 3.6) {
    const int stripe = static_cast<int>(made.cloud.stripes.size());
    std::vector<Eigen::Vector3d> centres;  // outward from the seam
    for (double y = phase(engine); y < 40; y += 0.1)
      if (const double along = x - slant * y; along > begin && along < 100)
        centres.emplace_back(along + noise(engine), y, noise(engine));
    const auto add = [&](const Eigen::Vector3d& point, int segment, bool end) {
      made.cloud.points.push_back(point);
      made.cloud.origins.push_back({stripe, segment, end, 0, 0.1f * std::hypot(1.0f, 0.3f)});
    };
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (i % 15 == 0 || i + 1 == centres.size()) {
        made.plate.points.push_back(made.cloud.size());
        add(centres[i], 0, i == 0 || i + 1 == centres.size());
      }
    if (next != 0 && !centres.empty()) add(centres.back() + Eigen::Vector3d(-1, 1, next), 1, true);
    end_stripe(made.cloud, ScanStripe::Seen::kSeen, {x, 100, 200}, {x, 0, 0});
  }
  return made;
}

std::optional<PlateEdge> edge_of(const Made& made, SeamSide side, const EdgeWindow& window,
                                 double shortening_px) {
  const Scales scales = scales_of_test(3.6, 0.5, 0.02);
  SeamFindingSettings settings;
  settings.edge_shortening_px = shortening_px;
  return find_edge(made.cloud, plate_stripes(made.cloud, made.plate, made.other, made.line, scales),
                   side, window, scales, settings);
}

}  // namespace

TEST_CASE("the edge of a plate is found to a fraction of the stripes' distance") {
  for (const double slant : {0.3, -0.3, 0.2}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const double begin = 0.17 * seed;
      const Made made = make(begin, slant, 0, seed);
      const auto edge = edge_of(made, SeamSide::kBegin, {begin - 3, begin + 3, 0}, 0.15);
      REQUIRE(edge);
      CHECK(edge->along == Approx(begin).margin(0.15));
      CHECK_FALSE(edge->occluded);
      within += std::pow(edge->along - begin, 2) <= 4 * edge->variance;
      const auto end = edge_of(made, SeamSide::kEnd, {97, 103, 0}, 0.15);
      REQUIRE(end);
      CHECK(end->along == Approx(100).margin(0.15));
    }
    CHECK(within >= 18);
  }
}

TEST_CASE("stripes square to the seam cross no edge; what lies before a plate hides its edge") {
  CHECK_FALSE(edge_of(make(0, 0, 0, 1), SeamSide::kBegin, {-3, 3, 0}, 0.5));
  const Made hidden = make(2, 0.3, 9, 3);
  const auto edge = edge_of(hidden, SeamSide::kBegin, {-1, 5, 0}, 0.5);
  REQUIRE(edge);
  CHECK(edge->occluded);
}

TEST_CASE("a stripe that ends behind something before the edge is no place of it") {
  // Few stripes cross the edge; the one next to the seam is hidden from 0.8 mm before it on.
  Made made = make(2, 0.3, 0, 4);
  int last = -1;
  for (const int i : made.plate.points)
    if (made.cloud.origins[i].segment_end && made.line.along(made.cloud.points[i]) < 2.5 &&
        (last < 0 || made.cloud.points[i].y() < made.cloud.points[last].y()))
      last = i;
  REQUIRE(last >= 0);
  made.cloud.points[last].x() += 0.8;
  made.cloud.points[last].y() -= 0.8 / 0.3;
  const ScanStripe& stripe = made.cloud.stripes[made.cloud.origins[last].stripe];
  REQUIRE(last == stripe.first + stripe.count - 1);
  // The thing before it is the next point of the stripe.
  const int index = made.cloud.origins[last].stripe;
  made.cloud.points.insert(made.cloud.points.begin() + last + 1,
                           made.cloud.points[last] + Eigen::Vector3d(-1, 1, 9));
  made.cloud.origins.insert(made.cloud.origins.begin() + last + 1, {index, 1, true, 0, 0.1f});
  ++made.cloud.stripes[index].count;
  for (std::size_t k = index + 1; k < made.cloud.stripes.size(); ++k) ++made.cloud.stripes[k].first;
  for (int& i : made.plate.points) i += i > last;
  const auto edge = edge_of(made, SeamSide::kBegin, {-1, 5, 0}, 0.15);
  REQUIRE(edge);
  CHECK_FALSE(edge->occluded);
  CHECK(edge->along == Approx(2).margin(0.15));
}

TEST_CASE("a stripe whose light ends too early draws no edge to it") {
  Made made = make(2, 0.4, 0, 6);
  const EdgeWindow window{-1, 5, 0};
  const double shortening_px = 0.03;
  const auto as_made = edge_of(made, SeamSide::kBegin, window, shortening_px);
  REQUIRE(as_made);
  REQUIRE(as_made->stripes >= 4);
  for (const int i : made.plate.points)
    if (made.cloud.origins[i].segment_end && std::abs(made.cloud.points[i].x() - 2) < 0.1) {
      made.cloud.points[i] += Eigen::Vector3d(0.3, -0.3 / 0.4, 0);
      break;
    }
  const auto edge = edge_of(made, SeamSide::kBegin, window, shortening_px);
  REQUIRE(edge);
  CHECK(edge->stripes == as_made->stripes - 1);
  CHECK(edge->along == Approx(as_made->along).margin(0.04));
}

TEST_CASE("a place where a stripe crosses an edge flatly counts for little") {
  const auto variance = [](double slant) {
    const Made made = make(2, slant, 0, 7);
    const auto edge = edge_of(made, SeamSide::kBegin, {-1, 5, 0}, 0.03);
    REQUIRE(edge);
    return edge->variance * edge->stripes;
  };
  CHECK(variance(0.1) > 4 * variance(0.4));
}

TEST_CASE("of two edges the first counts, or both of flush plates, as far as either is likely") {
  // Over all places that the edges may have. Three of ten joints are flush; of the others one edge
  // lies anywhere within 13 mm about the other.
  const auto expected = [](const PlateEdge& a, const PlateEdge& b) {
    const auto density = [](const PlateEdge& edge, double x) {
      return std::exp(-std::pow(x - edge.along, 2) / (2 * edge.variance)) /
             std::sqrt(2 * EIGEN_PI * edge.variance);
    };
    constexpr double kStep = 0.01;
    double weight = 0, sum = 0, squares = 0;
    for (double x = -1.5; x < 1.5; x += kStep) {
      const double flush = 3.0 / 7 * 13 * density(a, x) * density(b, x) * kStep;
      weight += flush, sum += flush * x, squares += flush * x * x;
      for (double y = -1.5; y < 1.5; y += kStep) {
        const double apart = density(a, x) * density(b, y) * kStep * kStep;
        const double first = std::min(x, y);
        weight += apart, sum += apart * first, squares += apart * first * first;
      }
    }
    return CommonEnd{sum / weight, squares / weight - sum * sum / weight / weight};
  };
  for (const double difference : {0.0, 0.1, -0.15, 0.2, -0.25, 0.6})
    for (const double deviation : {0.04, 0.12}) {
      PlateEdge a, b;
      a.along = 0.1, b.along = 0.1 + difference;
      a.variance = deviation * deviation, b.variance = 0.08 * 0.08;
      const CommonEnd end = end_of_both(a, b, SeamSide::kEnd), truth = expected(a, b);
      CAPTURE(difference, deviation);
      CHECK(end.along == Approx(truth.along).margin(0.002));
      CHECK(std::sqrt(end.variance) == Approx(std::sqrt(truth.variance)).margin(0.002));
      // At the begin outward is the other way.
      a.along = -a.along, b.along = -b.along;
      CHECK(end_of_both(a, b, SeamSide::kBegin).along == Approx(-end.along));
    }
}

TEST_CASE("an edge out of square is found where enough stripes cross it") {
  Made made = make(2, 0.4, 0, 8);
  for (Eigen::Vector3d& point : made.cloud.points) point.x() += 0.015 * point.y();
  const auto edge = edge_of(made, SeamSide::kBegin, {-1, 5, 0}, 0.03);
  REQUIRE(edge);
  CHECK(edge->stripes >= 4);
  CHECK(edge->along == Approx(2).margin(0.08));
}

TEST_CASE(
    "an edge cut at a slant is found by what falls over it, and known as well as it is told") {
  for (const double slope : {-0.45, -0.2, 0.1, 0.2}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const double begin = 1 + 0.13 * seed;
      Made made = make(begin, 0.4, -10, seed);
      for (Eigen::Vector3d& point : made.cloud.points) point.x() += slope * point.y();
      const auto edge = edge_of(made, SeamSide::kBegin, {begin - 3, begin + 3, 0}, 0.15);
      INFO("slope " << slope << ", seed " << seed);
      REQUIRE(edge);
      CHECK(edge->slope == Approx(slope).margin(0.02));
      CHECK(edge->along == Approx(begin).margin(0.3));
      within += std::pow(edge->along - begin, 2) <= 4 * edge->variance;
    }
    CHECK(within >= 17);
  }
}

TEST_CASE("a slanting edge behind which nothing is seen may be a shadow's") {
  Made made = make(2, 0.4, 0, 9);
  for (Eigen::Vector3d& point : made.cloud.points) point.x() += 0.3 * point.y();
  const auto edge = edge_of(made, SeamSide::kBegin, {-1, 5, 0}, 0.15);
  CHECK((!edge || edge->slope == 0));
}

TEST_CASE("there is no edge where none is expected, nor in a cloud without stripes") {
  const Made made = make(2, 0.3, 0, 5);
  CHECK_FALSE(edge_of(made, SeamSide::kBegin, {40, 46, 0}, 0.5));
  Made loose = made;
  loose.cloud.stripes.clear();
  CHECK_FALSE(edge_of(loose, SeamSide::kBegin, {-1, 5, 0}, 0.5));
}
