// The service `extraction`: <SENSOR>_IMAGE in, <SENSOR>_STRIPE out, exactly one for each. Of
// <SENSOR>_CALIBRATION it takes the sensor's size alone.
#pragma once

#include <arcstart/calibration_t.hpp>
#include <arcstart/image_t.hpp>
#include <arcstart/stripe_t.hpp>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/service.hpp"
#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::extraction {

class ExtractionApp : public App {
 public:
  // bus must outlive the app.
  ExtractionApp(Bus& bus, const ExtractionSettings& settings, const Instance& instance);

  Health health() const override { return health_; }

 private:
  void take(const image_t& image);
  void count_lost(const image_t& image);
  stripe_t stripe_of(const image_t& image);
  // Why there are none, kNone where there are; detail as to_words() wants it.
  EmptyStripe grey_values(const image_t& image, GreyImage& grey, std::string& detail);
  void keep_laser_off(const image_t& image, const GreyImage& grey);
  GreyImage without_ambient_light(const image_t& image, const GreyImage& grey);

  Bus& bus_;
  std::string stripe_channel_;
  StripeExtractor extractor_;
  cv::Mat decoded_;
  std::vector<std::uint8_t> difference_;
  Stripe stripe_;
  Health health_;

  int sensor_width_ = 0, sensor_height_ = 0;  // the calibration's, 0 before the first; px
  std::int64_t dropped_ = 0;                  // by the bus, before the newest image

  // Of the image before.
  std::int64_t run_id_ = -1, scan_id_ = 0, seq_ = -1;

  // The newest image taken with the laser off; laser_off_ without its bytes.
  image_t laser_off_{};
  cv::Mat laser_off_grey_;
};

// The whole main of arcstart-extraction.
int run(int argc, char** argv);

}  // namespace arcstart::extraction
