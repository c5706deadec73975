// The app from stripes and positions to profiles.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

#include "tests/reconstruction/reconstruction_chain.hpp"

using namespace arcstart;
using namespace arcstart::reconstruction;
using namespace arcstart::test;

namespace {

// A scan with all that can go wrong in it, in order of arrival.
std::vector<Event> eventful_scan() {
  std::vector<Event> events;
  constexpr std::int64_t kScan = 42;
  // Recording begins within the scan: the first calibration comes 0.7 s after the first stripe.
  for (std::int64_t time = kSecond; time < 6 * kSecond; time += kSecond)
    events.push_back(event(time, "LASER0_CALIBRATION", calibration()));
  for (std::int64_t time = 400'000; time < 6 * kSecond; time += 20'000) {
    if (time > 2'000'000 && time < 2'480'000) continue;  // the robot is silent
    robot_pose_t pose = pose_at(time);
    if (time == 3'000'000) pose.utime += 3600 * kSecond;  // a wild stamp
    if (time == 3'100'000) pose.utime -= 50'000;          // one that goes back
    if (time == 3'200'000) pose.invalid = "controller in error";
    events.push_back(event(time + 5'000, "ROBOT0_POSE", pose));
  }
  int number = 0;
  for (std::int64_t time = 300'000; time < 5 * kSecond; time += 71'429, ++number) {
    stripe_t message = stripe_at(time, number, kScan).message;
    if (number % 10 == 7) message = empty_stripe_at(time, number, kScan);
    if (number == 12) message.sensor_width = 800;
    if (number == 33) message.utime += 3600 * kSecond;
    events.push_back(event(time + kImageDelay + 40'000, "LASER0_STRIPE", message));
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
  return events;
}

}  // namespace

TEST_CASE("every stripe gets its profile, and its points lie where they were lit") {
  ReconstructionSettings settings;
  settings.keep_every = 1;
  Chain chain(settings);
  std::vector<TrueStripe> truth;
  chain.send("LASER0_CALIBRATION", calibration());
  std::int64_t position = 0;
  for (int i = 0; i < 20; ++i) {
    const std::int64_t time = 500'000 + i * 71'429;
    truth.push_back(stripe_at(time, i, 42));
    for (; position < time + 10'000; position += 20'000) chain.positions(position, position);
    chain.stripe(truth.back().message);
  }
  chain.positions(position, position);
  REQUIRE(chain.profiles.size() == 20);
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const stripe_t& stripe = truth[n].message;
    const profile_t& profile = chain.profiles[n];
    CHECK(profile.utime == stripe.utime);
    CHECK(profile.run_id == stripe.run_id);
    CHECK(profile.seq == stripe.seq);
    CHECK(profile.scan_id == 42);
    CHECK(profile.scan_index == stripe.scan_index);
    CHECK(profile.calibration_id == "0123456789abcdef");
    CHECK(profile.why == profile_t::NONE);
    CHECK(profile.empty == "");
    REQUIRE(profile.count == stripe.count);
    for (std::size_t i = 0; i < truth[n].points.size(); ++i) {
      // A wrong sign of the time offset would be 2.7 mm off; the message's floats hold 3e-5 mm.
      const cv::Vec3d point(profile.x[i], profile.y[i], profile.z[i]);
      CHECK(cv::norm(point - truth[n].points[i]) < 2e-4);
      CHECK(profile.deviation[i] > 0.005);
      CHECK(profile.deviation[i] < 0.05);
      const bool outermost = i == 0 || i + 1 == truth[n].points.size();
      const bool end = outermost || stripe.segment[i] != stripe.segment[i - 1] ||
                       stripe.segment[i] != stripe.segment[i + 1];
      CHECK(profile.segment_end[i] == (outermost ? profile_t::BORDER
                                       : end     ? profile_t::EDGE
                                                 : profile_t::CONTINUES));
    }
    const cv::Matx44d tool =
        tool_at(static_cast<double>(stripe.utime - kBegin - kImageDelay) * 1e-6);
    for (int i = 0; i < 3; ++i) CHECK(profile.tool_position[i] == Approx(tool(i, 3)).margin(1e-6));
    // The camera's centre, from the tool by the hand-eye of the cell.
    const cv::Vec4d centre = tool * cv::Vec4d(60, 5, 40, 1);
    for (int i = 0; i < 3; ++i) CHECK(profile.camera_centre[i] == Approx(centre[i]).margin(1e-6));
  }
  CHECK(chain.app.health().lost == 0);
  CHECK(chain.app.health().oldest_age == 0);
  CHECK(chain.app.health().state == service_status_t::RUNNING);
}

TEST_CASE("second candidates become no points, and down-sampling keeps the chosen segments' ends") {
  Chain chain;  // M = 15
  chain.send("LASER0_CALIBRATION", calibration());
  chain.positions(0, kSecond);
  stripe_t stripe = stripe_at(500'000, 0, 42).message;
  const int chosen = stripe.count;
  for (int i = 0; i < 100; ++i) {
    stripe.u.push_back(stripe.u[i]);
    stripe.v.push_back(stripe.v[i] + 30);
    stripe.strength.push_back(1);
    stripe.width.push_back(3);
    stripe.deviation.push_back(0.1f);
    stripe.segment.push_back(2);
    stripe.rank.push_back(stripe_t::SECOND_CANDIDATE);
    stripe.segment_end.push_back(stripe_t::CONTINUES);
    ++stripe.count;
  }
  chain.stripe(stripe);
  REQUIRE(chain.profiles.size() == 1);
  const profile_t& profile = chain.profiles[0];
  const int first = chosen / 3, second = chosen - first;
  const auto expected = [](int length) {
    return (length + 14) / 15 + ((length - 1) % 15 != 0 ? 1 : 0);
  };
  CHECK(profile.count == expected(first) + expected(second));
  CHECK(std::count(profile.segment_end.begin(), profile.segment_end.end(), profile_t::BORDER) == 2);
  CHECK(std::count(profile.segment_end.begin(), profile.segment_end.end(), profile_t::EDGE) == 2);
  CHECK(profile.u.front() == stripe.u.front());
  CHECK(profile.u.back() == stripe.u[static_cast<std::size_t>(chosen) - 1]);
}

TEST_CASE("the same bytes come out for any shift between the channels up to 300 ms") {
  const std::vector<Event> scan = eventful_scan();
  Chain reference;
  for (const Event& sent : scan) reference.send(sent);
  const auto stripes = std::count_if(scan.begin(), scan.end(),
                                     [](const Event& e) { return e.channel == "LASER0_STRIPE"; });
  REQUIRE(reference.bytes.size() == static_cast<std::size_t>(stripes));
  std::map<std::string, int> reasons;
  std::map<int, int> codes;
  for (const profile_t& profile : reference.profiles)
    ++reasons[profile.empty], ++codes[profile.why];
  CHECK(reasons[""] > 40);
  CHECK(reasons["stripe empty: no stripe"] == 6);
  CHECK(reasons["no position before it"] == 2);
  CHECK(reasons["positions 480 ms apart"] >= 5);
  CHECK(reasons["image of 800 x 1200 px, calibration of 1600 x 1200 px"] == 1);
  CHECK(reasons["its time lies far ahead of the positions and of the stripe after it"] == 1);
  CHECK(reasons.size() == 6);
  CHECK(codes[profile_t::NONE] == reasons[""]);
  CHECK(codes[profile_t::NO_STRIPE] == 6);
  CHECK(codes[profile_t::NO_POSITION] == 2 + reasons["positions 480 ms apart"]);
  CHECK(codes[profile_t::OTHER_SENSOR] == 1);
  CHECK(codes[profile_t::WRONG_TIME] == 1);
  CHECK(codes.size() == 5);

  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n) {
    std::vector<Event> shifted = scan;
    std::uniform_int_distribution<std::int64_t> shift(-300'000, 300'000);
    std::map<std::string, std::int64_t> of_channel, last;
    for (const char* channel : {"LASER0_STRIPE", "ROBOT0_POSE", "LASER0_CALIBRATION"})
      of_channel[channel] = shift(random);
    for (Event& sent : shifted) {
      // Half the runs shift whole channels, the others every message for itself; the order in a
      // channel is kept.
      sent.arrival += n % 2 == 0 ? of_channel[sent.channel] : shift(random);
      sent.arrival = last[sent.channel] = std::max(sent.arrival, last[sent.channel]);
    }
    std::stable_sort(shifted.begin(), shifted.end(),
                     [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
    Chain chain;
    for (const Event& sent : shifted) chain.send(sent);
    CHECK(chain.bytes == reference.bytes);
  }
}
