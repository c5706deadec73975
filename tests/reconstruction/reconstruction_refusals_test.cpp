// What the app refuses, loses or is told wrongly, and what it says of that.
#include <catch2/catch.hpp>
#include <limits>

#include "tests/reconstruction/reconstruction_chain.hpp"

using namespace arcstart;
using namespace arcstart::reconstruction;
using namespace arcstart::test;

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

TEST_CASE("no stripe is placed by positions of two senders") {
  // A stranger's lie 25 mm beside and are stamped 25 ms ahead, so that the true ones seem to go
  // back. One stripe before the stranger comes, and one after a restart that is none of its kind.
  Chain chain;
  chain.send("LASER0_CALIBRATION", calibration());
  const auto send_both = [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t time = from; time <= to; time += 20'000) {
      robot_pose_t stranger = pose_at(time);
      stranger.run_id = 99;
      stranger.utime += 25'000;
      stranger.position[0] += 25;
      chain.send("ROBOT0_POSE", stranger);
      chain.send("ROBOT0_POSE", pose_at(time));
    }
  };
  chain.positions(0, 200'000);
  chain.stripe(stripe_at(100'000, 0, 42).message);
  send_both(220'000, 600'000);
  for (int i = 0; i < 4; ++i) chain.stripe(stripe_at(215'000 + 90'000 * i, 1 + i, 42).message);
  REQUIRE(chain.profiles.size() == 5);
  CHECK(chain.profiles[0].count > 0);
  for (std::size_t i = 1; i < 5; ++i) {
    CHECK(chain.profiles[i].why == profile_t::NO_POSITION);
    CHECK_THAT(chain.profiles[i].empty, Catch::Contains("two senders"));
  }
  CHECK_THAT(chain.bus->dispute(), Catch::Contains("ROBOT0_POSE: two senders"));
}

TEST_CASE("a robot_pose that was started again is no second one") {
  Chain chain;
  chain.send("LASER0_CALIBRATION", calibration());
  chain.positions(0, 200'000);
  for (std::int64_t time = 500'000; time <= 900'000; time += 20'000) {
    robot_pose_t pose = pose_at(time);
    pose.run_id = 99;
    chain.send("ROBOT0_POSE", pose);
  }
  chain.stripe(stripe_at(600'000, 0, 42).message);
  REQUIRE(chain.profiles.size() == 1);
  CHECK(chain.profiles[0].count > 0);
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

  robot_pose_t wild = pose_at(340'001);
  wild.seq = 1'000'000'000'000;
  chain.send("ROBOT0_POSE", wild);
  chain.positions(360'000, 360'000);
  CHECK(chain.app.health().lost == 6);

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
