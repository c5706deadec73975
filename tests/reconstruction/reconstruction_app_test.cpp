#include "services/reconstruction/reconstruction_app.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "common/calibration_message.hpp"
#include "tests/reconstruction/synthetic_cell.hpp"

using namespace arcstart;
using namespace arcstart::test;

namespace {

constexpr std::int64_t kSecond = 1'000'000;
using Bytes = std::vector<std::uint8_t>;

// One message on its way to the app.
struct Event {
  std::int64_t arrival;  // us after kBegin
  std::string channel;
  Bytes bytes;
};

template <class Message>
Event event(std::int64_t arrival, const std::string& channel, const Message& message) {
  Event result{arrival, channel, Bytes(static_cast<std::size_t>(message.getEncodedSize()))};
  message.encode(result.bytes.data(), 0, static_cast<int>(result.bytes.size()));
  return result;
}

// The app on a bus of its own, with all that it publishes.
struct Chain {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  ReconstructionApp app;
  std::vector<Bytes> bytes;
  std::vector<profile_t> profiles;

  explicit Chain(const ReconstructionSettings& settings = {}) : app(*bus, settings, Instance{}) {
    bus->subscribe_pattern(
        "LASER0_PROFILE", Queue::measurements(),
        [this](const Bytes& message, const std::string&) { bytes.push_back(message); });
    bus->subscribe<profile_t>("LASER0_PROFILE", Queue::measurements(),
                              [this](const profile_t& profile) { profiles.push_back(profile); });
  }
  template <class Message>
  void send(const std::string& channel, const Message& message) {
    send(event(0, channel, message));
  }
  void send(const Event& sent) {
    bus->publish_bytes(sent.channel, sent.bytes);
    bus->handle(std::chrono::milliseconds(0));
  }
  void stripe(const stripe_t& message) { send("LASER0_STRIPE", message); }
  void positions(std::int64_t from, std::int64_t to) {
    for (std::int64_t time = from; time <= to; time += 20'000) send("ROBOT0_POSE", pose_at(time));
  }
};

calibration_t calibration() { return to_message(true_calibration()); }

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
    CHECK(profile.empty == "");
    REQUIRE(profile.count == stripe.count);
    for (std::size_t i = 0; i < truth[n].points.size(); ++i) {
      // A wrong sign of the time offset would be 2.7 mm off; the message's floats hold 3e-5 mm.
      const cv::Vec3d point(profile.x[i], profile.y[i], profile.z[i]);
      CHECK(cv::norm(point - truth[n].points[i]) < 2e-4);
      CHECK(profile.deviation[i] > 0.005);
      CHECK(profile.deviation[i] < 0.05);
      const bool end = i == 0 || i + 1 == truth[n].points.size() ||
                       stripe.segment[i] != stripe.segment[i - 1] ||
                       stripe.segment[i] != stripe.segment[i + 1];
      CHECK(profile.segment_end[i] == (end ? profile_t::SEGMENT_END : profile_t::INSIDE));
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
  CHECK(std::count(profile.segment_end.begin(), profile.segment_end.end(),
                   profile_t::SEGMENT_END) == 4);
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
  for (const profile_t& profile : reference.profiles) ++reasons[profile.empty];
  CHECK(reasons[""] > 40);
  CHECK(reasons["stripe empty: no stripe"] == 6);
  CHECK(reasons["no position before it"] == 2);
  CHECK(reasons["positions 480 ms apart"] >= 5);
  CHECK(reasons["image of 800 x 1200 px, calibration of 1600 x 1200 px"] == 1);
  CHECK(reasons["its time lies far ahead of the positions and of the stripe after it"] == 1);
  CHECK(reasons.size() == 6);

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

TEST_CASE("a calibration that does not hold together is refused, and the one before stays") {
  const auto refused = [](auto change, const std::string& why) {
    Chain chain;
    chain.positions(0, kSecond);
    calibration_t bad = calibration();
    bad.id = "ffffffffffffffff";
    change(bad);
    chain.send("LASER0_CALIBRATION", bad);
    chain.stripe(stripe_at(300'000, 0, 42).message);
    CHECK(chain.profiles.empty());  // it waits for a calibration
    INFO(chain.app.health().last_error);
    CHECK(chain.app.health().last_error.find(why) != std::string::npos);
    CHECK(chain.app.health().state == service_status_t::DEGRADED);
    chain.send("LASER0_CALIBRATION", calibration());
    REQUIRE(chain.profiles.size() == 1);
    CHECK(chain.profiles[0].empty == "");
    chain.send("LASER0_CALIBRATION", bad);
    chain.stripe(stripe_at(400'000, 1, 42).message);
    REQUIRE(chain.profiles.size() == 2);
    CHECK(chain.profiles[1].calibration_id == calibration().id);
  };
  refused([](calibration_t& m) { m.pixel_to_camera[0][2] *= 1 + 1e-9; }, "matrix M");
  refused([](calibration_t& m) { m.pixel_to_camera[3][0] += 1e-9; }, "matrix M");
  refused([](calibration_t& m) { m.laser_plane[3] += 1e-6; }, "matrix M");
  refused([](calibration_t& m) { m.camera_matrix[0] += 0.1; }, "matrix M");
  refused([](calibration_t& m) { m.sensor = "LASER1"; }, "of sensor LASER1, this is LASER0");
  refused([](calibration_t& m) { m.robot = "ROBOT1"; }, "of robot ROBOT1, this is ROBOT0");
  refused([](calibration_t& m) { m.distortion[0] = -5; }, "folds");
  refused([](calibration_t& m) { m.utime = 0; }, "when it was made");
}

TEST_CASE("other numbers under the id in force are refused") {
  Chain chain;
  chain.send("LASER0_CALIBRATION", calibration());
  chain.send("LASER0_CALIBRATION", calibration());
  CHECK(chain.app.health().last_error == "");
  Calibration other = true_calibration();
  other.T_tool_camera.translation().x() += 0.001;
  chain.send("LASER0_CALIBRATION", to_message(other));
  CHECK(chain.app.health().last_error.find("has the id of the one in force") != std::string::npos);
  chain.send("LASER0_CALIBRATION", calibration());
  CHECK(chain.app.health().last_error == "");
}

TEST_CASE("what is not finite or not of unit length never comes in, and is counted") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Chain chain;
  calibration_t bad = calibration();
  bad.laser_plane[3] = nan;
  chain.send("LASER0_CALIBRATION", bad);
  bad = calibration();
  bad.camera_quaternion[0] += 0.01;
  chain.send("LASER0_CALIBRATION", bad);
  chain.send("LASER0_CALIBRATION", calibration());
  robot_pose_t pose = pose_at(300'000);
  pose.position[1] = nan;
  chain.send("ROBOT0_POSE", pose);
  stripe_t stripe = stripe_at(290'000, 0, 42).message;
  stripe.u[3] = std::numeric_limits<float>::infinity();
  chain.stripe(stripe);
  pose = pose_at(300'000);
  pose.utime = std::numeric_limits<std::int64_t>::max();
  chain.send("ROBOT0_POSE", pose);
  CHECK(chain.bus->undecodable() == 5);
  chain.positions(0, kSecond);
  chain.stripe(stripe_at(290'000, 0, 42).message);
  REQUIRE(chain.profiles.size() == 1);
  CHECK(chain.profiles[0].empty == "");
}

TEST_CASE("what is lost, invalid or silent is told") {
  ReconstructionSettings settings;
  settings.silence_warning_s = 0.1;
  Chain chain(settings);
  chain.send("LASER0_CALIBRATION", calibration());
  chain.positions(0, 200'000);
  chain.positions(280'000, 300'000);  // three positions are missing: 220, 240, 260
  chain.stripe(stripe_at(100'000, 0, 42).message);
  chain.stripe(stripe_at(130'000, 3, 42).message);  // two are missing
  chain.stripe(stripe_at(150'000, 0, 43).message);  // another scan begins anew
  CHECK(chain.app.health().lost == 5);
  robot_pose_t pose = pose_at(320'000);
  pose.invalid = "controller in error";
  chain.send("ROBOT0_POSE", pose);
  CHECK(chain.app.health().lost == 5);
  CHECK(chain.app.health().last_error ==
        "ROBOT0_POSE: a position was dropped: controller in error");
  chain.positions(340'000, 340'000);
  CHECK(chain.app.health().last_error == "");
  chain.positions(260'000, 260'000);  // going back
  CHECK(chain.app.health().lost == 6);
  CHECK(chain.app.health().last_error.find("jumps or goes back") != std::string::npos);

  chain.stripe(stripe_at(900'000, 1, 43).message);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  const Health health = chain.app.health();
  CHECK(health.oldest_age >= 100'000);
  CHECK(health.state == service_status_t::DEGRADED);
  CHECK(health.last_error.find("stripes wait for positions on ROBOT0_POSE") != std::string::npos);
  const std::size_t before = chain.profiles.size();
  chain.bus->handle(std::chrono::milliseconds(0));
  CHECK(chain.profiles.size() == before);  // nothing by the clock
}

TEST_CASE("settings stand in cell.yaml with their limits") {
  const auto settings = Configuration::from_text("reconstruction:\n  keep_every: 1\n", "cell.yaml")
                            .read<ReconstructionSettings>("reconstruction");
  CHECK(settings.keep_every == 1);
  CHECK(settings.keep_positions_s == 10);
  CHECK(ReconstructionSettings{}.keep_every == 15);
  CHECK_THROWS_WITH(Configuration::from_text("reconstruction:\n  keep_every: 0\n", "cell.yaml")
                        .read<ReconstructionSettings>("reconstruction"),
                    Catch::Matchers::Contains("cell.yaml:2: reconstruction.keep_every"));
}
