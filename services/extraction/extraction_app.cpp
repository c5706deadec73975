#include "services/extraction/extraction_app.hpp"

#include <fmt/core.h>

#include <utility>

#include "services/extraction/files/image_decoding.hpp"
#include "services/extraction/image/laser_light.hpp"

namespace arcstart::extraction {

static_assert(static_cast<int>(SegmentEnd::kContinues) == stripe_t::CONTINUES);
static_assert(static_cast<int>(SegmentEnd::kEdge) == stripe_t::EDGE);
static_assert(static_cast<int>(SegmentEnd::kGap) == stripe_t::GAP);
static_assert(static_cast<int>(SegmentEnd::kBorder) == stripe_t::BORDER);
static_assert(static_cast<int>(SegmentEnd::kSaturation) == stripe_t::SATURATION);
static_assert(static_cast<int>(EmptyStripe::kNone) == stripe_t::NONE);
static_assert(static_cast<int>(EmptyStripe::kNoStripe) == stripe_t::NO_STRIPE);
static_assert(static_cast<int>(EmptyStripe::kTooMuchLight) == stripe_t::TOO_MUCH_LIGHT);
static_assert(static_cast<int>(EmptyStripe::kIncompleteImage) == stripe_t::INCOMPLETE_IMAGE);
static_assert(static_cast<int>(EmptyStripe::kLaserOff) == stripe_t::LASER_OFF);
static_assert(static_cast<int>(EmptyStripe::kUnreadableImage) == stripe_t::UNREADABLE_IMAGE);
static_assert(static_cast<int>(EmptyStripe::kUnknownEncoding) == stripe_t::UNKNOWN_ENCODING);

namespace {

// Of a scan: 20 minutes at 14 Hz. A number beyond is damage or a stranger's, and says nothing.
constexpr std::int64_t kMostLost = 20'000;

cv::Mat view(const GreyImage& grey) {
  return {grey.height, grey.width, CV_8U, const_cast<std::uint8_t*>(grey.data),
          static_cast<std::size_t>(grey.stride)};
}
GreyImage view(const cv::Mat& grey) {
  return {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step)};
}

}  // namespace

ExtractionApp::ExtractionApp(Bus& bus, const ExtractionSettings& settings, const Instance& instance)
    : bus_(bus), stripe_channel_(instance.sensor_channel("STRIPE")), extractor_(settings) {
  bus_.subscribe<image_t>(instance.sensor_channel("IMAGE"), Queue::images(),
                          [this](const image_t& image) { take(image); });
  bus_.subscribe<calibration_t>(instance.sensor_channel("CALIBRATION"), Queue::measurements(),
                                [this](const calibration_t& message) {
                                  sensor_width_ = message.width;
                                  sensor_height_ = message.height;
                                });
}

void ExtractionApp::take(const image_t& image) {
  count_lost(image);
  // Outside a scan every image stands alone; a scan's first image begins anew.
  if (image.scan_id == 0 || image.scan_id != scan_id_ || image.run_id != run_id_)
    extractor_.restart();
  run_id_ = image.run_id;
  scan_id_ = image.scan_id;
  seq_ = image.seq;
  bus_.publish(stripe_channel_, stripe_of(image));
}

// Within a scan every frame comes, also an incomplete one; between scans the camera runs on unsent.
void ExtractionApp::count_lost(const image_t& image) {
  if (image.scan_id == 0) return;
  const bool same_scan = image.scan_id == scan_id_ && image.run_id == run_id_;
  const std::int64_t lost = same_scan ? image.seq - seq_ - 1 : image.scan_index;
  // What this process itself has not taken in it can name.
  const std::int64_t dropped = bus_.undecodable() + bus_.overflowed();
  const bool dropped_here = dropped > std::exchange(dropped_, dropped);
  if (lost <= 0 || lost > kMostLost) return;
  health_.lost += lost;
  health_.last_error =
      fmt::format("{} images lost before seq {}: {}", lost, image.seq,
                  dropped_here ? bus_.last_error()
                               : "see the receive buffer's size and the camera's statistics");
}

EmptyStripe ExtractionApp::grey_values(const image_t& image, GreyImage& grey, std::string& detail) {
  if (!image.incomplete.empty()) {
    detail = image.incomplete;
    return EmptyStripe::kIncompleteImage;
  }
  const std::uint8_t* data = image.data.data();
  EmptyStripe why = EmptyStripe::kNone;
  if (image.width <= 0 || image.height <= 0) {
    detail = "image has no size";
  } else if (sensor_width_ != 0 &&
             (image.sensor_width != sensor_width_ || image.sensor_height != sensor_height_)) {
    // Before it is decoded: a small PNG may stand for gigabytes. That the image lies within its
    // sensor is a message's meaning.
    detail = fmt::format(
        "its sensor has {} x {} pixels, the calibration's {} x {}: of which camera "
        "is it?",
        image.sensor_width, image.sensor_height, sensor_width_, sensor_height_);
  } else if (image.encoding == image_t::PNG) {
    detail = decode_grey_png(data, image.data.size(), image.width, image.height, decoded_);
    data = decoded_.data;
  } else if (image.encoding != image_t::MONO8) {
    why = EmptyStripe::kUnknownEncoding;
    detail = std::to_string(image.encoding);
  } else if (image.data.size() != static_cast<std::size_t>(image.width) * image.height) {
    detail =
        fmt::format("{} bytes for {} x {} pixels", image.data.size(), image.width, image.height);
  }
  if (!detail.empty()) {
    if (why == EmptyStripe::kNone) why = EmptyStripe::kUnreadableImage;
    health_.last_error = fmt::format("image seq {}: {}", image.seq, to_words(why, detail));
    return why;
  }
  grey = {
      data, image.width, image.height,
      image.encoding == image_t::PNG ? static_cast<std::ptrdiff_t>(decoded_.step) : image.width};
  return EmptyStripe::kNone;
}

void ExtractionApp::keep_laser_off(const image_t& image, const GreyImage& grey) {
  view(grey).copyTo(laser_off_grey_);
  laser_off_.run_id = image.run_id;
  laser_off_.scan_id = image.scan_id;
  laser_off_.seq = image.seq;
  laser_off_.offset_u = image.offset_u;
  laser_off_.offset_v = image.offset_v;
  laser_off_.exposure_us = image.exposure_us;
  laser_off_.gain_db = image.gain_db;
}

// Where the camera takes images with the laser on and off by turns, the one before shows what else
// lights the scene: taken of the same region in the same way, it is subtracted.
GreyImage ExtractionApp::without_ambient_light(const image_t& image, const GreyImage& grey) {
  const bool fits = laser_off_grey_.cols == grey.width && laser_off_grey_.rows == grey.height &&
                    laser_off_.run_id == image.run_id && laser_off_.scan_id == image.scan_id &&
                    laser_off_.seq == image.seq - 1 && laser_off_.offset_u == image.offset_u &&
                    laser_off_.offset_v == image.offset_v &&
                    laser_off_.exposure_us == image.exposure_us &&
                    laser_off_.gain_db == image.gain_db;
  return fits ? laser_light(grey, view(laser_off_grey_), difference_) : grey;
}

stripe_t ExtractionApp::stripe_of(const image_t& image) {
  stripe_t message{};
  message.utime = image.utime;
  message.run_id = image.run_id;
  message.seq = image.seq;
  message.scan_id = image.scan_id;
  message.scan_index = image.scan_index;
  message.sensor_width = image.sensor_width;
  message.sensor_height = image.sensor_height;

  GreyImage grey;
  std::string detail;
  EmptyStripe why = grey_values(image, grey, detail);
  if (why == EmptyStripe::kNone && !image.laser_on) {
    keep_laser_off(image, grey);
    why = EmptyStripe::kLaserOff;
  }
  if (why != EmptyStripe::kNone) {
    message.why = static_cast<std::int8_t>(why);
    message.empty = to_words(why, detail);
    return message;
  }
  extractor_.extract(without_ambient_light(image, grey), stripe_);
  const Stripe& stripe = stripe_;
  message.sigma = stripe.sigma;
  message.noise = stripe.noise;
  message.saturated_share = stripe.saturated_share;
  message.why = static_cast<std::int8_t>(stripe.why);
  message.empty = stripe.empty;
  message.count = static_cast<std::int32_t>(stripe.centres.size());
  for (const StripeCentre& centre : stripe.centres) {
    message.u.push_back(centre.u + static_cast<float>(image.offset_u));
    message.v.push_back(centre.v + static_cast<float>(image.offset_v));
    message.strength.push_back(centre.strength);
    message.width.push_back(centre.width);
    message.deviation.push_back(centre.deviation);
    message.segment.push_back(centre.segment);
    message.rank.push_back(centre.chosen ? stripe_t::CHOSEN : stripe_t::SECOND_CANDIDATE);
    message.segment_end.push_back(static_cast<std::int8_t>(centre.end));
  }
  return message;
}

}  // namespace arcstart::extraction
