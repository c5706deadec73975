#include "tests/command_line/support/synthetic_recording.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "common/bus/crc32c.hpp"
#include "services/extraction/empty_stripe.hpp"
#include "services/extraction/extraction_settings.hpp"
#include "services/reconstruction/empty_profile.hpp"
#include "services/reconstruction/reconstruction_settings.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"
#include "tests/command_line/support/closed_form_cell.hpp"

namespace arcstart::test {

using namespace command_line;
using namespace extraction;
using namespace reconstruction;
using namespace seam_finding;
namespace {

constexpr std::int64_t kSecond = 1'000'000;           // us
constexpr std::int64_t kDuration = 13 * kSecond;      // of the recording
constexpr std::int64_t kScanDuration = 3'400'000;     // us
constexpr std::int64_t kRun = kBegin - 60 * kSecond;  // run_id
constexpr int kImages = 46;                           // a scan

std::int64_t image_utime(std::int64_t scan_id, int index) {
  return scan_id + 50'000 + index * kSecond / 14;
}

template <class Message>
void put_source(Message& message, std::int64_t scan_id, int index) {
  message.utime = image_utime(scan_id, index);
  message.run_id = kRun;
  message.seq = (message.utime - kRun) * 14 / kSecond;
  message.scan_id = scan_id;
  message.scan_index = index;
}

class Recorder {
 public:
  explicit Recorder(const Recorded& recorded)
      : recorded_(recorded), calibration_(calibration_of_cell(recorded.sensor, recorded.robot)) {}

  Events record() {
    for (std::int64_t t = 0; t < kDuration; t += 20'000) put_pose(t);
    for (std::int64_t t = 0; t < kDuration; t += kSecond) put_states(t);
    for (std::int64_t t = 0; t < kDuration; t += 200'000) put_scan(t);
    for (const std::int64_t scan : scans()) {
      put_scan(scan - kBegin);
      put_scan(scan + kScanDuration - kBegin);
      for (int i = 0; i < kImages; ++i) put_measurement(scan, i);
    }
    sort(events_);
    return std::move(events_);
  }

 private:
  std::vector<std::int64_t> scans() const {
    std::vector<std::int64_t> ids;
    if (recorded_.background) ids.push_back(kBackgroundScan);
    if (recorded_.workpiece) ids.push_back(kWorkpieceScan);
    return ids;
  }

  template <class Message>
  void put(std::int64_t utime, std::int64_t latency, const std::string& channel,
           const Message& message) {
    events_.push_back({utime + latency, channel, encoded(message)});
  }

  void put_pose(std::int64_t t) {
    robot_pose_t pose{};
    pose.utime = kBegin + t;
    pose.run_id = kRun;
    pose.seq = t / 20'000;
    pose.source = robot_pose_t::HSPO;
    pose.tool_frame = pose.user_frame = -1;
    const RigidTransform T_base_tool =
        T_base_camera(static_cast<double>(t) * 1e-6) * calibration_.T_tool_camera.inverse();
    transform_to_arrays(T_base_tool, pose.position, pose.quaternion);
    put(pose.utime, 2'000, recorded_.robot + "_POSE", pose);
  }

  void put_states(std::int64_t t) {
    put(kBegin + t, 1'000, recorded_.sensor + "_CALIBRATION", to_message(calibration_));
    const auto status = [&](const std::string& channel, const std::string& service,
                            const std::string& configuration) {
      service_status_t message{};
      message.utime = kBegin + t;
      message.run_id = kRun;
      message.state = service_status_t::RUNNING;
      message.service = service;
      message.configuration = configuration;
      put(message.utime, 3'000, recorded_.sensor + "_" + channel + "_STATUS", message);
    };
    status("EXTRACTION", "extraction",
           write_settings("extraction", extraction::ExtractionSettings{}));
    status("RECONSTRUCTION", "reconstruction",
           write_settings("reconstruction", reconstruction::ReconstructionSettings{}));
    status("SEAM_FINDING", "seam_finding",
           write_settings("seam_finding", seam_finding::SeamFindingSettings{}));
  }

  void put_scan(std::int64_t t) {
    scan_t state{};
    state.utime = kBegin + t;
    state.run_id = kRun;
    state.first_seq = state.last_seq = -1;
    state.previous_first_seq = state.previous_last_seq = -1;
    state.clock_bound = 0;  // one clock
    for (const std::int64_t scan : scans()) {
      if (state.utime < scan) break;
      state.previous_scan_id = state.scan_id;
      state.previous_kind = state.kind;
      state.previous_end_utime = state.end_utime;
      state.previous_end_cause = state.end_cause;
      state.previous_first_seq = state.first_seq;
      state.previous_last_seq = state.last_seq;
      state.previous_images = state.images;
      state.scan_id = state.begin_utime = scan;
      state.command_id = scan % 1000 + 1;
      state.kind = scan == kBackgroundScan ? scan_t::BACKGROUND : scan_t::WORKPIECE;
      const bool ended = state.utime >= scan + kScanDuration;
      state.state = ended ? scan_t::ENDED : scan_t::SCANNING;
      state.end_utime = ended ? scan + kScanDuration : 0;
      state.end_cause = ended ? scan_t::STOP : scan_t::NONE;
      state.end_reason = ended ? "stop" : "";
      state.start_command_id = state.command_id;
      state.images = 0;
      state.first_seq = state.last_seq = -1;
      image_t image{};
      for (int i = 0; i < kImages && image_utime(scan, i) < state.utime; ++i) {
        put_source(image, scan, i);
        if (i == 0) state.first_seq = image.seq;
        state.last_seq = image.seq;
        ++state.images;
      }
    }
    put(state.utime, 1'000, recorded_.sensor + "_SCAN", state);
  }

  void put_measurement(std::int64_t scan, int index) {
    const double seconds =
        static_cast<double>(image_utime(scan, index) - kBegin) * 1e-6 + kTimeOffset;
    const RigidTransform T = T_base_camera(seconds);
    const auto points = lit_points(transform_plane(T, calibration_.sensor_model.laser_plane),
                                   scan == kWorkpieceScan);
    std::vector<Eigen::Vector2d> pixels;
    for (const auto& point : points)
      pixels.push_back(project(calibration_.sensor_model, T.inverse() * point.position));
    if (recorded_.images) put_image(scan, index, pixels);
    if (recorded_.stripes) put_stripe(scan, index, points, pixels);
    if (recorded_.profiles) put_profile(scan, index, points, pixels, T);
  }

  // A line of Gaussian profile, 2 px, on black.
  void put_image(std::int64_t scan, int index, const std::vector<Eigen::Vector2d>& pixels) {
    const SensorModel& model = calibration_.sensor_model;
    cv::Mat picture = cv::Mat::zeros(model.height, model.width, CV_8U);
    for (const auto& pixel : pixels) {
      const int column = static_cast<int>(std::lround(pixel.x()));
      if (column < 0 || column >= model.width) continue;
      for (int row = std::max(0, static_cast<int>(pixel.y()) - 8);
           row < std::min(model.height, static_cast<int>(pixel.y()) + 9); ++row) {
        const double value = 180 * std::exp(-0.5 * std::pow((row - pixel.y()) / 2, 2));
        picture.at<std::uint8_t>(row, column) =
            std::max(picture.at<std::uint8_t>(row, column), static_cast<std::uint8_t>(value));
      }
    }
    image_t image{};
    put_source(image, scan, index);
    image.width = image.sensor_width = static_cast<std::int16_t>(model.width);
    image.height = image.sensor_height = static_cast<std::int16_t>(model.height);
    image.exposure_us = 2000;
    image.laser_on = 1;
    image.arrival_utime = image.utime + 30'000;
    image.encoding = image_t::PNG;
    cv::imencode(".png", picture, image.data, {cv::IMWRITE_PNG_COMPRESSION, 1});
    image.size = static_cast<std::int32_t>(image.data.size());
    image.crc32c = crc32c(image.data);
    put(image.utime, 40'000, recorded_.sensor + "_IMAGE", image);
  }

  void put_stripe(std::int64_t scan, int index, const std::vector<SurfacePoint>& points,
                  const std::vector<Eigen::Vector2d>& pixels) {
    stripe_t stripe{};
    put_source(stripe, scan, index);
    stripe.sensor_width = static_cast<std::int16_t>(calibration_.sensor_model.width);
    stripe.sensor_height = static_cast<std::int16_t>(calibration_.sensor_model.height);
    std::normal_distribution<double> noise(0, 0.05);  // px
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool begins = i == 0 || points[i - 1].segment != points[i].segment;
      const bool ends = i + 1 == points.size() || points[i + 1].segment != points[i].segment;
      stripe.u.push_back(static_cast<float>(pixels[i].x()));
      stripe.v.push_back(static_cast<float>(pixels[i].y() + noise(random_)));
      stripe.strength.push_back(30);
      stripe.width.push_back(2);
      stripe.deviation.push_back(0.05F);
      stripe.segment.push_back(points[i].segment);
      stripe.rank.push_back(stripe_t::CHOSEN);
      stripe.segment_end.push_back(begins || ends ? stripe_t::EDGE : stripe_t::CONTINUES);
    }
    stripe.count = static_cast<std::int32_t>(points.size());
    stripe.sigma = 2;
    if (points.empty()) {
      stripe.why = stripe_t::NO_STRIPE;
      stripe.empty = to_words(EmptyStripe::kNoStripe);
    }
    put(stripe.utime, 60'000, recorded_.sensor + "_STRIPE", stripe);
  }

  // Every third point, about as far apart as down-sampling leaves them.
  void put_profile(std::int64_t scan, int index, const std::vector<SurfacePoint>& points,
                   const std::vector<Eigen::Vector2d>& pixels, const RigidTransform& T) {
    profile_t profile{};
    put_source(profile, scan, index);
    std::normal_distribution<double> noise(0, 0.02);  // mm
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool begins = i == 0 || points[i - 1].segment != points[i].segment;
      const bool ends = i + 1 == points.size() || points[i + 1].segment != points[i].segment;
      if (i % 3 != 0 && !begins && !ends) continue;
      profile.x.push_back(static_cast<float>(points[i].position.x() + noise(random_)));
      profile.y.push_back(static_cast<float>(points[i].position.y() + noise(random_)));
      profile.z.push_back(static_cast<float>(points[i].position.z() + noise(random_)));
      profile.u.push_back(static_cast<float>(pixels[i].x()));
      profile.v.push_back(static_cast<float>(pixels[i].y()));
      profile.deviation.push_back(0.02F);
      profile.segment.push_back(points[i].segment);
      profile.segment_end.push_back(begins || ends ? profile_t::EDGE : profile_t::CONTINUES);
    }
    profile.count = static_cast<std::int32_t>(profile.x.size());
    transform_to_arrays(T * calibration_.T_tool_camera.inverse(), profile.tool_position,
                        profile.tool_quaternion);
    Eigen::Map<Eigen::Vector3d>{profile.camera_centre} = T.translation();
    profile.calibration_id = calibration_.id;
    if (profile.count == 0) {
      profile.why = profile_t::NO_STRIPE;
      profile.empty = to_words(EmptyProfile::kNoStripe, to_words(EmptyStripe::kNoStripe));
    }
    put(profile.utime, 80'000, recorded_.sensor + "_PROFILE", profile);
  }

  Recorded recorded_;
  Calibration calibration_;
  std::mt19937 random_{5};
  Events events_;
};

}  // namespace

Events record(const Recorded& recorded) { return Recorder(recorded).record(); }

void sort(Events& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.timestamp < b.timestamp; });
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "arcstart-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder: " + name);
  path_ = name;
}

Folder::~Folder() { std::filesystem::remove_all(path_); }

std::string Folder::save(const std::string& name, const Events& events) const {
  EventLogWriter writer(*this / name);
  for (const auto& event : events) writer.write(event.timestamp, event.channel, event.bytes);
  writer.close();
  return *this / name;
}

}  // namespace arcstart::test
