// What a message must satisfy beyond its type.
#include "common/bus/message_checks.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <string>

#include "common/bus/crc32c.hpp"

using namespace arcstart;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

image_t good_image() {
  image_t image{};
  image.utime = image.run_id = 1;
  image.width = image.sensor_width = 4;
  image.height = image.sensor_height = 3;
  image.data.assign(12, 7);
  image.size = 12;
  image.crc32c = crc32c(image.data);
  return image;
}

scan_command_t good_command() {
  scan_command_t command{};
  command.utime = command.command_id = 1;
  command.longest_duration = 5;
  return command;
}

seam_t good_seam() {
  seam_t seam{};
  seam.verdict = seam_t::REFUSED;
  seam.refusal = seam_t::NO_WORKPIECE;
  seam.reason = "no workpiece";
  return seam;
}

}  // namespace

TEST_CASE("an image's bytes must have its CRC-32C") {
  image_t image = good_image();
  CHECK(meaning_error(image).empty());
  image.data[5] ^= 1;
  CHECK_THAT(meaning_error(image), Catch::Contains("CRC-32C"));
  image = good_image();
  image.crc32c = 0;
  CHECK_THAT(meaning_error(image), Catch::Contains("CRC-32C"));
  image = good_image();
  image.incomplete = "cut";
  image.data.clear();
  image.size = 0;
  CHECK_THAT(meaning_error(image), Catch::Contains("CRC-32C"));
  image.crc32c = 0;
  CHECK(meaning_error(image).empty());
}

TEST_CASE("encodings that nobody reads yet are images all the same") {
  image_t image = good_image();
  for (const std::int8_t encoding :
       {image_t::BAYER_RG8, image_t::BAYER_GR8, image_t::BAYER_GB8, image_t::BAYER_BG8}) {
    image.encoding = encoding;
    CHECK(meaning_error(image).empty());
  }
  image.encoding = image_t::MONO16;
  CHECK_THAT(meaning_error(image), Catch::Contains("bytes"));
  image.data.resize(24);
  image.size = 24;
  image.crc32c = crc32c(image.data);
  CHECK(meaning_error(image).empty());
  for (const int encoding : {-1, image_t::BAYER_BG8 + 1}) {
    image.encoding = static_cast<std::int8_t>(encoding);
    CHECK_THAT(meaning_error(image), Catch::Contains("unknown encoding"));
  }
}

TEST_CASE("no centres or points without a code why, and no code beside them") {
  stripe_t stripe{};
  stripe.utime = stripe.run_id = 1;
  stripe.empty = "words alone do not count";
  CHECK_THAT(meaning_error(stripe), Catch::Contains("no reason why"));
  stripe.empty.clear();
  stripe.why = stripe_t::NO_STRIPE;
  CHECK(meaning_error(stripe).empty());
  stripe.why = stripe_t::UNKNOWN_ENCODING + 1;
  CHECK_THAT(meaning_error(stripe), Catch::Contains("unknown reason"));

  profile_t profile{};
  profile.utime = profile.run_id = 1;
  CHECK_THAT(meaning_error(profile), Catch::Contains("no reason why"));
  profile.why = profile_t::WRONG_TIME;
  CHECK(meaning_error(profile).empty());
  profile.count = 1;
  for (auto* list :
       {&profile.x, &profile.y, &profile.z, &profile.u, &profile.v, &profile.deviation})
    list->assign(1, 0);
  profile.segment.assign(1, 0);
  profile.segment_end.assign(1, profile_t::SATURATION);
  profile.tool_quaternion[0] = 1;
  CHECK_THAT(meaning_error(profile), Catch::Contains("reason why there are none"));
  profile.why = profile_t::NONE;
  CHECK(meaning_error(profile).empty());
  profile.segment_end[0] = profile_t::SATURATION + 1;
  CHECK_THAT(meaning_error(profile), Catch::Contains("segment end"));
}

TEST_CASE("names of jobs and parts are short lines of UTF-8") {
  const auto accepted = [](const std::string& name) {
    scan_command_t command = good_command();
    command.job = name;
    scan_command_t other = good_command();
    other.part = name;
    CHECK(meaning_error(command).empty() == meaning_error(other).empty());
    return meaning_error(command).empty();
  };
  CHECK(accepted(""));
  CHECK(accepted("Träger 7/б漢🔩"));
  CHECK(accepted(std::string(256, 'x')));
  CHECK_FALSE(accepted(std::string(257, 'x')));
  for (const char* bad : {"two\nlines", "\x1b[2J", "\x7f", "Tr\xe4ger", "\xc3", "\x80", "\xc0\xaf",
                          "\xe0\x80\x80", "\xed\xa0\x80", "\xf0\x80\x80\x80", "\xf4\x90\x80\x80",
                          "\xf8\x88\x80\x80\x80", "\xe6\xbc"}) {
    INFO(bad);
    CHECK_FALSE(accepted(bad));
  }
}

TEST_CASE("a scan that has ended says why") {
  scan_t scan{};
  scan.utime = scan.run_id = 1;
  CHECK(meaning_error(scan).empty());
  scan.state = scan_t::ENDED;
  CHECK_THAT(meaning_error(scan), Catch::Contains("cause"));
  scan.end_cause = scan_t::CAMERA_LOST;
  CHECK(meaning_error(scan).empty());
  scan.previous_scan_id = 5;
  CHECK_THAT(meaning_error(scan), Catch::Contains("the scan before"));
  scan.previous_end_cause = scan_t::STOP;
  CHECK(meaning_error(scan).empty());
  for (const double bound : {-0.5, kNan}) {
    scan.clock_bound = bound;
    CHECK_THAT(meaning_error(scan), Catch::Contains("clock"));
  }
}

TEST_CASE("a refusal has its code, and nothing else has one") {
  seam_t seam = good_seam();
  CHECK(meaning_error(seam).empty());
  for (const int code : {0, 100, 500}) {
    seam.refusal = static_cast<std::int16_t>(code);
    CHECK_THAT(meaning_error(seam), Catch::Contains("code"));
  }
  seam = good_seam();
  seam.verdict = seam_t::BACKGROUND_STORED;
  CHECK_THAT(meaning_error(seam), Catch::Contains("code"));
  seam.refusal = 0;
  CHECK(meaning_error(seam).empty());
  seam.start_second_weight = 0.6;
  CHECK_THAT(meaning_error(seam), Catch::Contains("second place"));
  seam = good_seam();
  seam.explained_share = 1.1;
  CHECK_THAT(meaning_error(seam), Catch::Contains("checked"));
}

TEST_CASE("a delivery has a progress, times and a turn of length 1") {
  delivery_t delivery{};
  delivery.utime = delivery.run_id = 5;
  delivery.quaternion[0] = 1;
  CHECK(meaning_error(delivery).empty());
  SECTION("progress") { delivery.progress = 6; }
  SECTION("turn") { delivery.quaternion[0] = 0; }
  SECTION("position") { delivery.end[1] = std::nan(""); }
  SECTION("request") { delivery.request = -1; }
  SECTION("part") { delivery.part = "two\nlines"; }
  CHECK_FALSE(meaning_error(delivery).empty());
}

TEST_CASE("a clock probe is a question, or an answer with its stamps") {
  clock_probe_t probe{};
  probe.robot = "ROBOT0";
  probe.asker_run_id = probe.asked_utime = 5;
  CHECK(meaning_error(probe).empty());
  probe.answerer_run_id = 6;
  CHECK_THAT(meaning_error(probe), Catch::Contains("stamps"));
  probe.heard_utime = 100;
  probe.answered_utime = 101;
  CHECK(meaning_error(probe).empty());
  probe.answered_utime = 99;
  CHECK_FALSE(meaning_error(probe).empty());
  probe.answered_utime = 101;
  probe.asked_utime = 0;
  CHECK_FALSE(meaning_error(probe).empty());
}

TEST_CASE("a camera command's region and frame rate hold together") {
  camera_command_t command{};
  command.utime = command.command_id = 1;
  CHECK(meaning_error(command).empty());
  command.width = 100;
  CHECK_THAT(meaning_error(command), Catch::Contains("region"));
  command.height = 50;
  CHECK(meaning_error(command).empty());
  command.frame_rate = kNan;
  CHECK_THAT(meaning_error(command), Catch::Contains("frame rate"));
}
