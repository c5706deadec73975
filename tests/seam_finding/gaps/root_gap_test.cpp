// Root gaps against corners drawn in closed form, their light smoothed as a line detector does.
#include "services/seam_finding/gaps/root_gap.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/seam_finding/support/synthetic_random.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kPixel = 0.12;  // across the line of sight; mm

// A stripe's way through the corner at y = z = 0: in along the base plate from y < 0, in under the
// upright as far as can be seen past its edge, up its face. The sensor looks from the front, 38 deg
// from above.
struct CornerDrawing {
  double gap = 1;         // mm
  double rounding = 1.5;  // standard deviation of the smoothing in the image; px
  int downsample = 1;
  bool bends = false;        // all centres within 2 mm of the corner are kept
  bool parted = false;       // at the gap
  bool under_is_lit = true;  // where parted
  double upright_deg = 90;   // between the plates
  double noise = 0.02;       // mm
  bool swapped = false;      // the upright is plate 0
};

struct Corner {
  ScanCloud cloud;
  std::array<JointPlate, 2> plates;
  Line line{{0, 0, 0}, {1, 0, 0}};
};

// A centre, and which plate it lies on.
struct Centre {
  double across = 0, depth = 0;  // of the line of sight; mm
  int plate = 0;
};

// Smoothing moves a centre along its line of sight alone. What is parted ends in straight lines.
std::vector<Centre> smoothed(const std::vector<Centre>& centres, const CornerDrawing& drawing) {
  std::vector<Centre> result = centres;
  if (drawing.parted) return result;
  const int reach = static_cast<int>(4 * drawing.rounding);
  for (int i = reach; i + reach < static_cast<int>(centres.size()); ++i) {
    double sum = 0, weights = 0;
    for (int k = i - reach; k <= i + reach; ++k) {
      const double off = (k - i) / drawing.rounding, weight = std::exp(-off * off / 2);
      sum += weight * (centres[k].depth - centres[i].depth), weights += weight;
    }
    result[i].depth += sum / weights;
  }
  return result;
}

Corner draw_corner(const CornerDrawing& drawing) {
  Corner corner;
  const double angle = drawing.upright_deg * M_PI / 180, lean = 38 * M_PI / 180;
  const Eigen::Vector3d up(0, -std::cos(angle), std::sin(angle));
  const Eigen::Vector3d face(0, -std::sin(angle), -std::cos(angle));
  const Eigen::Vector3d sight(0, std::sin(lean), -std::cos(lean));
  const Eigen::Vector3d across(0, std::cos(lean), std::sin(lean));
  corner.plates[0].plane = {Eigen::Vector3d::UnitZ(), 0};
  corner.plates[1].plane = {face, 0};
  synthetic::Random random{std::mt19937_64(7)};
  for (int stripe = 0; stripe < 20; ++stripe) {
    std::vector<Centre> way;
    for (double u = -20 + random.between(0, kPixel); u < 12; u += kPixel) {
      const bool on_upright = u >= drawing.gap * across.dot(up);
      const Eigen::Vector3d along = on_upright ? up : Eigen::Vector3d::UnitY();
      const double depth = u / across.dot(along) * along.dot(sight);
      if (!on_upright && u > -1 && !drawing.under_is_lit) continue;
      way.push_back({u, depth, on_upright});
    }
    way = smoothed(way, drawing);
    int number = 0;
    for (std::size_t i = 0; i < way.size(); ++i, ++number) {
      const bool first = i == 0 || (drawing.parted && way[i].plate != way[i - 1].plate);
      const bool last = i + 1 == way.size() || (drawing.parted && way[i].plate != way[i + 1].plate);
      if (first) number = 0;
      const bool bend = drawing.bends && std::abs(way[i].across) < 2;
      if (!first && !last && !bend && number % drawing.downsample != 0) continue;
      corner.plates[way[i].plate].points.push_back(corner.cloud.size());
      corner.cloud.points.push_back(Eigen::Vector3d(3.0 * stripe, 0, 0) + way[i].across * across +
                                    (way[i].depth + random.normal(drawing.noise)) * sight);
      corner.cloud.origins.push_back({stripe, drawing.parted ? way[i].plate : 0, first || last,
                                      static_cast<float>(drawing.noise),
                                      static_cast<float>(kPixel / std::cos(lean))});
    }
    const Eigen::Vector3d camera = Eigen::Vector3d(3.0 * stripe, 0, 0) - 300 * sight;
    end_stripe(corner.cloud, ScanStripe::Seen::kSeen, camera, camera);
  }
  if (drawing.swapped) std::swap(corner.plates[0], corner.plates[1]);
  return corner;
}

struct Measured {
  int stripes = 0;
  double mean = 0, deviation = 0, farthest = 0;  // mm; farthest: a stripe's from the truth
};

Measured measure(const CornerDrawing& drawing) {
  const Corner corner = draw_corner(drawing);
  const auto gaps = root_gaps(corner.cloud, corner.plates, corner.line);
  REQUIRE(gaps.size() == corner.cloud.stripes.size());
  const double truth = drawing.gap * std::sin(drawing.upright_deg * M_PI / 180);
  Measured measured;
  for (const auto& gap : gaps) {
    if (!gap) continue;
    ++measured.stripes;
    measured.mean += gap->width;
    measured.deviation += gap->deviation;
    measured.farthest = std::max(measured.farthest, std::abs(gap->width - truth));
  }
  if (measured.stripes > 0)
    measured.mean /= measured.stripes, measured.deviation /= measured.stripes;
  return measured;
}

}  // namespace

TEST_CASE("a root gap is told through the rounding of the stripe, whichever plate stands off") {
  const double gap = GENERATE(0.8, 1.0, 1.5, 2.0), angle = GENERATE(75.0, 90.0, 105.0);
  const bool swapped = GENERATE(false, true);
  INFO("gap " << gap << ", angle " << angle << ", swapped " << swapped);
  const double truth = gap * std::sin(angle * M_PI / 180);
  const Measured fine = measure({.gap = gap, .upright_deg = angle, .swapped = swapped});
  CHECK(fine.stripes == 20);
  CHECK(fine.mean == Approx(truth).margin(0.15));
  CHECK(fine.farthest < 2 * fine.deviation);
  CHECK(fine.deviation < 0.6);
  // Of a stripe that is thinned out the bends are enough.
  const Measured downsample = measure(
      {.gap = gap, .downsample = 15, .bends = true, .upright_deg = angle, .swapped = swapped});
  CHECK(downsample.stripes == 20);
  CHECK(downsample.mean == Approx(fine.mean).margin(0.05));
}

TEST_CASE("of a closed joint the gap given is none, within its deviation") {
  const Measured measured = measure({.gap = 0});
  CHECK(measured.stripes == 20);
  CHECK(measured.mean < 2 * measured.deviation);
  CHECK(measured.mean < 0.4);
}

TEST_CASE("a wide gap parts the light: the standing plate's end tells it") {
  const Measured measured = measure({.gap = 3, .downsample = 15, .parted = true});
  CHECK(measured.stripes == 20);
  CHECK(measured.mean == Approx(3).margin(0.15));  // a pixel is 0.19 mm on the upright
  CHECK(measured.farthest < 2 * measured.deviation);
}

TEST_CASE("no gap is told where the corner was not seen") {
  CHECK(measure({.downsample = 15}).stripes == 0);  // between the centres kept
  // Light that is lost before the upright is no gap.
  CHECK(measure({.gap = 3, .parted = true, .under_is_lit = false}).stripes == 0);
  CHECK(measure({.gap = 9, .parted = true}).stripes == 0);
}
