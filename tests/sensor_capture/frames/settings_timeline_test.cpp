#include "services/sensor_capture/frames/settings_timeline.hpp"

#include <catch2/catch.hpp>

using namespace arcstart;
using namespace arcstart::sensor_capture;

namespace {

constexpr std::int64_t kMillisecond = 1000;
const CameraSettings kDark{4000, 0, false};
const CameraSettings kLit{4000, 0, true};
const CameraSettings kLong{8000, 6, true};

SettingsTimeline begun(const CameraSettings& settings = kDark, int frames_to_settle = 1) {
  SettingsTimeline timeline(2 * kMillisecond, frames_to_settle);
  timeline.begin(settings);
  return timeline;
}

}  // namespace

TEST_CASE("timeline: what the camera was found with is certain") {
  auto timeline = begun();
  const auto in_force = timeline.take_frame(1000 * kMillisecond);
  CHECK(in_force.settings == kDark);
  CHECK(in_force.certain);
  CHECK_FALSE(in_force.lit);
  CHECK(in_force.ticket == 0);
}

TEST_CASE("timeline: lit only from the margin after the answer on") {
  auto timeline = begun();
  timeline.requested(1, kLit, 1000 * kMillisecond);
  CHECK(timeline.wanted() == kLit);
  CHECK(timeline.take_frame(990 * kMillisecond).certain);        // ended before the request
  CHECK_FALSE(timeline.take_frame(997 * kMillisecond).certain);  // ended after it
  CHECK_FALSE(timeline.take_frame(1001 * kMillisecond).lit);
  timeline.applied(1, kLit, 1010 * kMillisecond);
  CHECK_FALSE(timeline.take_frame(1009 * kMillisecond).lit);
  CHECK_FALSE(timeline.take_frame(1011 * kMillisecond).lit);  // within the margin
  CHECK_FALSE(timeline.take_frame(1011 * kMillisecond).certain);
  const auto lit = timeline.take_frame(1012 * kMillisecond);
  CHECK(lit.lit);
  CHECK(lit.certain);
  CHECK(lit.ticket == 1);
}

TEST_CASE("timeline: lit only until the request to go dark") {
  auto timeline = begun(kLit);
  timeline.requested(1, kDark, 1000 * kMillisecond);
  CHECK(timeline.take_frame(995 * kMillisecond).lit);        // 995 to 999
  CHECK(timeline.take_frame(996 * kMillisecond).lit);        // until the very moment
  CHECK_FALSE(timeline.take_frame(997 * kMillisecond).lit);  // may have gone dark in the middle
  CHECK_FALSE(timeline.take_frame(1001 * kMillisecond).lit);
  timeline.applied(1, kDark, 1001 * kMillisecond);
  CHECK_FALSE(timeline.take_frame(1100 * kMillisecond).lit);
}

TEST_CASE("timeline: a new exposure settles an exposure later, the laser at once") {
  auto timeline = begun();
  timeline.requested(1, kLong, 1000 * kMillisecond);
  timeline.applied(1, kLong, 1010 * kMillisecond);
  const auto first = timeline.take_frame(1020 * kMillisecond);
  CHECK(first.lit);
  CHECK_FALSE(first.certain);
  CHECK(first.settings.exposure_us == 4000);
  const auto second = timeline.take_frame(1100 * kMillisecond);
  CHECK(second.certain);
  CHECK(second.lit);
  CHECK(second.settings == kLong);
}

TEST_CASE("timeline: what the camera reads back counts") {
  auto timeline = begun(kDark, 0);
  timeline.requested(1, kLong, 1000 * kMillisecond);
  timeline.applied(1, {7998.5, 6, true}, 1010 * kMillisecond);
  CHECK(timeline.take_frame(1100 * kMillisecond).settings.exposure_us == 7998.5);
}

TEST_CASE("timeline: several requests at a time") {
  auto timeline = begun();
  timeline.requested(1, kLit, 1000 * kMillisecond);
  timeline.requested(2, kDark, 1005 * kMillisecond);
  timeline.applied(1, kLit, 1002 * kMillisecond);
  CHECK_FALSE(
      timeline.take_frame(1004 * kMillisecond).lit);  // 1004 to 1008: the second may have come
  timeline.requested(3, kLit, 1020 * kMillisecond);
  timeline.applied(2, kDark, 1006 * kMillisecond);
  CHECK_FALSE(timeline.take_frame(1010 * kMillisecond).lit);
  CHECK_FALSE(timeline.take_frame(1030 * kMillisecond).lit);
  timeline.applied(3, kLit, 1021 * kMillisecond);
  const auto last = timeline.take_frame(1040 * kMillisecond);
  CHECK(last.lit);
  CHECK(last.ticket == 3);
}

TEST_CASE("timeline: a refused request leaves what was") {
  auto timeline = begun(kLit);
  timeline.requested(1, {1e9, 0, true}, 1000 * kMillisecond);
  CHECK_FALSE(timeline.take_frame(1001 * kMillisecond).certain);
  timeline.refused(1);
  const auto after = timeline.take_frame(1100 * kMillisecond);
  CHECK(after.certain);
  CHECK(after.settings == kLit);
  CHECK(timeline.wanted() == kLit);
}
