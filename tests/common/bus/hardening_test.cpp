// The hardened headers against hostile counts and lengths, and the types' fingerprints.
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/bus/message_checks.hpp"
#include "paths.hpp"

using namespace arcstart;

namespace {

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

// Puts each hostile number over every 4 bytes of a message in turn: wherever counts and string
// lengths lie, they are hit. Decoding must end, allocate little and give -1 or a size within the
// message.
template <class Message>
void attack(const Message& message) {
  const auto good = bytes_of(message);
  for (std::size_t at = 8; at + 4 <= good.size(); ++at)
    for (const std::uint32_t hostile :
         {0u, 0xFFFFFFFFu, 0x80000000u, 0x7FFFFFFFu, 0x40000001u, 0x3B9ACA00u}) {
      auto bytes = good;
      for (int i = 0; i < 4; ++i)
        bytes[at + static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(hostile >> (24 - 8 * i));
      Message decoded{};
      const int size = decoded.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
      CHECK(size <= static_cast<int>(bytes.size()));
    }
}

}  // namespace

TEST_CASE("hostile counts and string lengths never crash a decoder") {
  stripe_t stripe{};
  stripe.count = 3;
  for (auto* list : {&stripe.u, &stripe.v, &stripe.strength, &stripe.width, &stripe.deviation})
    list->assign(3, 1.f);
  stripe.segment.assign(3, 0);
  stripe.rank.assign(3, 0);
  stripe.segment_end.assign(3, 0);
  attack(stripe);
  profile_t profile{};
  profile.count = 2;
  for (auto* list :
       {&profile.x, &profile.y, &profile.z, &profile.u, &profile.v, &profile.deviation})
    list->assign(2, 1.f);
  profile.segment.assign(2, 0);
  profile.segment_end.assign(2, 0);
  profile.calibration_id = "abc";
  attack(profile);
  image_t image{};
  image.size = 5;
  image.data.assign(5, 7);
  attack(image);
  robot_pose_t pose{};
  pose.joint_count = 2;
  pose.joints.assign(2, 0.5);
  attack(pose);
  calibration_t calibration{};
  calibration.covariance_size = 2;
  calibration.covariance.assign(2, {1, 2});
  attack(calibration);
  seam_t seam{};
  seam.polyline_count = 1;
  seam.polyline.assign(1, {1, 2, 3});
  seam.station_count = 1;
  seam.stations.resize(1);
  seam.alternative_count = 2;
  seam.alternatives.resize(2);
  attack(seam);
  attack(scan_t{});
  attack(scan_command_t{});
  attack(camera_command_t{});
  attack(calibration_command_t{});
  calibration_capture_t capture{};
  capture.pose_count = 2;
  capture.poses.resize(2);
  attack(capture);
  attack(service_status_t{});
  attack(cell_command_t{});
  attack(clock_probe_t{});
  attack(delivery_t{});
  attack(truth_t{});
}

TEST_CASE("a count of -1 or beyond the packet is refused") {
  image_t image{};
  image.size = 4;
  image.data.assign(4, 0);
  auto bytes = bytes_of(image);
  for (const std::int32_t hostile : {-1, 5, 0x7fffffff, 1'000'000'000}) {
    for (int i = 0; i < 4; ++i)
      bytes[bytes.size() - 8 + static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(static_cast<std::uint32_t>(hostile) >> (24 - 8 * i));
    CHECK(image_t().decode(bytes.data(), 0, static_cast<int>(bytes.size())) == -1);
  }
}

// LCM's hash covers neither a type's name nor its constants: both stand in fingerprints.txt, beside
// the hash.
TEST_CASE("types have the fingerprints that recordings rely on") {
  std::ostringstream now;
  const auto line = [&](auto message, const std::string& constants) {
    now << decltype(message)::getTypeName() << ' ' << std::hex
        << static_cast<std::uint64_t>(decltype(message)::getHash()) << std::dec << constants
        << '\n';
  };
#define VALUE(type, name) " " #name "=" + std::to_string(static_cast<long>(type::name))
  line(calibration_capture_t{}, VALUE(calibration_capture_t, IDLE) +
                                    VALUE(calibration_capture_t, CAPTURING) +
                                    VALUE(calibration_capture_t, SOLVING));
  line(calibration_command_t{}, VALUE(calibration_command_t, CAPTURE) +
                                    VALUE(calibration_command_t, DISCARD) +
                                    VALUE(calibration_command_t, SOLVE));
  line(calibration_pose_t{}, "");
  line(calibration_t{}, VALUE(calibration_t, PARAMETERS) + VALUE(calibration_t, NOT_JUDGED) +
                            VALUE(calibration_t, PASSED) + VALUE(calibration_t, FAILED));
  line(camera_command_t{}, VALUE(camera_command_t, LASER_OFF) + VALUE(camera_command_t, LASER_ON) +
                               VALUE(camera_command_t, LASER_AS_CONFIGURED));
  line(cell_command_t{}, VALUE(cell_command_t, KEEP) + VALUE(cell_command_t, BACKGROUND) +
                             VALUE(cell_command_t, WORKPIECE) + VALUE(cell_command_t, PLATE));
  line(clock_probe_t{}, "");
  line(delivery_t{}, VALUE(delivery_t, NOTHING) + VALUE(delivery_t, PENDING) +
                         VALUE(delivery_t, WRITING) + VALUE(delivery_t, DELIVERED) +
                         VALUE(delivery_t, TAKEN) + VALUE(delivery_t, DONE) +
                         VALUE(delivery_t, VALID));
  line(image_t{}, VALUE(image_t, MONO8) + VALUE(image_t, PNG) + VALUE(image_t, MONO16) +
                      VALUE(image_t, BAYER_RG8) + VALUE(image_t, BAYER_GR8) +
                      VALUE(image_t, BAYER_GB8) + VALUE(image_t, BAYER_BG8));
  line(profile_t{}, VALUE(profile_t, CONTINUES) + VALUE(profile_t, EDGE) + VALUE(profile_t, GAP) +
                        VALUE(profile_t, BORDER) + VALUE(profile_t, SATURATION) +
                        VALUE(profile_t, NONE) + VALUE(profile_t, NO_STRIPE) +
                        VALUE(profile_t, TOO_MUCH_LIGHT) + VALUE(profile_t, INCOMPLETE_IMAGE) +
                        VALUE(profile_t, LASER_OFF) + VALUE(profile_t, UNREADABLE_IMAGE) +
                        VALUE(profile_t, UNKNOWN_ENCODING) + VALUE(profile_t, NONE_CHOSEN) +
                        VALUE(profile_t, NO_POSITION) + VALUE(profile_t, NO_CALIBRATION) +
                        VALUE(profile_t, CALIBRATION_CHANGED) + VALUE(profile_t, OTHER_SENSOR) +
                        VALUE(profile_t, OUT_OF_RANGE) + VALUE(profile_t, WRONG_TIME));
  line(robot_pose_t{}, VALUE(robot_pose_t, UNKNOWN) + VALUE(robot_pose_t, HSPO) +
                           VALUE(robot_pose_t, J519) + VALUE(robot_pose_t, RTDE));
  line(scan_command_t{}, VALUE(scan_command_t, START) + VALUE(scan_command_t, STOP));
  line(scan_t{}, VALUE(scan_t, IDLE) + VALUE(scan_t, SCANNING) + VALUE(scan_t, ENDED) +
                     VALUE(scan_t, BACKGROUND) + VALUE(scan_t, WORKPIECE) + VALUE(scan_t, NONE) +
                     VALUE(scan_t, STOP) + VALUE(scan_t, LONGEST_DURATION) +
                     VALUE(scan_t, STANDSTILL) + VALUE(scan_t, CAMERA_LOST));
  line(seam_alternative_t{}, "");
  line(seam_station_t{}, "");
  line(seam_t{},
       VALUE(seam_t, FOUND) + VALUE(seam_t, AMBIGUOUS) + VALUE(seam_t, REFUSED) +
           VALUE(seam_t, BACKGROUND_STORED) + VALUE(seam_t, NOT_DETERMINED) + VALUE(seam_t, SEEN) +
           VALUE(seam_t, HIDDEN) + VALUE(seam_t, OUTSIDE) + VALUE(seam_t, SCAN_AGAIN) +
           VALUE(seam_t, TOO_LITTLE_KNOWN) + VALUE(seam_t, SENSOR_CAPTURE_RESTARTED) +
           VALUE(seam_t, END_NOT_REPORTED) + VALUE(seam_t, NO_IMAGES) +
           VALUE(seam_t, CALIBRATION_CHANGED) + VALUE(seam_t, BACKGROUND_INCOMPLETE) +
           VALUE(seam_t, POINTS_COINCIDE) + VALUE(seam_t, TOOL_STOOD_STILL) +
           VALUE(seam_t, START_BEFORE_SCAN) + VALUE(seam_t, START_MISSING) +
           VALUE(seam_t, FEW_STRIPES_AT_SEAM) + VALUE(seam_t, FEW_STRIPES_CROSS) +
           VALUE(seam_t, SEEN_TOO_SHORT) + VALUE(seam_t, SHOWS_TOO_RARELY) + VALUE(seam_t, CLEAN) +
           VALUE(seam_t, NO_SEAM) + VALUE(seam_t, TOO_MUCH_LIGHT) +
           VALUE(seam_t, BACKGROUND_OVERLIT) + VALUE(seam_t, NO_STRIPE) +
           VALUE(seam_t, BACKGROUND_EMPTY) + VALUE(seam_t, NO_WORKPIECE) +
           VALUE(seam_t, ONLY_BACKGROUND) + VALUE(seam_t, ONE_PLANE) + VALUE(seam_t, PLATES_APART) +
           VALUE(seam_t, EDGE_OF_ONE_PLATE) + VALUE(seam_t, CLUTTERED) +
           VALUE(seam_t, EDGES_NOT_STRAIGHT) + VALUE(seam_t, UPPER_PLATE_NARROW) +
           VALUE(seam_t, PLATE_TOO_NARROW) + VALUE(seam_t, PLATES_NOT_PARALLEL) +
           VALUE(seam_t, SURFACE_TOO_ROUGH) + VALUE(seam_t, SEVERAL_SEAMS) + VALUE(seam_t, CALL) +
           VALUE(seam_t, NO_BACKGROUND) + VALUE(seam_t, TOO_MANY_POINTS) +
           VALUE(seam_t, NO_PLANES_MEET) + VALUE(seam_t, WRONG_ANGLE) +
           VALUE(seam_t, WRONG_ANGLE_AT_SEAM) + VALUE(seam_t, NOT_CONVEX) +
           VALUE(seam_t, NOT_CONCAVE) + VALUE(seam_t, LAP_NOT_WANTED) + VALUE(seam_t, WRONG_STEP) +
           VALUE(seam_t, GROOVE_NOT_WANTED) + VALUE(seam_t, BUTT_NOT_WANTED) +
           VALUE(seam_t, WRONG_GROOVE_ANGLE) + VALUE(seam_t, GAP_TOO_WIDE) +
           VALUE(seam_t, CLOCKS_DIFFER) + VALUE(seam_t, STOP) + VALUE(seam_t, CAMERA_LOST) +
           VALUE(seam_t, NO_PROFILES) + VALUE(seam_t, SENSOR_CAPTURE_SILENT) +
           VALUE(seam_t, TWO_SENDERS) + VALUE(seam_t, USABLE) + VALUE(seam_t, START_NOT_SEEN) +
           VALUE(seam_t, START_UNSURE) + VALUE(seam_t, END_NOT_SEEN) + VALUE(seam_t, END_UNSURE) +
           VALUE(seam_t, CONTRADICTED) + VALUE(seam_t, CALIBRATION_FAILED) +
           VALUE(seam_t, CLOCKS_APART));
  line(service_status_t{}, VALUE(service_status_t, STARTING) + VALUE(service_status_t, RUNNING) +
                               VALUE(service_status_t, DEGRADED) + VALUE(service_status_t, FAULT) +
                               VALUE(service_status_t, STOPPING));
  line(stripe_t{}, VALUE(stripe_t, CONTINUES) + VALUE(stripe_t, EDGE) + VALUE(stripe_t, GAP) +
                       VALUE(stripe_t, BORDER) + VALUE(stripe_t, SATURATION) +
                       VALUE(stripe_t, CHOSEN) + VALUE(stripe_t, SECOND_CANDIDATE) +
                       VALUE(stripe_t, NONE) + VALUE(stripe_t, NO_STRIPE) +
                       VALUE(stripe_t, TOO_MUCH_LIGHT) + VALUE(stripe_t, INCOMPLETE_IMAGE) +
                       VALUE(stripe_t, LASER_OFF) + VALUE(stripe_t, UNREADABLE_IMAGE) +
                       VALUE(stripe_t, UNKNOWN_ENCODING));
  line(truth_t{}, "");
  std::ifstream file(ARCSTART_SOURCE "/lcmtypes/fingerprints.txt");
  std::ostringstream held;
  held << file.rdbuf();
  CHECK(now.str() == held.str());
}
