// The service on an in-memory bus: one stripe for each image, where it lies.
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "tests/extraction/support/extraction_cell.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

TEST_CASE("an image's stripe lies where it is on the full sensor") {
  ExtractionCell cell;
  image_t image = ExtractionCell::image(picture(), 0);
  image.offset_u = 200;
  image.offset_v = 700;
  const stripe_t stripe = cell.answer(image);
  REQUIRE(stripe.count > 280);
  CHECK(stripe.sensor_width == 1600);
  CHECK(stripe.sensor_height == 1200);
  for (int i = 0; i < stripe.count; ++i) {
    REQUIRE(stripe.v[i] == Approx(700 + 60 + 0.05 * (stripe.u[i] - 200 + 10)).margin(0.3));
    REQUIRE(stripe.rank[i] == stripe_t::CHOSEN);
    REQUIRE(stripe.segment[i] == 0);
    REQUIRE(stripe.width[i] > 1);
    REQUIRE(stripe.deviation[i] > 0);
    REQUIRE(stripe.strength[i] > 10);
  }
  CHECK(stripe.segment_end.front() == stripe_t::BORDER);
  CHECK(stripe.segment_end.back() == stripe_t::BORDER);
  CHECK(stripe.segment_end[5] == stripe_t::CONTINUES);
  CHECK(stripe.noise == Approx(2).epsilon(0.1));
  CHECK(stripe.saturated_share == 0);
}

TEST_CASE("a PNG gives the same stripe as the plain bytes") {
  image_t image = ExtractionCell::image(picture(), 0);
  const stripe_t plain = ExtractionCell().answer(image);
  cv::imencode(".png", picture(), image.data);
  put_checksum(image);
  image.encoding = image_t::PNG;
  CHECK(encode(ExtractionCell().answer(image)) == encode(plain));
}

TEST_CASE("where the laser is on and off by turns, the image before is subtracted") {
  // Another line, brighter than the stripe, that does not come from the laser.
  cv::Mat ambient = darkness(320, 160);
  add_stripe(ambient, -10, 110, 330, 100, 200, 2);
  cv::Mat lit = ambient.clone();
  add_stripe(lit, -10, 60, 330, 77, 100, 2);
  ExtractionCell cell;
  const auto far_from_stripe = [](const stripe_t& stripe) {
    int count = 0;
    for (int i = 0; i < stripe.count; ++i)
      count += std::abs(stripe.v[i] - 60 - 0.05 * (stripe.u[i] + 10)) > 2;
    return count;
  };
  image_t off = ExtractionCell::image(expose(ambient, 2, 1), 0);
  off.laser_on = 0;
  CHECK(cell.answer(off).empty == "laser off");
  const stripe_t& stripe = cell.answer(ExtractionCell::image(expose(lit, 2, 2), 1));
  CHECK(stripe.count > 280);
  CHECK(far_from_stripe(stripe) == 0);
  // The image before was not one with the laser off, or was taken in another way.
  CHECK(far_from_stripe(cell.answer(ExtractionCell::image(expose(lit, 2, 3), 2))) > 280);
  off.seq = off.scan_index = 3;
  cell.answer(off);
  image_t longer = ExtractionCell::image(expose(lit, 2, 4), 4);
  longer.exposure_us *= 2;
  CHECK(far_from_stripe(cell.answer(longer)) > 280);
}

TEST_CASE("clipping is judged before the unlit image is subtracted") {
  // A bright plate leaves the laser 75 grey values: the difference's top is flat, and not white.
  cv::Mat lit = darkness(320, 160, 180), unlit = lit.clone();
  add_stripe(lit, -10, 60, 330, 77, 200, 3);
  lit(cv::Rect(0, 120, 320, 20)) += 200;  // by the lamp alone
  unlit(cv::Rect(0, 120, 320, 20)) += 200;
  ExtractionCell cell;
  image_t off = ExtractionCell::image(expose(unlit, 1, 1), 0);
  off.laser_on = 0;
  cell.answer(off);
  const stripe_t& stripe = cell.answer(ExtractionCell::image(expose(lit, 1, 2), 1));
  CHECK(stripe.count > 280);
  CHECK(stripe.saturated_share > 0.9);
  for (int i = 0; i < stripe.count; ++i) {
    if (stripe.rank[i] != stripe_t::CHOSEN) continue;
    CHECK(std::abs(stripe.v[i] - 60 - 0.05 * (stripe.u[i] + 10)) < 0.5);
  }
}

TEST_CASE("sigma begins anew with each scan, and single images leave no trace") {
  ExtractionCell cell;
  const cv::Mat narrow = picture(60, 1.5), wide = picture(60, 3.5);
  const float first = cell.answer(ExtractionCell::image(narrow, 0)).sigma;
  CHECK(cell.answer(ExtractionCell::image(wide, 1)).sigma <
        1.2 * first);  // within the scan it follows slowly
  image_t other = ExtractionCell::image(wide, 40, 2000);
  other.scan_index = 0;
  CHECK(cell.answer(other).sigma > 2 * first);
  CHECK(cell.answer(ExtractionCell::image(narrow, 50, 0)).sigma == first);
  CHECK(cell.answer(ExtractionCell::image(wide, 60, 0)).sigma > 2 * first);
}

TEST_CASE("the same images give the same stripes, byte by byte") {
  const auto run = [] {
    ExtractionCell cell;
    std::vector<std::uint8_t> all;
    for (int seq = 0; seq < 5; ++seq) {
      const auto bytes =
          encode(cell.answer(ExtractionCell::image(picture(50 + 3 * seq, 1.5 + 0.1 * seq), seq)));
      all.insert(all.end(), bytes.begin(), bytes.end());
    }
    return all;
  };
  CHECK(run() == run());
}
