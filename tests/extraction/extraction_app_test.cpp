// The service on an in-memory bus: one stripe for each image, whatever the image.
#include "services/extraction/extraction_app.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "common/bus/crc32c.hpp"
#include "services/extraction/extraction_app.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

cv::Mat picture(double at = 60, double width = 2) {
  cv::Mat light = darkness(320, 160);
  add_stripe(light, -10, at, 330, at + 17, 150, width);
  return expose(light, 2);
}

void put_checksum(image_t& image) {
  image.size = static_cast<std::int32_t>(image.data.size());
  image.crc32c = image.data.empty() ? 0 : crc32c(image.data);
}

class Cell {
 public:
  explicit Cell(const ExtractionSettings& settings = {})
      : bus_(Bus::in_memory()), app_(*bus_, settings, Instance{}) {
    bus_->subscribe<stripe_t>("LASER0_STRIPE", Queue::measurements(),
                              [this](const stripe_t& stripe) { stripes_.push_back(stripe); });
  }

  static image_t image(const cv::Mat& grey, std::int64_t seq, std::int64_t scan_id = 1000) {
    image_t message{};
    message.utime = 1'000'000 + seq * 71'428;
    message.run_id = 77;
    message.seq = seq;
    message.scan_id = scan_id;
    message.scan_index = scan_id == 0 ? -1 : static_cast<std::int32_t>(seq);
    message.width = static_cast<std::int16_t>(grey.cols);
    message.height = static_cast<std::int16_t>(grey.rows);
    message.sensor_width = 1600;
    message.sensor_height = 1200;
    message.exposure_us = 1000;
    message.laser_on = 1;
    message.encoding = image_t::MONO8;
    message.data.assign(grey.datastart, grey.dataend);
    put_checksum(message);
    return message;
  }

  const stripe_t& answer(const image_t& image) {
    const std::size_t before = stripes_.size();
    bus_->publish("LASER0_IMAGE", image);
    while (bus_->handle(std::chrono::milliseconds(0))) {
    }
    REQUIRE(stripes_.size() == before + 1);
    const stripe_t& stripe = stripes_.back();
    CHECK(stripe.utime == image.utime);
    CHECK(stripe.run_id == image.run_id);
    CHECK(stripe.seq == image.seq);
    CHECK(stripe.scan_id == image.scan_id);
    CHECK(stripe.scan_index == image.scan_index);
    CHECK(meaning_error(stripe).empty());
    CHECK((stripe.count == 0) == (stripe.why != stripe_t::NONE));
    CHECK((stripe.count == 0) == !stripe.empty.empty());
    return stripe;
  }
  Health health() const { return app_.health(); }

  void send(const image_t& image) {
    bus_->publish("LASER0_IMAGE", image);
    while (bus_->handle(std::chrono::milliseconds(0))) {
    }
  }
  std::size_t stripes() const { return stripes_.size(); }
  void calibrate(int width, int height) {
    calibration_t message{};
    message.id = "a";
    message.width = width;
    message.height = height;
    message.laser_plane[2] = message.camera_quaternion[0] = 1;
    message.camera_limit = message.laser_plane_limit = message.leave_one_out_limit = -1;
    message.predicted_limit = message.robot_position_limit = message.robot_orientation_limit = -1;
    bus_->publish("LASER0_CALIBRATION", message);
    while (bus_->handle(std::chrono::milliseconds(0))) {
    }
  }

 private:
  std::unique_ptr<Bus> bus_;
  ExtractionApp app_;
  std::vector<stripe_t> stripes_;
};

std::vector<std::uint8_t> encode(const stripe_t& stripe) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stripe.getEncodedSize()));
  stripe.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

TEST_CASE("an image's stripe lies where it is on the full sensor") {
  Cell cell;
  image_t image = Cell::image(picture(), 0);
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
  image_t image = Cell::image(picture(), 0);
  const stripe_t plain = Cell().answer(image);
  cv::imencode(".png", picture(), image.data);
  put_checksum(image);
  image.encoding = image_t::PNG;
  CHECK(encode(Cell().answer(image)) == encode(plain));
}

TEST_CASE("what holds no stripe gives an empty one with its reason") {
  Cell cell;
  std::int64_t seq = 0;
  std::int8_t why = stripe_t::NONE;  // of the last
  const auto reason = [&](image_t image) {
    image.seq = seq;
    image.scan_index = static_cast<std::int32_t>(seq++);
    const stripe_t& stripe = cell.answer(image);
    why = stripe.why;
    return stripe.empty;
  };
  image_t incomplete = Cell::image(picture(), 0);
  incomplete.incomplete = "3 packets missing";
  incomplete.data.clear();
  put_checksum(incomplete);
  CHECK(reason(incomplete) == "image incomplete: 3 packets missing");
  CHECK(why == stripe_t::INCOMPLETE_IMAGE);
  image_t dark = Cell::image(picture(), 0);
  dark.laser_on = 0;
  CHECK(reason(dark) == "laser off");
  CHECK(why == stripe_t::LASER_OFF);
  CHECK(reason(Cell::image(cv::Mat(160, 320, CV_8U, cv::Scalar(0)), 0)) == "no stripe found");
  CHECK(reason(Cell::image(cv::Mat(160, 320, CV_8U, cv::Scalar(255)), 0)) == "no stripe found");
  CHECK(reason(Cell::image(cv::Mat(1, 1, CV_8U, cv::Scalar(7)), 0)) == "no stripe found");
  CHECK(why == stripe_t::NO_STRIPE);
  image_t coloured = Cell::image(picture(), 0);
  coloured.encoding = image_t::BAYER_RG8;
  CHECK(reason(coloured) == "encoding 3 is not read yet: send MONO8 or PNG");
  CHECK(why == stripe_t::UNKNOWN_ENCODING);

  image_t png = Cell::image(picture(), 0);
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
  CHECK(reason(Cell::image(picture(), 0)).empty());
  CHECK(cell.health().lost == 0);
}

TEST_CASE("gaps in a scan's sequence are counted as lost, what lies between scans is not") {
  Cell cell;
  const cv::Mat grey = picture();
  for (const int seq : {0, 1, 2, 5, 6}) cell.answer(Cell::image(grey, seq));
  CHECK(cell.health().lost == 2);
  CHECK(cell.health().last_error.find("seq 5") != std::string::npos);
  cell.answer(Cell::image(grey, 90, 0));  // single images outside a scan
  cell.answer(Cell::image(grey, 120, 0));
  CHECK(cell.health().lost == 2);
  image_t next = Cell::image(grey, 500, 2000);
  next.scan_index = 0;
  cell.answer(next);
  CHECK(cell.health().lost == 2);
  image_t late = Cell::image(grey, 700, 3000);  // the first three of this scan did not come
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
  Cell cell;
  cell.answer(Cell::image(picture(), 0));
  image_t damaged = Cell::image(picture(), 1);
  damaged.data[20'000] ^= 1;
  cell.send(damaged);
  CHECK(cell.stripes() == 1);
  cell.answer(Cell::image(picture(), 2));
  CHECK(cell.health().lost == 1);
  CHECK_THAT(cell.health().last_error,
             Catch::Contains("1 images lost before seq 2") && Catch::Contains("CRC-32C"));
  cell.answer(Cell::image(picture(), 5));  // these did not come at all
  CHECK(cell.health().lost == 3);
  CHECK_THAT(cell.health().last_error,
             Catch::Contains("2 images lost before seq 5") && Catch::Contains("receive buffer"));
}

TEST_CASE("an image of another sensor than the calibration's is refused before it is decoded") {
  Cell cell;
  image_t huge = Cell::image(picture(), 0);
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
  CHECK(cell.answer(Cell::image(picture(), 2)).empty.empty());
  cell.calibrate(1600, 1201);
  CHECK(cell.answer(Cell::image(picture(), 3)).why == stripe_t::UNREADABLE_IMAGE);
}

TEST_CASE("where the laser is on and off by turns, the image before is subtracted") {
  // Another line, brighter than the stripe, that does not come from the laser.
  cv::Mat ambient = darkness(320, 160);
  add_stripe(ambient, -10, 110, 330, 100, 200, 2);
  cv::Mat lit = ambient.clone();
  add_stripe(lit, -10, 60, 330, 77, 100, 2);
  Cell cell;
  const auto far_from_stripe = [](const stripe_t& stripe) {
    int count = 0;
    for (int i = 0; i < stripe.count; ++i)
      count += std::abs(stripe.v[i] - 60 - 0.05 * (stripe.u[i] + 10)) > 2;
    return count;
  };
  image_t off = Cell::image(expose(ambient, 2, 1), 0);
  off.laser_on = 0;
  CHECK(cell.answer(off).empty == "laser off");
  const stripe_t& stripe = cell.answer(Cell::image(expose(lit, 2, 2), 1));
  CHECK(stripe.count > 280);
  CHECK(far_from_stripe(stripe) == 0);
  // The image before was not one with the laser off, or was taken in another way.
  CHECK(far_from_stripe(cell.answer(Cell::image(expose(lit, 2, 3), 2))) > 280);
  off.seq = off.scan_index = 3;
  cell.answer(off);
  image_t longer = Cell::image(expose(lit, 2, 4), 4);
  longer.exposure_us *= 2;
  CHECK(far_from_stripe(cell.answer(longer)) > 280);
}

TEST_CASE("clipping is judged before the unlit image is subtracted") {
  // A bright plate leaves the laser 75 grey values: the difference's top is flat, and not white.
  cv::Mat lit = darkness(320, 160, 180), unlit = lit.clone();
  add_stripe(lit, -10, 60, 330, 77, 200, 3);
  lit(cv::Rect(0, 120, 320, 20)) += 200;  // by the lamp alone
  unlit(cv::Rect(0, 120, 320, 20)) += 200;
  Cell cell;
  image_t off = Cell::image(expose(unlit, 1, 1), 0);
  off.laser_on = 0;
  cell.answer(off);
  const stripe_t& stripe = cell.answer(Cell::image(expose(lit, 1, 2), 1));
  CHECK(stripe.count > 280);
  CHECK(stripe.saturated_share > 0.9);
  for (int i = 0; i < stripe.count; ++i) {
    if (stripe.rank[i] != stripe_t::CHOSEN) continue;
    CHECK(std::abs(stripe.v[i] - 60 - 0.05 * (stripe.u[i] + 10)) < 0.5);
  }
}

TEST_CASE("sigma begins anew with each scan, and single images leave no trace") {
  Cell cell;
  const cv::Mat narrow = picture(60, 1.5), wide = picture(60, 3.5);
  const float first = cell.answer(Cell::image(narrow, 0)).sigma;
  CHECK(cell.answer(Cell::image(wide, 1)).sigma <
        1.2 * first);  // within the scan it follows slowly
  image_t other = Cell::image(wide, 40, 2000);
  other.scan_index = 0;
  CHECK(cell.answer(other).sigma > 2 * first);
  CHECK(cell.answer(Cell::image(narrow, 50, 0)).sigma == first);
  CHECK(cell.answer(Cell::image(wide, 60, 0)).sigma > 2 * first);
}

TEST_CASE("the same images give the same stripes, byte by byte") {
  const auto run = [] {
    Cell cell;
    std::vector<std::uint8_t> all;
    for (int seq = 0; seq < 5; ++seq) {
      const auto bytes =
          encode(cell.answer(Cell::image(picture(50 + 3 * seq, 1.5 + 0.1 * seq), seq)));
      all.insert(all.end(), bytes.begin(), bytes.end());
    }
    return all;
  };
  CHECK(run() == run());
}
