// The service extraction on a bus in memory, and images for it.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "common/bus/crc32c.hpp"
#include "services/extraction/extraction_app.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart::extraction {

inline cv::Mat picture(double at = 60, double width = 2) {
  cv::Mat light = darkness(320, 160);
  add_stripe(light, -10, at, 330, at + 17, 150, width);
  return expose(light, 2);
}

inline void put_checksum(image_t& image) {
  image.size = static_cast<std::int32_t>(image.data.size());
  image.crc32c = image.data.empty() ? 0 : crc32c(image.data);
}

class ExtractionCell {
 public:
  explicit ExtractionCell(const ExtractionSettings& settings = {})
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

inline std::vector<std::uint8_t> encode(const stripe_t& stripe) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stripe.getEncodedSize()));
  stripe.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace arcstart::extraction
