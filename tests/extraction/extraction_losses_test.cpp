// The service on an in-memory bus: what was lost, and images that hold no stripe or cannot be read.
#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "tests/extraction/support/extraction_cell.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

TEST_CASE("what holds no stripe gives an empty one with its reason") {
  ExtractionCell cell;
  std::int64_t seq = 0;
  std::int8_t why = stripe_t::NONE;  // of the last
  const auto reason = [&](image_t image) {
    image.seq = seq;
    image.scan_index = static_cast<std::int32_t>(seq++);
    const stripe_t& stripe = cell.answer(image);
    why = stripe.why;
    return stripe.empty;
  };
  image_t incomplete = ExtractionCell::image(picture(), 0);
  incomplete.incomplete = "3 packets missing";
  incomplete.data.clear();
  put_checksum(incomplete);
  CHECK(reason(incomplete) == "image incomplete: 3 packets missing");
  CHECK(why == stripe_t::INCOMPLETE_IMAGE);
  image_t dark = ExtractionCell::image(picture(), 0);
  dark.laser_on = 0;
  CHECK(reason(dark) == "laser off");
  CHECK(why == stripe_t::LASER_OFF);
  CHECK(reason(ExtractionCell::image(cv::Mat(160, 320, CV_8U, cv::Scalar(0)), 0)) ==
        "no stripe found");
  CHECK(reason(ExtractionCell::image(cv::Mat(160, 320, CV_8U, cv::Scalar(255)), 0)) ==
        "no stripe found");
  CHECK(reason(ExtractionCell::image(cv::Mat(1, 1, CV_8U, cv::Scalar(7)), 0)) == "no stripe found");
  CHECK(why == stripe_t::NO_STRIPE);
  image_t coloured = ExtractionCell::image(picture(), 0);
  coloured.encoding = image_t::BAYER_RG8;
  CHECK(reason(coloured) == "encoding 3 is not read yet: send MONO8 or PNG");
  CHECK(why == stripe_t::UNKNOWN_ENCODING);

  image_t png = ExtractionCell::image(picture(), 0);
  png.encoding = image_t::PNG;
  CHECK(reason(png) == "not a PNG");
  CHECK(why == stripe_t::UNREADABLE_IMAGE);
  cv::imencode(".png", picture(), png.data);
  const auto whole = png.data;
  const auto with = [&](const std::vector<std::uint8_t>& bytes) {
    png.data = bytes;
    put_checksum(png);
    return png;
  };
  CHECK(reason(with({whole.begin(), whole.begin() + 5000})) == "PNG is cut short");
  std::vector<std::uint8_t> damaged = whole;
  damaged[3000] ^= 0x55;
  CHECK(reason(with(damaged)) == "PNG is damaged");
  CHECK(why == stripe_t::UNREADABLE_IMAGE);
  cv::Mat smaller = picture()(cv::Rect(0, 0, 300, 160)).clone();
  std::vector<std::uint8_t> other;
  cv::imencode(".png", smaller, other);
  CHECK(reason(with(other)) == "PNG is 300 x 160, announced were 320 x 160");
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    std::vector<std::uint8_t> noise(1 + random() % 2000);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    CHECK(reason(with(noise)) == "not a PNG");
  }
  // And after all that it works as before.
  CHECK(reason(ExtractionCell::image(picture(), 0)).empty());
  CHECK(cell.health().lost == 0);
}

TEST_CASE("gaps in a scan's sequence are counted as lost, what lies between scans is not") {
  ExtractionCell cell;
  const cv::Mat grey = picture();
  for (const int seq : {0, 1, 2, 5, 6}) cell.answer(ExtractionCell::image(grey, seq));
  CHECK(cell.health().lost == 2);
  CHECK(cell.health().last_error.find("seq 5") != std::string::npos);
  cell.answer(ExtractionCell::image(grey, 90, 0));  // single images outside a scan
  cell.answer(ExtractionCell::image(grey, 120, 0));
  CHECK(cell.health().lost == 2);
  image_t next = ExtractionCell::image(grey, 500, 2000);
  next.scan_index = 0;
  cell.answer(next);
  CHECK(cell.health().lost == 2);
  image_t late =
      ExtractionCell::image(grey, 700, 3000);  // the first three of this scan did not come
  late.scan_index = 3;
  cell.answer(late);
  CHECK(cell.health().lost == 5);
  // A wild number adds nothing, nor does the true one after it.
  image_t wild = late;
  wild.seq = 1'000'000'000'000;
  cell.answer(wild);
  late.seq = 701;
  cell.answer(late);
  CHECK(cell.health().lost == 5);
}

TEST_CASE("an image whose bytes were damaged on the way is lost, and that is what is said") {
  ExtractionCell cell;
  cell.answer(ExtractionCell::image(picture(), 0));
  image_t damaged = ExtractionCell::image(picture(), 1);
  damaged.data[20'000] ^= 1;
  cell.send(damaged);
  CHECK(cell.stripes() == 1);
  cell.answer(ExtractionCell::image(picture(), 2));
  CHECK(cell.health().lost == 1);
  CHECK_THAT(cell.health().last_error,
             Catch::Contains("1 images lost before seq 2") && Catch::Contains("CRC-32C"));
  cell.answer(ExtractionCell::image(picture(), 5));  // these did not come at all
  CHECK(cell.health().lost == 3);
  CHECK_THAT(cell.health().last_error,
             Catch::Contains("2 images lost before seq 5") && Catch::Contains("receive buffer"));
}

TEST_CASE("an image of another sensor than the calibration's is refused before it is decoded") {
  ExtractionCell cell;
  image_t huge = ExtractionCell::image(picture(), 0);
  huge.width = huge.sensor_width = huge.height = huge.sensor_height = 20'000;
  huge.encoding = image_t::PNG;
  huge.data.resize(5000);
  put_checksum(huge);
  CHECK(cell.answer(huge).empty == "not a PNG");  // no calibration is known: it was looked at
  cell.calibrate(1600, 1200);
  ++huge.seq;
  const stripe_t refused = cell.answer(huge);
  CHECK(refused.why == stripe_t::UNREADABLE_IMAGE);
  CHECK_THAT(refused.empty, Catch::Contains("20000 x 20000") && Catch::Contains("1600 x 1200"));
  CHECK(cell.answer(ExtractionCell::image(picture(), 2)).empty.empty());
  cell.calibrate(1600, 1201);
  CHECK(cell.answer(ExtractionCell::image(picture(), 3)).why == stripe_t::UNREADABLE_IMAGE);
}
